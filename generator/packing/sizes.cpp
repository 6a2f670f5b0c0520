#include "generator/packing/sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

#include "generator/packing/random.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

/// A radius per probability in (0, 1), in units of the mean where there is one.
using Quantile = double (*)(double probability, double cv);

double uniform_quantile(double p, double cv) { return 1 + std::sqrt(3.0) * cv * (2 * p - 1); }

double lognormal_quantile(double p, double cv) {
  const double variance = std::log1p(cv * cv);
  return std::exp(std::sqrt(variance) * boost::math::quantile(boost::math::normal(), p) - variance / 2);
}

double gamma_quantile(double p, double cv) {
  return boost::math::quantile(boost::math::gamma_distribution<>(1 / (cv * cv), cv * cv), p);
}

/// A normal distribution of mean a and deviation 1, cut off at 0: its coefficient of variation is
/// sqrt(1 - a l - l^2) / (a + l) with l = density(a) / probability(a), and falls with a.
struct TruncatedNormal {
  double shift;  // a
  double mean;   // a + l

  explicit TruncatedNormal(double cv) {
    double lo = -8, hi = 2 / cv;  // CV 0.98 at a = -8; at large a it is 1 / a
    for (int i = 0; i < 200; ++i) (cv_at((lo + hi) / 2) > cv ? lo : hi) = (lo + hi) / 2;
    shift = (lo + hi) / 2;
    mean = shift + hazard(shift);
  }
  double operator()(double p) const {
    const boost::math::normal normal;
    // By the upper tail, which keeps its digits for every a.
    const double above_zero = boost::math::cdf(normal, shift);
    return (shift + boost::math::quantile(boost::math::complement(normal, (1 - p) * above_zero))) / mean;
  }

 private:
  static double hazard(double a) {
    return boost::math::pdf(boost::math::normal(), a) / boost::math::cdf(boost::math::normal(), a);
  }
  static double cv_at(double a) {
    const double l = hazard(a);
    return std::sqrt(std::max(0.0, 1 - a * l - l * l)) / (a + l);
  }
};

void refuse_bad_sizes(const SizesScene& sizes, int count) {
  std::vector<std::string> faults;
  const std::string& kind = sizes.distribution;
  if (count < 1) faults.push_back(fmt::format("sample.packing.count = {}: must be at least 1", count));
  if (kind == "bidisperse") {
    if (!(sizes.ratio >= 1) || !std::isfinite(sizes.ratio))
      faults.push_back(
          fmt::format("sample.sizes.ratio = {}: the large over the small radius must be at least 1", sizes.ratio));
    if (!(sizes.share >= 0 && sizes.share <= 1))
      faults.push_back(fmt::format("sample.sizes.share = {}: must lie in [0, 1]", sizes.share));
  } else if (kind == "file") {
    if (sizes.file.empty())
      faults.push_back("sample.sizes.file is missing: distribution \"file\" needs a file of radii, one a line");
  } else if (kind == "uniform" || kind == "normal" || kind == "lognormal" || kind == "gamma") {
    // Uniform: radii stay positive. Normal, cut off at 0: the limit is that of an exponential. The others: a range that packs.
    const double limit = kind == "uniform" ? 0.577 : kind == "normal" ? 0.95 : 3;
    if (!(sizes.cv >= 0 && sizes.cv <= limit))
      faults.push_back(
          fmt::format("sample.sizes.cv = {}: a {} distribution of radii needs 0 <= cv <= {}", sizes.cv, kind, limit));
  } else {
    faults.push_back(fmt::format(
        "sample.sizes.distribution = \"{}\": must be one of uniform, normal, lognormal, gamma, bidisperse, file",
        kind));
  }
  if (kind != "file" && (!(sizes.mean > 0) || !std::isfinite(sizes.mean)))
    faults.push_back(fmt::format("sample.sizes.mean = {}: the mean radius must be positive", sizes.mean));
  if (!faults.empty()) throw SceneError(std::move(faults));
}

/// One radius from each of `count` equally probable classes, in rising order, at random within its class.
std::vector<double> stratified(const SizesScene& sizes, int count, Random& random) {
  std::vector<double> probability(count);
  for (int k = 0; k < count; ++k) probability[k] = (k + random.unit()) / count;
  std::vector<double> radii(count, sizes.mean);
  if (sizes.cv == 0) return radii;
  if (sizes.distribution == "normal") {
    const TruncatedNormal quantile(sizes.cv);
    for (int k = 0; k < count; ++k) radii[k] *= quantile(probability[k]);
  } else {
    const Quantile quantile = sizes.distribution == "uniform"     ? uniform_quantile
                              : sizes.distribution == "lognormal" ? lognormal_quantile
                                                                  : gamma_quantile;
    for (int k = 0; k < count; ++k) radii[k] *= quantile(probability[k], sizes.cv);
  }
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

}  // namespace

std::vector<double> draw_radii(const SizesScene& sizes, int count, std::uint64_t seed, const Scene& for_paths) {
  refuse_bad_sizes(sizes, count);
  Random random(seed);
  std::vector<double> radii = sizes.distribution == "file"         ? from_file(for_paths.resolve(sizes.file), count)
                              : sizes.distribution == "bidisperse" ? bidisperse(sizes, count)
                                                                   : stratified(sizes, count, random);
  for (std::size_t k = radii.size(); k > 1; --k) std::swap(radii[k - 1], radii[random.below(k)]);
  return radii;
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
