#include "postproc/postproc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "generator/sample/errors.h"
#include "postproc/output_file.h"
#include "postproc/pictures.h"
#include "postproc/quantities/cell_shape.h"
#include "postproc/quantities/fragments.h"
#include "postproc/quantities/packing_state.h"
#include "postproc/report.h"
#include "postproc/summarise.h"
#include "postproc/view_script.h"
#include "postproc/vtk_meshes.h"

namespace lamella {
namespace {

using Path = std::filesystem::path;

/// Rows that an array of this kind has when its term is not there yet: none for contacts.
std::size_t rows_of(const NamedArray& array, const Sample& sample) {
  if (array.per == "node" || array.per == "segment") return sample.nodes();
  if (array.per == "cell") return sample.cells();
  if (array.per == "link") return sample.links.size();
  return 0;
}

/// Stages may have terms of their own, but ParaView shows only what the first frame has: every frame gets the arrays of all
/// stages, at rest where the term is not there yet (links and bars intact, times of break -1, all else 0).
class FrameCompleter {
 public:
  explicit FrameCompleter(const TrajectoryReader& reader) : sample_(reader.sample()) {
    if (reader.frames() == 0) throw DataError("trajectory: it holds no frame, so there is nothing to show");
    const Frame last = reader.frame(reader.frames() - 1);
    take(last);
    // The terms of a stage do not change, and stages follow one another: the first frame of each is enough.
    for (int k = 0, stage = -1; k < reader.frames() && stage != last.stage; ++k) {
      const Frame frame = reader.frame(k);
      if (frame.stage != stage) take(frame);
      stage = frame.stage;
    }
  }

  Frame complete(Frame frame) const {
    for (const auto& [name, array] : kinds_)
      if (!frame.arrays.find(name)) frame.arrays.add(array);
    return frame;
  }

 private:
  void take(const Frame& frame) {
    for (const NamedArray& array : frame.arrays.all()) kinds_.try_emplace(array.name, at_rest(array));
  }
  NamedArray at_rest(NamedArray array) const {
    const std::size_t size = rows_of(array, sample_) * array.components;
    const int value = array.name == "link_intact"                                         ? 1
                      : array.name == "link_break_time" || array.name == "bar_break_time" ? -1
                                                                                          : 0;
    std::visit([&](auto& data) { data.assign(size, value); }, array.data);
    return array;
  }

  const Sample& sample_;
  std::map<std::string, NamedArray> kinds_;
};

/// What is kept of every frame.
struct FrameFacts {
  std::vector<double> times;
  std::vector<Vec2> lateral;  // (strain, lateral strain)
  std::vector<std::pair<double, double>> aspects;
  std::vector<PackingState> packing;  // none without walls on four sides
};

class Post {
 public:
  Post(const Path& trajectory, Path folder, const PostOptions& options)
      : reader_(trajectory), folder_(std::move(folder)), options_(options), completer_(reader_) {}

  PostResult run() {
    make_folder(folder_);
    facts_.reader = &reader_;
    facts_.setup = test_setup(reader_.provenance());
    if (facts_.setup) facts_.curve = load_curve(reader_.response(), *facts_.setup);
    if (facts_.curve.strain.empty()) facts_.setup.reset();
    finder_ = std::make_unique<CrackFinder>(reader_.sample(), facts_.setup ? 1 - facts_.setup->axis : 0);
    go_through_frames();
    if (facts_.setup)
      facts_.constants = material_constants(facts_.curve, *facts_.setup, reader_.events(), frames_.lateral);
    facts_.aspects = frames_.aspects;
    facts_.budget = energy_budget(reader_.response());
    const Frame last = frame(reader_.frames() - 1);
    const FrameView last_view(reader_.sample(), last);
    facts_.last = &last_view;
    if (facts_.setup && (last_view.has("link_intact") || last_view.broken_bars()) &&
        separated(last_view, facts_.setup->axis))
      fail_at_separation(facts_.constants, facts_.curve);
    if (last_view.has("link_intact")) facts_.cracks = finder_->find(last_view);
    result_.summary = summarise(facts_);
    for (const Quantity& known : options_.accuracy) result_.summary.add("accuracy", known);
    if (options_.pictures) draw();
    write_tables();
    tell(1, "done");
    // Those for the reader first.
    result_.files.insert(result_.files.begin(), first_.begin(), first_.end());
    return std::move(result_);
  }

 private:
  Frame frame(int k) const { return completer_.complete(reader_.frame(k)); }
  void tell(double done, const std::string& what) const {
    if (options_.progress) options_.progress(done, what);
  }

  void go_through_frames() {
    const Sample& sample = reader_.sample();
    const double depth = facts_.setup ? facts_.setup->depth : provenance_number("depth", 1);
    std::map<std::string, VtkSeries> series;
    const auto add = [&](const std::string& name, double time, const Mesh& mesh) {
      series.try_emplace(name, folder_, name).first->second.add(time, mesh);
    };
    const bool any_closed = std::any_of(sample.closed.begin(), sample.closed.end(), [](auto c) { return c != 0; });
    for (int k = 0; k < reader_.frames(); ++k) {
      tell(0.8 * k / reader_.frames(), "frames");
      const Frame now = frame(k);
      const FrameView view(sample, now);
      frames_.times.push_back(now.time);
      take_facts(view);
      if (!options_.vtk) continue;
      if (any_closed) add("cells", now.time, cells_mesh(view, depth));
      add("walls", now.time, walls_mesh(view));
      if (view.has("link_intact")) {
        add("links", now.time, links_mesh(view));
        if (view.has("link_break_time")) add("cracks", now.time, cracks_mesh(view, finder_->find(view)));
      }
      if (view.has("contact_node")) add("contacts", now.time, contacts_mesh(view));
    }
    for (auto& [name, one] : series) result_.files.push_back(one.finish());
    if (any_closed && options_.vtk) {
      const bool over_w0 = series.count("cracks") > 0;
      write_text_file(folder_ / "view.py",
                      view_script(over_w0 ? "energy_over_w0" : "energy", over_w0 ? "energy / W_0" : "energy [J]",
                                  over_w0 ? Overlay::kCracks : Overlay::kNone));
      result_.files.push_back(folder_ / "view.py");
    }
  }

  void take_facts(const FrameView& view) {
    const Sample& sample = view.sample;
    double aspect = 0;
    int closed = 0;
    for (Index c = 0; c < sample.cells(); ++c)
      if (view.closed(c)) aspect += cell_shape(sample, view.x, c).aspect, ++closed;
    if (closed) frames_.aspects.emplace_back(view.frame.time, aspect / closed);
    if (const auto state = packing_state(view)) frames_.packing.push_back(*state);
    if (!facts_.setup || view.frame.stage != facts_.setup->stage) return;
    const std::vector<CellShape> shapes = cell_shapes(view);
    facts_.cell_stress.emplace_back(view.frame.time,
                                    mean_stress(sample, shapes, cell_stress(view, shapes, facts_.setup->depth)));
    const int across = 1 - facts_.setup->axis;
    if (sample.periodic[across] && !view.box_moves()) return;  // the box holds its length across
    const double lateral = view.box_moves() ? view.box_size()[across] / sample.box.size()[across] - 1
                                            : lateral_strain(sample, view.x, facts_.setup->axis);
    frames_.lateral.emplace_back(value_at(facts_.curve.time, facts_.curve.strain, view.frame.time),
                                 facts_.setup->sign() * lateral);
  }

  double provenance_number(const std::string& key, double otherwise) const {
    const auto at = reader_.provenance().find(key);
    if (at == reader_.provenance().end()) return otherwise;
    try {
      return std::stod(at->second);
    } catch (const std::exception&) {
      throw DataError("trajectory: provenance key '" + key + "' is '" + at->second + "', a number was expected");
    }
  }

  int frame_at(double time) const {
    int best = 0;
    for (int k = 0; k < reader_.frames(); ++k)
      if (std::abs(frames_.times[k] - time) < std::abs(frames_.times[best] - time)) best = k;
    return best;
  }

  /// Of the two frames around the peak the one that carries more.
  int frame_at_peak() const {
    const double time = facts_.constants.time_at_peak;
    const auto stress = [&](int k) { return value_at_frame(facts_.curve.time, facts_.curve.stress, frames_.times[k]); };
    int before = 0;
    while (before + 1 < reader_.frames() && frames_.times[before + 1] <= time) ++before;
    const int after = std::min(before + 1, reader_.frames() - 1);
    return stress(after) > stress(before) ? after : before;
  }

  /// Start of damage, peak, after failure; first, middle and last frame where nothing breaks. Increasing, without repeats.
  std::vector<std::pair<int, std::string>> moments() const {
    const int last = reader_.frames() - 1;
    std::vector<std::pair<int, std::string>> chosen;
    const auto& events = reader_.events();
    if (facts_.setup && !events.empty()) {
      // the first frame that shows a break
      int damage = 0;
      while (damage < last && frames_.times[damage] < events.front().time) ++damage;
      const int peak = frame_at_peak();
      // well after failure, once the broken pieces have come apart
      const int end = last;
      if (damage < peak)
        chosen = {{damage, "first breaks"}, {peak, "peak stress"}, {end, "after failure"}};
      else if (peak < damage)
        chosen = {{peak, "peak stress"}, {damage, "first breaks"}, {end, "after failure"}};
      else
        chosen = {
            {frame_at(0.5 * facts_.constants.time_at_peak), "loading"}, {peak, "peak stress"}, {end, "after failure"}};
      if (!facts_.constants.strain_at_failure) chosen.back().second = "end";
    } else {
      chosen = {{0, "start"}, {last / 2, "middle"}, {last, "end"}};
    }
    chosen.erase(
        std::unique(chosen.begin(), chosen.end(), [](const auto& a, const auto& b) { return a.first >= b.first; }),
        chosen.end());
    return chosen;
  }

  std::string state_text(double time) const {
    if (!facts_.setup) {
      const ScaledUnit unit = scaled_unit_of(time);
      return fmt::format("t = {:.4g} {}", time / unit.first, unit.second);
    }
    const double strain = value_at(facts_.curve.time, facts_.curve.strain, time);
    const double stress = value_at_frame(facts_.curve.time, facts_.curve.stress, time);
    std::string text = fmt::format("\u03b5 = {:.3g} %", 100 * strain);
    if (facts_.constants.peak_stress > 0) {
      const double share = stress / facts_.constants.peak_stress;
      text += fmt::format(",  \u03c3 / \u03c3max = {:.2f}", std::abs(share) < 0.005 ? 0.0 : share);
    }
    return text;
  }

  using ScaledUnit = std::pair<double, std::string>;
  static ScaledUnit scaled_unit_of(double time) {
    if (time == 0 || time >= 1) return {1, "s"};
    return time >= 1e-3 ? ScaledUnit{1e-3, "ms"} : ScaledUnit{1e-6, "\u00b5s"};
  }

  void keep(const Paths& pages, const std::string& caption) {
    first_.insert(first_.end(), pages.begin(), pages.end());
    pictures_.push_back({pages.front(), caption});
  }

  void draw() {
    tell(0.82, "pictures");
    const Sample& sample = reader_.sample();
    const auto chosen = moments();
    std::vector<Frame> frames;
    for (const auto& [k, title] : chosen) frames.push_back(frame(k));
    std::vector<FrameView> views;
    for (const Frame& f : frames) views.emplace_back(sample, f);
    std::vector<Snapshot> snapshots;
    std::vector<double> times;
    const bool breaks = facts_.last->has("link_break_time");
    for (std::size_t k = 0; k < views.size(); ++k) {
      const double time = frames[k].time;
      std::string title = chosen[k].second;
      if (facts_.setup && views.size() > 1) title = fmt::format("({})  {}", static_cast<char>('a' + k), title);
      snapshots.push_back(
          {&views[k], title, state_text(time), breaks ? finder_->find(views[k]) : std::vector<Crack>{}});
      times.push_back(time);
    }
    const std::string what =
        breaks
            ? "Elastic energy of the cells (walls and core) over W\u2080, the energy at which one link breaks in pure "
              "opening; broken links in red, walls with their true thickness."
            : "Elastic energy of the cells (walls and core); walls with their true thickness.";
    const std::string opened = facts_.last->has("bar_broken") ? " Cells that a broken bar has opened are white." : "";
    keep(draw_snapshots(folder_ / "snapshots", snapshots, facts_.setup), what + opened);
    tell(0.87, "pictures");
    if (facts_.setup)
      keep(draw_stress_strain(folder_ / "stress_strain", facts_.curve, *facts_.setup, reader_.events(), times),
           "Nominal stress over engineering strain; the marks are the snapshots above.");
    if ((breaks && !facts_.cracks.empty()) || facts_.last->broken_bars()) {
      snapshots.back().title = "Final state";
      keep(draw_snapshots(folder_ / "final_state", {snapshots.back()}, facts_.setup), "The last frame.");
      keep(draw_crack_path(folder_ / "crack_path", *facts_.last, facts_.cracks, facts_.setup, facts_.curve),
           facts_.last->broken_bars()
               ? "Where links broke, and bars (marks across their walls, cells that they opened tinted), on the tissue "
                 "at rest, and in which order."
               : "Where links broke, on the tissue at rest, and in which order.");
    }
    if (!facts_.budget.time.empty())
      keep(draw_energy_ledger(
               folder_ / "energy_ledger", facts_.budget,
               facts_.curve.strain.size() == facts_.budget.time.size() ? facts_.curve.strain : std::vector<double>{}),
           "Where the work of the loads went.");
  }

  void write_tables() {
    tell(0.95, "tables");
    const auto title_at = reader_.provenance().find("title");
    const std::string title =
        title_at != reader_.provenance().end() && !title_at->second.empty() ? title_at->second : "lamella run";
    const auto write = [&](const std::string& name, const std::string& text) {
      write_text_file(folder_ / name, text);
      return folder_ / name;
    };
    if (options_.pictures)
      first_.insert(first_.begin(), write("report.html", report_html(title, pictures_, result_.summary,
                                                                     reader_.provenance(), reader_.ended())));
    if (!reader_.response().rows.empty()) first_.push_back(write("response.csv", response_csv(reader_.response())));
    if (!frames_.packing.empty()) first_.push_back(write("packing.csv", packing_csv(frames_.packing)));
    const bool bars = facts_.last->has("bar_broken");
    if (bars || facts_.last->has("link_break_time"))
      first_.push_back(
          write("events.csv", events_csv(reader_.events(), bars ? Breaks::kLinksAndBars : Breaks::kLinks)));
    std::vector<std::string> names;
    for (const auto* list : {&first_, &result_.files})
      for (const Path& file : *list) names.push_back(file.filename().string());
    first_.push_back(
        write("summary.json", summary_json(result_.summary, reader_.provenance(), reader_.ended(), names)));
  }

  TrajectoryReader reader_;
  Path folder_;
  const PostOptions& options_;
  FrameCompleter completer_;
  std::unique_ptr<CrackFinder> finder_;
  FrameFacts frames_;
  SummaryInputs facts_;
  Paths first_;  // report, pictures, tables
  std::vector<ReportPicture> pictures_;
  PostResult result_;
};

}  // namespace

PostResult post(const Path& trajectory, const Path& folder, const PostOptions& options) {
  return Post(trajectory, folder, options).run();
}

}  // namespace lamella
