// Times the explicit step of a scene, and counts its bytes; times a whole run at rest. Writes one `name value` a line.
//   tissue_speed speed SCENE STEPS THREADS [section.key=value ...]
//   tissue_speed memory SCENE [section.key=value ...]
//   tissue_speed rest SCENE FOLDER [section.key=value ...]
//   tissue_speed lammps SCENE FOLDER [section.key=value ...]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "generator/generate.h"
#include "generator/sample/errors.h"
#include "pipelines/performance/timed.h"
#include "pipelines/performance/tissue_lammps.h"
#include "simulator/simulate.h"
#include "simulator/steppers/velocity_verlet.h"

namespace lamella {
namespace {

constexpr int kStepsPerRow = 100;  // the default 1000 rows in a run of 100,000 steps

struct Tissue {
  Scene scene;
  Sample sample;
  std::vector<Load> loads;

  Tissue(const char* path, std::vector<std::string> overrides) : scene(read_scene(path, overrides)) {
    Notes notes;
    sample = generate(scene, notes);
    loads = build_loads(sample, stage());
    for (Load& load : loads) load.factor = 1;
  }
  const Stage& stage() const { return scene.stages.front(); }
};

/// Steps as a run does: one in kStepsPerRow is a row, with the energies of all terms and the ledger.
void time_steps(Tissue& tissue, int steps, int threads) {
  State state{Field(tissue.sample.nodes()), Field(tissue.sample.nodes()), 0, 0};
  for (Index i = 0; i < tissue.sample.nodes(); ++i) state.x.set(i, tissue.sample.x[i]);
  const auto model = build_model(tissue.sample, tissue.stage(), state.x);
  if (model->contacts) model->contacts->update_candidates(state.x);
  VelocityVerlet stepper(*model, tissue.loads, state, threads);
  const double dt = tissue.stage().run.time_step.value();

  double energy_at_start = 0, residual = 0, largest_work = 0;
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = processor_seconds();
  for (int n = 0; n < steps; ++n) {
    if (n % kStepsPerRow != 0) {
      stepper.step(dt, dt);
      continue;
    }
    const double energy = model->energy(state.x);
    const Measurement m = stepper.measured_step(dt, dt, nullptr);
    const double out = energy + m.kinetic + m.works.damping + m.works.fracture;
    if (n == 0) energy_at_start = out - m.works.loads;
    largest_work = std::max(largest_work, std::abs(m.works.loads));
    residual = std::max(residual, std::abs(m.works.loads - out + energy_at_start));
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double processor = processor_seconds() - processor_start;
  fmt::print("nodes {}\nsteps {}\nseconds {:.6g}\nprocessor_seconds {:.6g}\n", tissue.sample.nodes(), steps, seconds,
             processor);
  fmt::print("broken_links {}\nledger_residual {:.3g}\npeak_megabytes {:.1f}\n", model->links->broken(),
             largest_work > 0 ? residual / largest_work : 0.0, peak_megabytes());
}

void count_bytes(const Tissue& tissue) {
  Field x(tissue.sample.nodes());
  for (Index i = 0; i < tissue.sample.nodes(); ++i) x.set(i, tissue.sample.x[i]);
  const auto model = build_model(tissue.sample, tissue.stage(), x);
  if (model->contacts) model->contacts->update_candidates(x);
  const double nodes = tissue.sample.nodes();
  fmt::print("positions,_velocities,_forces {:.1f}\n", 6.0 * sizeof(double));
  fmt::print("masses {:.1f}\n", 2.0 * sizeof(double));
  for (const Term* term : model->terms())
    fmt::print("{} {:.1f}\n", term->name(), static_cast<double>(term->bytes()) / nodes);
}

/// The run that `lamella simulate` does, rows and frames included.
void time_at_rest(const Tissue& tissue, const std::filesystem::path& folder) {
  const auto path = folder / "at_rest.h5";
  TrajectoryWriter writer(path, tissue.sample, {});
  const double start = processor_seconds();
  const RunFacts facts = simulate(tissue.sample, tissue.scene, writer, {});
  const double seconds = processor_seconds() - start;
  const TrajectoryReader reader(path);
  const Response& response = reader.response();
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(response.columns.begin(), response.columns.end(), name) -
                                    response.columns.begin());
  };
  double peak = 0;
  for (const auto& row : response.rows) peak = std::max(peak, row.at(column("stress")));
  const SolverCost& cost = facts.static_cost;
  fmt::print("cells {}\nnodes {}\nlinks {}\n", tissue.sample.cells(), tissue.sample.nodes(),
             tissue.sample.links.size());
  fmt::print("breaks {}\npeak_stress {:.9g}\nwork {:.9g}\nprocessor_seconds {:.6g}\n", reader.events().size(), peak,
             response.rows.back().at(column("work")), seconds);
  fmt::print("equilibria {}\niterations {}\nfactorisations {}\nin_part {}\npeak_megabytes {:.1f}\n", cost.searches,
             cost.iterations, cost.factorizations, cost.partial_factorizations, peak_megabytes());
  fmt::print("ended {}\n", facts.ended);
}

int run(int count, char** arguments) {
  const std::string what = count > 2 ? arguments[1] : "";
  const int fixed = what == "speed" ? 5 : what == "lammps" || what == "rest" ? 4 : what == "memory" ? 3 : count + 1;
  if (count < fixed) {
    fmt::print(stderr,
               "tissue_speed: speed SCENE STEPS THREADS | memory SCENE | rest SCENE FOLDER | lammps SCENE FOLDER; then "
               "key=value\n");
    return 2;
  }
  Tissue tissue(arguments[2], {arguments + fixed, arguments + count});
  if (what == "speed") time_steps(tissue, std::stoi(arguments[3]), std::stoi(arguments[4]));
  if (what == "memory") count_bytes(tissue);
  if (what == "rest") time_at_rest(tissue, arguments[3]);
  if (what == "lammps") {
    const std::filesystem::path folder = arguments[3];
    write_lammps_data(tissue.sample, tissue.loads, folder / "tissue.data");
    write_lammps_parameters(tissue.sample, tissue.stage(), folder / "tissue.parameters");
  }
  return 0;
}

}  // namespace
}  // namespace lamella

int main(int count, char** arguments) {
  try {
    return lamella::run(count, arguments);
  } catch (const std::exception& e) {
    fmt::print(stderr, "tissue_speed: {}\n", e.what());
    return 2;
  }
}
