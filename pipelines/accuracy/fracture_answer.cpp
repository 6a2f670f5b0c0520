#include "pipelines/accuracy/fracture_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "postproc/quantities/material_constants.h"

namespace lamella {

FractureAnswer fracture_answer_of(const StudyRun& run) {
  const std::vector<double> strain = run.column("strain"), stress = run.column("stress");
  const std::vector<double> broken = run.column("broken_links");
  FractureAnswer answer;
  const auto peak = std::max_element(stress.begin(), stress.end()) - stress.begin();
  answer.peak_stress = stress[peak], answer.strain_at_peak = strain[peak], answer.work = run.last("work");
  answer.first_break_strain = answer.first_break_stress = std::numeric_limits<double>::quiet_NaN();
  const auto& events = run.reader.events();
  if (!events.empty()) {
    // From its time: in time, an event's own strain is that of the row after it.
    answer.first_break_strain = value_at(run.column("time"), strain, events.front().time);
    answer.first_link = events.front().link;
  }
  const auto first = std::find_if(broken.begin(), broken.end(), [](double count) { return count > 0; });
  if (first != broken.end() && first != broken.begin()) answer.first_break_stress = stress[first - broken.begin() - 1];
  for (const Event& event : events)
    if (event.link >= 0)
      answer.links.insert(event.link), answer.walls.insert(run.reader.sample().links[event.link].wall);
  return answer;
}

double overlap(const std::set<int>& a, const std::set<int>& b) {
  const auto common = static_cast<double>(std::count_if(a.begin(), a.end(), [&](int k) { return b.count(k) > 0; }));
  const double either = static_cast<double>(a.size() + b.size()) - common;
  return either > 0 ? common / either : 1;
}

}  // namespace lamella
