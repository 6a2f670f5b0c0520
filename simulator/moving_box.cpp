#include "simulator/moving_box.h"

namespace lamella {
namespace {

Field carried(const Sample& sample, Field field, double sign) {
  if (!box_moves(sample, field)) return field;
  const Vec2 growth = box_growth(sample, field);
  for (std::size_t i = 0; i < sample.x.size(); ++i) field.add(i, sign * carried_share(sample, i).cwiseProduct(growth));
  return field;
}

}  // namespace

Field relative(const Sample& sample, Field x) { return carried(sample, std::move(x), -1); }
Field absolute(const Sample& sample, Field w) { return carried(sample, std::move(w), +1); }

void make_relative(const Sample& sample, Field& f) {
  if (!box_moves(sample, f)) return;
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < sample.x.size(); ++i) sum += carried_share(sample, i).cwiseProduct(f.at(i));
  f.add(sample.x.size(), sum);
}

std::vector<double> rows_of_nodes(const Sample& sample, const Field& field) {
  std::vector<double> rows = rows_from(field);
  rows.resize(2 * sample.x.size());
  return rows;
}

void append_box(Field& field, const Vec2& entry) {
  field.x.push_back(entry.x());
  field.y.push_back(entry.y());
}

}  // namespace lamella
