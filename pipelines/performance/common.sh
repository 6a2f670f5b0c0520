# What pipelines/performance/run and generator share; sourced from the repository's root.
here=pipelines/performance
build=build-performance
repeats=${REPEATS:-3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

load() { cut -d' ' -f1 /proc/loadavg; }  # of other programs: with two cores and a load of 2, wall clocks show half the speed
processor() { awk -F': ' '/model name/ { print $2; exit }' /proc/cpuinfo; }

# build TARGET ...: what is to be timed.
build() {
  local launcher
  launcher=$(command -v ccache > /dev/null && echo -DCMAKE_CXX_COMPILER_LAUNCHER=ccache || true)
  cmake -S . -B $build -G Ninja -DLAMELLA_BENCHMARKS=ON -DLAMELLA_TESTS=OFF $launcher > "$work/configure.log" ||
    { cat "$work/configure.log" >&2; exit 1; }
  cmake --build $build -j "$(nproc)" --target "$@" > "$work/build.log" || { tail -n 40 "$work/build.log" >&2; exit 1; }
}

# value NAME FILE: of a `name value` line.
value() { awk -v name="$1" '$1 == name { print $2 }' "$2"; }
# Middle one of the numbers on standard input.
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
