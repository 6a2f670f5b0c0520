#include "postproc/quantities/loop_around.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>

namespace lamella {
namespace {

constexpr int kSheets =
    5;  // of the unrolled cylinder, -2 to 2: a way that goes back and forth once more is never the shortest
constexpr int kHome = kSheets / 2;

struct Step {
  Index edge = -1;
  std::size_t from = 0;
};

}  // namespace

// A closed way around passes an edge that goes around. So the shortest is the shortest way from such an edge's end, at home on the
// unrolled cylinder, to the same vertex one sheet on (Dijkstra).
std::vector<Index> shortest_loop_around(const std::vector<WoundEdge>& edges) {
  std::map<Index, std::size_t> place;
  for (const WoundEdge& edge : edges)
    for (const Index v : {edge.from, edge.to}) place.try_emplace(v, place.size());
  std::vector<std::vector<Index>> at(place.size());
  std::vector<std::size_t> starts;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::size_t from = place[edges[e].from], to = place[edges[e].to];
    at[from].push_back(static_cast<Index>(e));
    if (to != from) at[to].push_back(static_cast<Index>(e));
    if (edges[e].around != 0) starts.push_back(from);
  }
  std::sort(starts.begin(), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());

  std::vector<Index> best;
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::size_t start : starts) {
    std::vector<double> distance(kSheets * place.size(), std::numeric_limits<double>::infinity());
    std::vector<Step> by(distance.size());
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const std::size_t source = kSheets * start + kHome, target = source + 1;
    distance[source] = 0;
    open.push({0.0, source});
    while (!open.empty()) {
      const auto [here, v] = open.top();
      open.pop();
      if (v == target || here >= shortest) break;
      if (here > distance[v]) continue;
      const int sheet = static_cast<int>(v % kSheets);
      const auto take = [&](Index e, std::size_t to, int around) {
        const int there = sheet + around;
        if (there < 0 || there >= kSheets) return;
        const std::size_t w = kSheets * to + static_cast<std::size_t>(there);
        const double further = here + edges[e].length;
        if (further >= distance[w]) return;
        distance[w] = further, by[w] = {e, v};
        open.push({further, w});
      };
      for (const Index e : at[v / kSheets]) {
        const std::size_t from = place[edges[e].from], to = place[edges[e].to];
        if (from == v / kSheets) take(e, to, edges[e].around);
        if (to == v / kSheets) take(e, from, -edges[e].around);
      }
    }
    if (!(distance[target] < shortest)) continue;
    shortest = distance[target];
    best.clear();
    for (std::size_t v = target; v != source; v = by[v].from) best.push_back(by[v].edge);
    std::reverse(best.begin(), best.end());
  }
  return best;
}

}  // namespace lamella
