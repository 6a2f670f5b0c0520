#include "generator/image/laguerre_fit.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "generator/image/regions.h"

namespace lamella {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// All sides of pixels between cells a < b, as the sum of (1, -2 m)(1, -2 m)^T over their middles m.
struct PixelWall {
  Index a = 0, b = 0;
  Matrix3d sides = Matrix3d::Zero();
};

/// Areas, centres and walls of labels, in units and about an origin that keep numbers near 1.
struct Measures {
  double unit = 1;  // mean diameter of a cell [pixels]
  Vec2 origin = Vec2::Zero();
  double count = 0;  // of sides of pixels
  std::vector<double> area;
  std::vector<Vec2> centre;
  std::vector<PixelWall> walls;
};

Measures measure(const LabelImage& labels) {
  Measures m;
  const std::size_t cells = labels.number.size();
  m.unit = std::sqrt(static_cast<double>(labels.pixels()) / static_cast<double>(cells));
  m.origin = Vec2(labels.width, labels.height) / 2;
  m.area.assign(cells, 0);
  m.centre.assign(cells, Vec2::Zero());
  std::unordered_map<std::uint64_t, Matrix3d> sides;
  const auto place = [&](double x, double y) -> Vec2 { return (Vec2(x, labels.height - y) - m.origin) / m.unit; };
  const auto meet = [&](Index a, Index b, const Vec2& middle) {
    if (a == b) return;
    const auto key = static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
    const Vector3d row(1, -2 * middle.x(), -2 * middle.y());
    sides.try_emplace(key, Matrix3d::Zero()).first->second += row * row.transpose();
    ++m.count;
  };
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      const std::size_t k = labels.at(x, y);
      const Index cell = labels.cell[k];
      m.area[cell] += 1;
      m.centre[cell] += place(x + 0.5, y + 0.5);
      if (x > 0) meet(labels.cell[k - 1], cell, place(x, y + 0.5));
      if (y > 0) meet(labels.cell[k - labels.width], cell, place(x + 0.5, y));
    }
  for (std::size_t c = 0; c < cells; ++c) {
    m.centre[c] /= m.area[c];
    m.area[c] /= m.unit * m.unit;
  }
  for (const auto& [key, sum] : sides)
    m.walls.push_back({static_cast<Index>(key >> 32), static_cast<Index>(key & 0xffffffff), sum});
  std::sort(m.walls.begin(), m.walls.end(),
            [](const PixelWall& p, const PixelWall& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
  return m;
}

/// Half the sum of squared distances r = (dc - 2 m . dx) / (2 |dx|) of all middles m, d being differences across a wall; with
/// the Gauss-Newton Hessian and gradient where they are asked for. Unknowns are (c, x, y) of every cell.
double half_square(const Measures& m, const VectorXd& u, VectorXd* gradient,
                   std::vector<Eigen::Triplet<double>>* hessian) {
  double sum = 0;
  if (gradient) gradient->setZero(u.size());
  if (hessian) hessian->clear();
  for (const PixelWall& wall : m.walls) {
    const Vector3d d = u.segment<3>(3 * wall.a) - u.segment<3>(3 * wall.b);
    const double square = d.tail<2>().squaredNorm();
    const Vector3d force = wall.sides * d / (4 * square);
    const double energy = d.dot(force);
    sum += energy / 2;
    if (!gradient) continue;
    const Vector3d e(0, d.y() / square, d.z() / square);  // |dx| changes, too
    const Vector3d slope = force - energy * e;
    gradient->segment<3>(3 * wall.a) += slope;
    gradient->segment<3>(3 * wall.b) -= slope;
    const Matrix3d block =
        wall.sides / (4 * square) - force * e.transpose() - e * force.transpose() + energy * e * e.transpose();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const auto add = [&](Index p, Index q, double value) {
          if (3 * p + i >= 3 * q + j) hessian->emplace_back(3 * p + i, 3 * q + j, value);
        };
        add(wall.a, wall.a, block(i, j));
        add(wall.b, wall.b, block(i, j));
        add(wall.a, wall.b, -block(i, j));
        add(wall.b, wall.a, -block(i, j));
      }
  }
  return sum;
}

/// Levenberg-Marquardt from sites at the centres and weights by the areas. Returns the number of steps.
int minimise(const Measures& m, VectorXd& u, const std::function<void(double)>& progress) {
  constexpr int most = 60;
  constexpr double enough = 1e-5;  // relative decrease
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  VectorXd gradient;
  std::vector<Eigen::Triplet<double>> entries;
  double damping = 1e-3;
  for (int step = 0; step < most; ++step) {
    if (progress) progress(static_cast<double>(step) / most);
    const double before = half_square(m, u, &gradient, &entries);
    Eigen::SparseMatrix<double> hessian(u.size(), u.size());
    for (Index k = 0; k < static_cast<Index>(u.size()); ++k) entries.emplace_back(k, k, 0);
    hessian.setFromTriplets(entries.begin(), entries.end());
    const VectorXd diagonal = hessian.diagonal();
    const double floor = 1e-9 * diagonal.maxCoeff() + 1e-300;
    if (step == 0) solver.analyzePattern(hessian);
    double after = before;
    while (damping < 1e12) {
      for (Index k = 0; k < static_cast<Index>(u.size()); ++k)
        hessian.coeffRef(k, k) = diagonal[k] + damping * diagonal[k] + floor;
      solver.factorize(hessian);
      if (solver.info() == Eigen::Success) {
        const VectorXd tried = u - solver.solve(gradient);
        after = half_square(m, tried, nullptr, nullptr);
        if (after < before) {
          u = tried;
          damping = std::max(damping / 10, 1e-9);
          break;
        }
      }
      damping *= 10;
    }
    if (!(after < before * (1 - enough))) return step + 1;
  }
  return most;
}

/// Of the equivalent sites s x + t, those nearest to the centres, and then as many times smaller as keeps them in the picture.
void choose_representative(const Measures& m, const Vec2& half, VectorXd& u) {
  const auto cells = static_cast<Index>(m.area.size());
  Vec2 mean = Vec2::Zero(), centre = Vec2::Zero();
  for (Index c = 0; c < cells; ++c) {
    mean += u.segment<2>(3 * c + 1) / cells;
    centre += m.centre[c] / cells;
  }
  double along = 0, square = 0;
  for (Index c = 0; c < cells; ++c) {
    const Vec2 x = u.segment<2>(3 * c + 1) - mean;
    along += x.dot(m.centre[c] - centre);
    square += x.squaredNorm();
  }
  double scale = along > 0 && square > 0 ? along / square : 1;
  for (Index c = 0; c < cells; ++c) {
    const Vec2 x = u.segment<2>(3 * c + 1) - mean;
    for (int k = 0; k < 2; ++k) {
      const double room = x[k] > 0 ? half[k] - centre[k] : half[k] + centre[k];
      if (scale * std::abs(x[k]) > 0.999 * room) scale = 0.999 * room / std::abs(x[k]);
    }
  }
  // c - 2 p . x takes a factor, and a term that is the same for all cells: c' = s c, x' = s x + t.
  for (Index c = 0; c < cells; ++c) {
    u[3 * c] *= scale;
    u.segment<2>(3 * c + 1) = scale * (u.segment<2>(3 * c + 1) - mean) + centre;
  }
}

}  // namespace

LaguerreFit fit_laguerre(const LabelImage& labels, const std::function<void(double)>& progress) {
  const Measures m = measure(labels);
  const auto cells = static_cast<Index>(m.area.size());
  VectorXd u(3 * cells);
  for (Index c = 0; c < cells; ++c) {
    u[3 * c] = m.centre[c].squaredNorm() - m.area[c] / std::numbers::pi;
    u.segment<2>(3 * c + 1) = m.centre[c];
  }
  LaguerreFit fit;
  if (cells > 1) {
    fit.steps = minimise(m, u, progress);
    fit.rms = m.unit * std::sqrt(2 * half_square(m, u, nullptr, nullptr) / m.count);
    choose_representative(m, Vec2(labels.width, labels.height) / (2 * m.unit), u);
  }
  double least = std::numeric_limits<double>::infinity();  // weight; radii are roots of what exceeds it
  std::vector<double> weight;
  for (Index c = 0; c < cells; ++c) {
    weight.push_back(u.segment<2>(3 * c + 1).squaredNorm() - u[3 * c]);
    least = std::min(least, weight.back());
  }
  for (Index c = 0; c < cells; ++c)
    fit.disks.push_back({m.origin + m.unit * u.segment<2>(3 * c + 1), m.unit * std::sqrt(weight[c] - least + 1e-4)});
  return fit;
}

Index part_background(LabelImage& labels) {
  const auto first = static_cast<Index>(labels.number.size());
  std::size_t covered = 0;
  for (const Index cell : labels.cell) covered += cell != kBackground;
  if (covered == labels.pixels()) return first;
  const int side = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(covered) / first)));
  const int columns = labels.width / side + 1;
  LabelImage squares = labels;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x)
      if (labels.cell[labels.at(x, y)] == kBackground)
        squares.cell[squares.at(x, y)] = first + y / side * columns + x / side;
  const Regions regions = regions_of(squares);
  std::vector<Index> name(regions.cell.size(), -1);
  for (std::size_t k = 0; k < labels.pixels(); ++k) {
    if (labels.cell[k] != kBackground) continue;
    Index& cell = name[regions.of[k]];
    if (cell < 0) {
      cell = static_cast<Index>(labels.number.size());
      labels.number.push_back(0);
    }
    labels.cell[k] = cell;
  }
  return first;
}

}  // namespace lamella
