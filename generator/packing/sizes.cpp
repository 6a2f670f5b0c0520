#include "generator/packing/sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

#include "generator/packing/distributions.h"
#include "generator/packing/random.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

bool is_family(const std::string& kind) {
  return kind == "uniform" || kind == "normal" || kind == "lognormal" || kind == "gamma" || kind == "weibull";
}

void check_family(const std::string& path, const std::string& kind, double mean, double cv,
                  std::vector<std::string>& faults) {
  if (!(cv >= 0 && cv <= largest_cv(kind)))
    faults.push_back(
        fmt::format("{}.cv = {}: a {} distribution of radii needs 0 <= cv <= {}", path, cv, kind, largest_cv(kind)));
  if (!(mean > 0) || !std::isfinite(mean))
    faults.push_back(fmt::format("{}.mean = {}: the mean radius must be positive", path, mean));
}

void check_table(const std::vector<Vec2>& table, std::vector<std::string>& faults) {
  const auto add = [&](std::size_t k, const std::string& what) {
    faults.push_back(
        fmt::format("sample.sizes.table: pair {} ({:.6g}, {:.6g}): {}", k + 1, table[k].x(), table[k].y(), what));
  };
  if (table.size() < 2)
    faults.push_back(
        fmt::format("sample.sizes.table: has {} pairs of radius and density; give two or more", table.size()));
  bool any = false;
  for (std::size_t k = 0; k < table.size(); ++k) {
    any = any || table[k].y() > 0;
    if (!table[k].allFinite())
      add(k, "must be finite");
    else if (table[k].x() < 0)
      add(k, "a radius must not be negative");
    else if (table[k].y() < 0)
      add(k, "a density must not be negative");
    else if (k > 0 && !(table[k].x() > table[k - 1].x()))
      add(k, "radii must increase");
  }
  if (!any && table.size() >= 2)
    faults.push_back("sample.sizes.table: all densities are 0; one at least must be positive");
}

void check_mixture(const std::vector<MixtureScene>& mixture, std::vector<std::string>& faults) {
  if (mixture.empty()) faults.push_back("sample.sizes.mixture: is empty; list at least one [[sample.sizes.mixture]]");
  double sum = 0;
  bool by_number = false, by_area = false;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const MixtureScene& part = mixture[k];
    const std::string path = fmt::format("sample.sizes.mixture[{}]", k);
    if (is_family(part.distribution))
      check_family(path, part.distribution, part.mean, part.cv, faults);
    else
      faults.push_back(
          fmt::format("{}.distribution = \"{}\": must be one of uniform, normal, lognormal, gamma, weibull", path,
                      part.distribution));
    if (part.share.has_value() == part.area_share.has_value()) {
      faults.push_back(path + ": needs share, by number, or area_share, and not both");
      continue;
    }
    (part.share ? by_number : by_area) = true;
    const double share = part.share ? *part.share : *part.area_share;
    if (!(share > 0 && share <= 1))
      faults.push_back(
          fmt::format("{}.{} = {}: must be positive, at most 1", path, part.share ? "share" : "area_share", share));
    sum += share;
  }
  if (by_number && by_area)
    faults.push_back("sample.sizes.mixture: mixes share and area_share; give one of them throughout");
  else if (!mixture.empty() && faults.empty() && std::abs(sum - 1) > 1e-6)
    faults.push_back(fmt::format("sample.sizes.mixture: the shares sum to {:.6g}; must be 1", sum));
}

void refuse_bad_sizes(const SizesScene& sizes, int count) {
  std::vector<std::string> faults;
  const std::string& kind = sizes.distribution;
  if (count < 1) faults.push_back(fmt::format("sample.packing.count = {}: must be at least 1", count));
  if (kind == "bidisperse") {
    check_family("sample.sizes", "uniform", sizes.mean, 0, faults);
    if (!(sizes.ratio >= 1) || !std::isfinite(sizes.ratio))
      faults.push_back(
          fmt::format("sample.sizes.ratio = {}: the large over the small radius must be at least 1", sizes.ratio));
    if (!(sizes.share >= 0 && sizes.share <= 1))
      faults.push_back(fmt::format("sample.sizes.share = {}: must lie in [0, 1]", sizes.share));
  } else if (kind == "file") {
    if (sizes.file.empty())
      faults.push_back("sample.sizes.file is missing: distribution \"file\" needs a file of radii, one a line");
  } else if (kind == "table") {
    check_table(sizes.table, faults);
  } else if (kind == "mixture") {
    check_mixture(sizes.mixture, faults);
  } else if (is_family(kind)) {
    check_family("sample.sizes", kind, sizes.mean, sizes.cv, faults);
  } else {
    faults.push_back(fmt::format(
        "sample.sizes.distribution = \"{}\": must be one of uniform, normal, lognormal, gamma, weibull, bidisperse, "
        "table, mixture, file",
        kind));
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

/// One radius from each of `count` equally probable classes, in rising order, at random within its class.
std::vector<double> stratified(const Quantile& quantile, int count, Random& random) {
  std::vector<double> radii(count);
  for (int k = 0; k < count; ++k) radii[k] = quantile((k + random.unit()) / count);
  return radii;
}

std::vector<double> bidisperse(const SizesScene& sizes, int count) {
  const int large = static_cast<int>(std::lround(sizes.share * count));
  const double small_radius = sizes.mean * count / (count + large * (sizes.ratio - 1));
  std::vector<double> radii(count, small_radius);
  std::fill(radii.begin(), radii.begin() + large, small_radius * sizes.ratio);
  return radii;
}

/// The file's radii themselves when there are as many as disks, otherwise equally spaced quantiles of them.
std::vector<double> from_file(const std::filesystem::path& path, int count) {
  std::vector<double> given = read_radii(path);
  std::sort(given.begin(), given.end());
  std::vector<double> radii(count);
  for (int k = 0; k < count; ++k)
    radii[k] = given[static_cast<std::size_t>((k + 0.5) / count * static_cast<double>(given.size()))];
  return radii;
}

/// How many disks each part has: the whole numbers next to its share by number, which sum to `count`.
std::vector<int> numbers_of(const std::vector<MixtureScene>& mixture, int count) {
  // By area: in proportion to the share over the mean area of a disk.
  std::vector<double> share;
  for (const MixtureScene& part : mixture)
    share.push_back(part.share ? *part.share : *part.area_share / (part.mean * part.mean * (1 + part.cv * part.cv)));
  const double sum = std::accumulate(share.begin(), share.end(), 0.0);
  // Rounded so that running sums are right to half a disk.
  std::vector<int> numbers;
  double running = 0;
  int so_far = 0;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    running += share[k] / sum;
    const int until = k + 1 == mixture.size() ? count : static_cast<int>(std::lround(running * count));
    numbers.push_back(until - so_far);
    so_far = until;
    if (numbers.back() < 1)
      throw SceneError(
          fmt::format("sample.sizes.mixture[{}]: has {:.2g} of {} disks: less than one; ask for more disks, "
                      "or for a larger share",
                      k, share[k] / sum * count, count));
  }
  return numbers;
}

Sizes mixed(const std::vector<MixtureScene>& mixture, int count, Random& random) {
  Sizes sizes;
  const std::vector<int> numbers = numbers_of(mixture, count);
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const MixtureScene& part = mixture[k];
    const auto radii = stratified(quantile_of(part.distribution, part.mean, part.cv), numbers[k], random);
    sizes.radius.insert(sizes.radius.end(), radii.begin(), radii.end());
    sizes.group.insert(sizes.group.end(), radii.size(), part.group);
    if (!part.area_share) continue;
    sizes.part.insert(sizes.part.end(), radii.size(), static_cast<int>(k));
    sizes.area_share.push_back(*part.area_share);
  }
  return sizes;
}

}  // namespace

Sizes draw_sizes(const SizesScene& scene, int count, std::uint64_t seed, const Scene& for_paths) {
  refuse_bad_sizes(scene, count);
  Random random(seed);
  Sizes sizes;
  if (scene.distribution == "file")
    sizes.radius = from_file(for_paths.resolve(scene.file), count);
  else if (scene.distribution == "bidisperse")
    sizes.radius = bidisperse(scene, count);
  else if (scene.distribution == "table")
    sizes.radius = stratified(quantile_of_table(scene.table), count, random);
  else if (scene.distribution == "mixture")
    sizes = mixed(scene.mixture, count, random);
  else
    sizes.radius = stratified(quantile_of(scene.distribution, scene.mean, scene.cv), count, random);
  for (std::size_t k = sizes.radius.size(); k > 1; --k) {
    const std::size_t other = random.below(k);
    std::swap(sizes.radius[k - 1], sizes.radius[other]);
    if (!sizes.group.empty()) std::swap(sizes.group[k - 1], sizes.group[other]);
    if (!sizes.part.empty()) std::swap(sizes.part[k - 1], sizes.part[other]);
  }
  return sizes;
}

std::vector<double> draw_radii(const SizesScene& sizes, int count, std::uint64_t seed, const Scene& for_paths) {
  return draw_sizes(sizes, count, seed, for_paths).radius;
}

std::vector<double> read_radii(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw DataError(fmt::format("{}: cannot be read; it should hold one radius a line", path.string()));
  std::vector<double> radii;
  std::vector<std::string> faults;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line = line.substr(0, line.find('#'));
    std::istringstream words(line);
    std::string word, more;
    if (!(words >> word)) continue;
    char* end = nullptr;
    const double radius = std::strtod(word.c_str(), &end);
    if (*end != '\0' || words >> more)
      faults.push_back(fmt::format("{}:{}: \"{}\": must be one number, the radius", path.string(), number, line));
    else if (!(radius > 0) || !std::isfinite(radius))
      faults.push_back(fmt::format("{}:{}: {}: a radius must be positive and finite", path.string(), number, word));
    else
      radii.push_back(radius);
  }
  if (faults.empty() && radii.empty())
    faults.push_back(path.string() + ": holds no radius: must have at least one, one a line");
  if (!faults.empty()) throw SceneError(std::move(faults));
  return radii;
}

}  // namespace lamella
