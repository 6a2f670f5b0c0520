#include "simulator/trajectory/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

std::size_t size_of(const NamedArray& array) {
  return std::visit([](const auto& data) { return data.size(); }, array.data);
}

/// First value that is no number, as its row; nothing when all are finite.
std::optional<std::size_t> first_not_finite(const NamedArray& array) {
  const auto* data = std::get_if<std::vector<double>>(&array.data);
  if (!data) return std::nullopt;
  for (std::size_t i = 0; i < data->size(); ++i)
    if (!std::isfinite((*data)[i])) return i / static_cast<std::size_t>(array.components);
  return std::nullopt;
}

/// Rows that `per` asks for; nothing where the frame itself decides (contacts, grips, model).
std::optional<std::size_t> rows_for(const std::string& per, const Counts& counts) {
  if (per == "node" || per == "segment") return counts.nodes;
  if (per == "cell") return counts.cells;
  if (per == "link") return counts.links;
  return std::nullopt;
}

void check_indices(const Frame& frame, const std::string& name, std::size_t count, const std::string& where) {
  const NamedArray* array = frame.arrays.find(name);
  if (!array) return;
  for (const auto index : frame.arrays.ints(name))
    if (index < 0 || static_cast<std::size_t>(index) >= count)
      throw DataError(fmt::format("{}: '{}' holds {}; must be from 0 to {}", where, name, index, count - 1));
}

template <typename T, typename Get>
std::vector<T> column(const std::vector<Event>& events, Get get) {
  std::vector<T> values;
  values.reserve(events.size());
  for (const auto& event : events) values.push_back(get(event));
  return values;
}

template <typename T>
void check_length(const h5::Node& group, const std::string& name, const std::vector<T>& values, std::size_t rows) {
  if (values.size() != rows)
    throw DataError(fmt::format("{}: array '{}' has {} rows; must have {}, as the others", group.where(), name,
                                values.size(), rows));
}

}  // namespace

Counts counts_of(const Sample& sample) {
  return {sample.x.size(), static_cast<std::size_t>(sample.cells()), sample.links.size()};
}

void write_arrays(h5::Node& group, const ArraySet& arrays) {
  for (const auto& array : arrays.all()) {
    std::visit([&](const auto& data) { group.write(array.name, data, array.components); }, array.data);
    group.write_text(array.name + "@unit", array.unit);
    group.write_text(array.name + "@per", array.per);
  }
}

ArraySet read_arrays(const h5::Node& group) {
  ArraySet arrays;
  for (const auto& name : group.names()) {
    NamedArray array{name, group.text(name + "@unit"), group.text(name + "@per"), group.columns(name), {}};
    switch (group.kind(name)) {
      case 'd':
        array.data = group.doubles(name, array.components);
        break;
      case 'l':
        array.data = group.longs(name, array.components);
        break;
      default:
        array.data = group.ints(name, array.components);
        break;
    }
    arrays.add(std::move(array));
  }
  return arrays;
}

void check_frame(const Frame& frame, const Counts& counts, const std::string& where) {
  const NamedArray* x = frame.arrays.find("x");
  if (!x || x->per != "node" || x->components != 2 || !std::holds_alternative<std::vector<double>>(x->data))
    throw DataError(fmt::format("{}: array 'x', two numbers per node, is missing", where));
  std::map<std::string, std::size_t> free_rows;  // the first array decides
  for (const auto& array : frame.arrays.all()) {
    const std::size_t components = static_cast<std::size_t>(std::max(array.components, 1));
    const std::size_t rows = size_of(array) / components;
    auto expected = rows_for(array.per, counts);
    if (!expected && (array.per == "contact" || array.per == "grip"))
      expected = free_rows.emplace(array.per, rows).first->second;
    if (!expected && array.per != "model")
      throw DataError(
          fmt::format("{}: array '{}' is per '{}'; must be per node, segment, cell, link, contact, grip or model",
                      where, array.name, array.per));
    if ((expected && rows != *expected) || rows * components != size_of(array))
      throw DataError(fmt::format("{}: array '{}' has {} values of {} components; must have {} rows, one per {}", where,
                                  array.name, size_of(array), components, expected.value_or(rows), array.per));
    if (const auto row = first_not_finite(array))
      throw DataError(
          fmt::format("{}: array '{}' of {} {} is not a finite number", where, array.name, array.per, *row));
  }
  check_indices(frame, "contact_node", counts.nodes, where);
  check_indices(frame, "contact_cell", counts.cells, where);
}

void check_order(const std::optional<Instant>& last, const Instant& next, const std::string& where) {
  if (!std::isfinite(next.time)) throw DataError(fmt::format("{}: the time is not a finite number", where));
  if (!last) return;
  if (next.stage < last->stage)
    throw DataError(
        fmt::format("{}: stage {} follows stage {}; stages must not go back", where, next.stage, last->stage));
  if (next.time > last->time || (next.time == last->time && next.stage > last->stage)) return;
  throw DataError(fmt::format("{}: time {} s follows {} s; times must increase", where, next.time, last->time));
}

void write_events(h5::Node& group, const std::vector<Event>& events) {
  std::vector<double> position;
  for (const auto& event : events) position.push_back(event.position.x()), position.push_back(event.position.y());
  group.write("time", column<double>(events, [](const Event& e) { return e.time; }));
  group.write("step", column<std::int64_t>(events, [](const Event& e) { return e.step; }));
  group.write("stage", column<std::int32_t>(events, [](const Event& e) { return e.stage; }));
  group.write("link", column<std::int32_t>(events, [](const Event& e) { return e.link; }));
  // Files of scenes in which no bar breaks look as they did before bars could.
  if (std::any_of(events.begin(), events.end(), [](const Event& e) { return e.bar >= 0; }))
    group.write("bar", column<std::int32_t>(events, [](const Event& e) { return e.bar; }));
  group.write("position", position, 2);
  group.write("f_n", column<double>(events, [](const Event& e) { return e.f_n; }));
  group.write("f_t", column<double>(events, [](const Event& e) { return e.f_t; }));
  group.write("mode_mix", column<double>(events, [](const Event& e) { return e.mode_mix; }));
  group.write("energy", column<double>(events, [](const Event& e) { return e.energy; }));
  group.write("strain", column<double>(events, [](const Event& e) { return e.strain; }));
  // Likewise those of runs in time.
  if (std::any_of(events.begin(), events.end(), [](const Event& e) { return e.avalanche >= 0; })) {
    group.write("avalanche", column<std::int64_t>(events, [](const Event& e) { return e.avalanche; }));
    group.write("place", column<std::int64_t>(events, [](const Event& e) { return e.place; }));
    group.write("released", column<double>(events, [](const Event& e) { return e.released; }));
  }
}

std::vector<Event> read_events(const h5::Node& group) {
  const auto time = group.doubles("time");
  const auto longs = [&](const std::string& name) {
    auto values = group.longs(name);
    check_length(group, name, values, time.size());
    return values;
  };
  const auto ints = [&](const std::string& name) {
    auto values = group.ints(name);
    check_length(group, name, values, time.size());
    return values;
  };
  const auto doubles = [&](const std::string& name, int columns) {
    auto values = group.doubles(name, columns);
    check_length(group, name, values, time.size() * static_cast<std::size_t>(columns));
    return values;
  };
  const auto step = longs("step");
  const auto stage = ints("stage"), link = ints("link");
  const auto names = group.names();
  const auto has = [&](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  const auto bar = has("bar") ? ints("bar") : std::vector<std::int32_t>(time.size(), -1);
  const auto position = doubles("position", 2);
  const auto f_n = doubles("f_n", 1), f_t = doubles("f_t", 1), mode_mix = doubles("mode_mix", 1);
  const auto energy = doubles("energy", 1), strain = doubles("strain", 1);
  const std::vector<std::int64_t> none(time.size(), -1);
  const auto avalanche = has("avalanche") ? longs("avalanche") : none, place = has("place") ? longs("place") : none;
  const auto released = has("released") ? doubles("released", 1) : std::vector<double>(time.size(), 0.0);
  std::vector<Event> events(time.size());
  for (std::size_t i = 0; i < time.size(); ++i) {
    events[i] = {.time = time[i],
                 .step = step[i],
                 .link = link[i],
                 .bar = bar[i],
                 .position = {position[2 * i], position[2 * i + 1]},
                 .f_n = f_n[i],
                 .f_t = f_t[i],
                 .mode_mix = mode_mix[i],
                 .energy = energy[i],
                 .strain = strain[i],
                 .stage = stage[i],
                 .avalanche = avalanche[i],
                 .place = place[i],
                 .released = released[i]};
  }
  return events;
}

void check_event(const Event& event, const Counts& counts, const std::string& where) {
  if (event.bar >= 0 && (event.link != -1 || static_cast<std::size_t>(event.bar) >= counts.nodes))
    throw DataError(fmt::format("{}: an event names bar {} and link {}; it must name one of {} bars and link -1", where,
                                event.bar, event.link, counts.nodes));
  if (event.bar < 0 && (event.link < 0 || static_cast<std::size_t>(event.link) >= counts.links))
    throw DataError(fmt::format("{}: an event names link {}; there are {}", where, event.link, counts.links));
  for (const double value : {event.time, event.position.x(), event.position.y(), event.f_n, event.f_t, event.mode_mix,
                             event.energy, event.strain, event.released})
    if (!std::isfinite(value))
      throw DataError(fmt::format("{}: the break of {} {} holds a value that is not a finite number", where,
                                  event.bar >= 0 ? "bar" : "link", event.bar >= 0 ? event.bar : event.link));
}

void write_response(h5::Node& group, const Response& response) {
  group.write_texts("columns", response.columns);
  for (std::size_t c = 0; c < response.columns.size(); ++c) {
    std::vector<double> values;
    values.reserve(response.rows.size());
    for (const auto& row : response.rows) values.push_back(row[c]);
    group.write(response.columns[c], values);
    group.write_text(response.columns[c] + "@unit", response.units[c]);
  }
}

Response read_response(const h5::Node& group) {
  Response response;
  response.columns = group.texts("columns");
  for (std::size_t c = 0; c < response.columns.size(); ++c) {
    const auto& name = response.columns[c];
    const auto values = group.doubles(name);
    response.units.push_back(group.text(name + "@unit"));
    if (c == 0) response.rows.assign(values.size(), std::vector<double>(response.columns.size()));
    check_length(group, name, values, response.rows.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i]))
        throw DataError(fmt::format("{}: '{}' of row {} is not a finite number", group.where(), name, i));
      response.rows[i][c] = values[i];
    }
  }
  return response;
}

void write_provenance(h5::Node& group, const Provenance& provenance) {
  for (const auto& [key, value] : provenance) group.write_text(key, value);
}

Provenance read_provenance(const h5::Node& group) {
  Provenance provenance;
  for (const auto& key : group.attributes()) provenance[key] = group.text(key);
  return provenance;
}

}  // namespace lamella
