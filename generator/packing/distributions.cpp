#include "generator/packing/distributions.h"

#include <algorithm>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace lamella {
namespace {

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

/// F(x) = 1 - exp(-(x / scale)^shape); the coefficient of variation falls with the shape.
struct Weibull {
  double shape, scale;  // scale: of mean 1

  explicit Weibull(double cv) {
    // In the logarithm of the shape: cv 3.1 at 0.4, about 1.28 / shape at large ones.
    double lo = std::log(0.4), hi = std::log(2 + 2 / cv);
    for (int i = 0; i < 200; ++i) (cv_at(std::exp((lo + hi) / 2)) > cv ? lo : hi) = (lo + hi) / 2;
    shape = std::exp((lo + hi) / 2);
    scale = 1 / boost::math::tgamma(1 + 1 / shape);
  }
  double operator()(double p) const { return scale * std::pow(-std::log1p(-p), 1 / shape); }

 private:
  static double cv_at(double shape) {
    // E[x^2] / E[x]^2 - 1, by logarithms: at large shapes both are near 1.
    return std::sqrt(std::expm1(boost::math::lgamma(1 + 2 / shape) - 2 * boost::math::lgamma(1 + 1 / shape)));
  }
};

}  // namespace

double largest_cv(const std::string& distribution) {
  // Uniform: radii stay positive. Normal, cut off at 0: the limit is that of an exponential. The others: a range that packs.
  return distribution == "uniform" ? 0.577 : distribution == "normal" ? 0.95 : 3;
}

Quantile quantile_of(const std::string& distribution, double mean, double cv) {
  if (cv == 0) return [mean](double) { return mean; };
  if (distribution == "uniform") return [=](double p) { return mean * uniform_quantile(p, cv); };
  if (distribution == "normal") return [mean, normal = TruncatedNormal(cv)](double p) { return mean * normal(p); };
  if (distribution == "weibull") return [mean, weibull = Weibull(cv)](double p) { return mean * weibull(p); };
  if (distribution == "gamma") return [=](double p) { return mean * gamma_quantile(p, cv); };
  return [=](double p) { return mean * lognormal_quantile(p, cv); };
}

Quantile quantile_of_table(const std::vector<Vec2>& table) {
  std::vector<double> below{0};  // area under the density left of each point
  for (std::size_t k = 1; k < table.size(); ++k)
    below.push_back(below.back() + (table[k].x() - table[k - 1].x()) * (table[k].y() + table[k - 1].y()) / 2);
  return [table, below](double p) {
    const double area = p * below.back();
    // The last piece that begins below: pieces without area are never chosen.
    const auto next = std::lower_bound(below.begin() + 1, below.end() - 1, area);
    const auto k = static_cast<std::size_t>(next - below.begin());
    const Vec2 &from = table[k - 1], &to = table[k];
    const double rest = area - below[k - 1], slope = (to.y() - from.y()) / (to.x() - from.x());
    // rest = y t + slope t^2 / 2, by the form that no slope makes cancel.
    const double root = from.y() + std::sqrt(std::max(0.0, from.y() * from.y() + 2 * slope * rest));
    return std::min(root > 0 ? from.x() + 2 * rest / root : from.x(), to.x());
  };
}

}  // namespace lamella
