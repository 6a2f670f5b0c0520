# Colours a picture of the program by what its table of cells holds, and makes it smaller: two decimals of a point, short attributes.
# awk -F, -v by=neighbours|area|group -f colour.awk NAME_cells.csv FS=' ' NAME.svg

function hex(rgb, parts) {
  split(rgb, parts, " ")
  return sprintf("#%02x%02x%02x", parts[1] + 0.5, parts[2] + 0.5, parts[3] + 0.5)
}
# Between two colours.
function mix(a, b, share, p, q) {
  split(a, p, " ")
  split(b, q, " ")
  return (p[1] + share * (q[1] - p[1])) " " (p[2] + share * (q[2] - p[2])) " " (p[3] + share * (q[3] - p[3]))
}
# From pale to dark, in five steps of a straight line each.
function scale(t, k) {
  t = 5 * (t < 0 ? 0 : t > 1 ? 1 : t)
  k = t >= 5 ? 4 : int(t)
  return mix(ramp[k], ramp[k + 1], t - k)
}
function neighbour_colour(n) { return of_count[n < 3 ? 3 : n > 9 ? 9 : n] }
function group_colour(name) {
  if (!(name in rank)) {
    rank[name] = groups + 0
    names[groups++] = name
  }
  return of_group[rank[name] % 6]
}
function fill(k) {
  if (by == "area") return scale((area[k] / mean) / high)
  if (by == "group") return group_colour(group[k])
  return layer[k] == 0 ? mix(neighbour_colour(neighbours[k]), "255 255 255", 0.6) : neighbour_colour(neighbours[k])
}
function attribute(line, name, value) {
  if (!match(line, name "[:=]\"?[^;\"]*")) return ""
  value = substr(line, RSTART, RLENGTH)
  sub(name "[:=]\"?", "", value)
  return value
}
function text(x, y, words) { printf "<text x=\"%.1f\" y=\"%.1f\" stroke=\"none\" fill=\"#222\">%s</text>\n", x, y, words }
function box(x, y, rgb) { printf "<rect x=\"%.1f\" y=\"%.1f\" width=\"14\" height=\"14\" fill=\"%s\" stroke-width=\"0.5\"/>\n", x, y, hex(rgb) }

function key(y, k, n, x) {
  x = 14
  if (by == "neighbours") {
    text(x, y + 11.5, "neighbours")
    for (n = 3; n <= 9; n++) {
      box(x + 40 + 46 * (n - 2), y, of_count[n])
      text(x + 59 + 46 * (n - 2), y + 11.5, n == 3 ? "\342\211\244 3" : n == 9 ? "\342\211\245 9" : n)
    }
  } else if (by == "area") {
    text(x, y + 11.5, "area over its mean: 0")
    for (k = 0; k < 60; k++)
      printf "<rect x=\"%.1f\" y=\"%.1f\" width=\"3.5\" height=\"14\" fill=\"%s\" stroke=\"none\"/>\n", x + 140 + 3 * k, y, hex(scale((k + 0.5) / 60))
    text(x + 330, y + 11.5, sprintf("%.1f%s", high, largest > 1.01 * high ? " and more" : ""))
  } else {
    for (k = 0; k < groups; k++) {
      box(x, y, of_group[k % 6])
      text(x + 20, y + 11.5, names[k])
      x += 50 + 8 * length(names[k])
    }
  }
}

BEGIN {
  split("33 77 148;66 128 191;148 194 224;237 230 209;245 179 122;217 107 77;158 36 48", list, ";")
  for (n = 3; n <= 9; n++) of_count[n] = list[n - 2]
  split("204 230 196;250 212 158;189 212 240;237 194 204;214 201 235;242 235 168", list, ";")
  for (k = 0; k < 6; k++) of_group[k] = list[k + 1]
  split("252 246 214;199 226 180;120 199 187;64 156 187;47 104 168;42 52 120", list, ";")
  for (k = 0; k < 6; k++) ramp[k] = list[k + 1]
}
FNR == NR {
  if (FNR == 1) {
    for (k = 1; k <= NF; k++) {
      name = $k
      sub(/ .*/, "", name)
      column[name] = k
    }
    next
  }
  k = cells++
  group[k] = $column["group"]
  area[k] = $column["area"]
  neighbours[k] = $column["neighbours"]
  layer[k] = $column["layer"]
  mean += area[k]
  if (area[k] > largest) largest = area[k]
  next
}
/<svg / {
  mean /= cells
  largest /= mean
  high = largest > 4 ? 4 : int(2 * largest + 0.999) / 2
  width = attribute($0, " width") + 0
  height = attribute($0, " height") + 0
  printf "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\" font-family=\"DejaVu Sans, sans-serif\"" \
    " font-size=\"12\">\n<rect width=\"%g\" height=\"%g\" fill=\"#fff\"/>\n<g stroke=\"#3a4041\" stroke-linejoin=\"round\">\n", \
    width, height + 28, width, height + 28, width, height + 28
}
/<path / {
  n = split(attribute($0, " d"), word, " ")
  line = ""
  for (k = 1; k <= n && word[k] != "Z"; k++) {  # cairo begins another path where one is closed
    value = word[k] ~ /[0-9]/ ? sprintf("%.2f", word[k]) : word[k]
    if (value ~ /\./) sub(/\.?0+$/, "", value)
    line = line (value ~ /^[A-Z]$/ || line ~ /[A-Z]$/ ? "" : " ") value
  }
  printf "<path fill=\"%s\" stroke-width=\"%g\" d=\"%sZ\"/>\n", hex(fill(paths + 0)), attribute($0, "stroke-width"), line
  paths++
}
END {
  if (paths != cells) {
    printf "%d paths for %d cells\n", paths, cells > "/dev/stderr"
    exit 1
  }
  key(height + 4)
  print "</g>\n</svg>"
}
