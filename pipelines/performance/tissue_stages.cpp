// Times what `lamella generate` does, stage by stage, on some threads: seconds of the wall clock and of all processors.
//   tissue_stages SCENE SAMPLE THREADS [section.key=value ...]
#include <string>

#include "generator/generate.h"
#include "generator/sample/parallel.h"
#include "generator/tissue/mosaic_file.h"
#include "pipelines/performance/timed.h"

namespace lamella {
namespace {

struct Times {
  double wall = 0, processor = 0;  // [s]
};

Times times() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return {static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec), processor_seconds()};
}

void print(const std::string& stage, const Times& from, const Times& to) {
  fmt::print("{0} {1:.6g}\n{0}_wall {2:.6g}\n", stage, to.processor - from.processor, to.wall - from.wall);
}

/// Stages begin where the generator says so.
class Stages {
 public:
  void begin(const std::string& stage) {
    const Times now = times();
    if (!stage_.empty()) print(stage_, start_, now);
    stage_ = stage;
    start_ = now;
  }

 private:
  std::string stage_;
  Times start_;
};

void run(const char* path, const char* out, const std::vector<std::string>& overrides) {
  const Scene scene = read_scene(path, overrides);
  Stages stages;
  Notes notes;
  Origin origin;
  const Times start = times();
  stages.begin("packing");
  const Sample sample = generate(
      scene, notes,
      [&](double, const std::string& what) {
        for (const char* stage : {"tessellation", "walls", "check"})
          if (what == stage) stages.begin(what);
      },
      &origin);
  stages.begin("writing");
  write_sample(out, sample, origin.tiles);
  stages.begin("");
  print("whole", start, times());
  fmt::print("cells {}\npoints {}\nmegabytes {:.1f}\nfile {:.1f}\n", sample.cells(), sample.nodes(), peak_megabytes(),
             1e-6 * static_cast<double>(std::filesystem::file_size(out)));
}

}  // namespace
}  // namespace lamella

int main(int count, char** arguments) {
  if (count < 4) {
    fmt::print(stderr, "tissue_stages: SCENE SAMPLE THREADS, then key=value\n");
    return 2;
  }
  try {
    lamella::use_threads(std::stoi(arguments[3]));
    lamella::run(arguments[1], arguments[2], {arguments + 4, arguments + count});
  } catch (const std::exception& e) {
    fmt::print(stderr, "tissue_stages: {}\n", e.what());
    return 2;
  }
}
