// Times what `lamella generate` does, stage by stage, on one thread.
//   tissue_stages SCENE SAMPLE [section.key=value ...]
#include <string>

#include "generator/generate.h"
#include "generator/tissue/mosaic_file.h"
#include "pipelines/performance/timed.h"

namespace lamella {
namespace {

/// Stages begin where the generator says so.
class Stages {
 public:
  void begin(const std::string& stage) {
    const double now = processor_seconds();
    if (!stage_.empty()) fmt::print("{} {:.6g}\n", stage_, now - start_);
    stage_ = stage;
    start_ = now;
  }

 private:
  std::string stage_;
  double start_ = 0;
};

void run(const char* path, const char* out, const std::vector<std::string>& overrides) {
  const Scene scene = read_scene(path, overrides);
  Stages stages;
  Notes notes;
  Origin origin;
  const double start = processor_seconds();
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
  fmt::print("whole {:.6g}\ncells {}\npoints {}\nmegabytes {:.1f}\nfile {:.1f}\n", processor_seconds() - start,
             sample.cells(), sample.nodes(), peak_megabytes(),
             1e-6 * static_cast<double>(std::filesystem::file_size(out)));
}

}  // namespace
}  // namespace lamella

int main(int count, char** arguments) {
  if (count < 3) {
    fmt::print(stderr, "tissue_stages: SCENE SAMPLE, then key=value\n");
    return 2;
  }
  try {
    lamella::run(arguments[1], arguments[2], {arguments + 3, arguments + count});
  } catch (const std::exception& e) {
    fmt::print(stderr, "tissue_stages: {}\n", e.what());
    return 2;
  }
}
