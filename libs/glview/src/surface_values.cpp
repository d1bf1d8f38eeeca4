#include "ostia/glview/surface_values.h"

#include "vertex_floats.h"

#include "ostia/core/error.h"
#include "ostia/figure/value_colors.h"

#include <algorithm>
#include <cmath>

namespace ostia::glview {
namespace {

constexpr int range_phases = 20;
constexpr double share_in_range = 0.99;
constexpr double mm_a_cm = 10.0;

std::vector<Vec3> rest_places(const ShownSurface& surface) {
  std::vector<Vec3> places;
  places.reserve(surface.vertices.size());
  for (const ShownVertex& vertex : surface.vertices) places.push_back(in_double(vertex.rest));
  return places;
}

std::vector<double> displacements(const ShownSurface& surface, const motion::MovingCage& cage, double phase) {
  const std::vector<Vec3> rest = rest_places(surface);
  const auto places = motion::CarriedPoints(surface.grid, rest).places(cage.at(phase));
  std::vector<double> values(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) values[i] = (places[i] - rest[i]).norm();
  return values;
}

std::vector<double> speeds(const ShownSurface& surface, const motion::MovingCage& cage, double phase,
                           double interval_s) {
  const auto rates = motion::CarriedPoints(surface.grid, rest_places(surface)).rates(cage.rate(phase));
  std::vector<double> values(rates.size());
  for (std::size_t i = 0; i < rates.size(); ++i) values[i] = rates[i].norm() / interval_s;
  return values;
}

std::vector<double> stretches(const ShownSurface& surface, const motion::MovingCage& cage, double phase) {
  if (surface.along.size() != surface.vertices.size())
    throw InvalidInput("stretch needs the directions along the vessel");
  const auto gradient = gradients(surface, cage.at(phase));
  std::vector<double> values(gradient.size());
  for (std::size_t i = 0; i < gradient.size(); ++i)
    values[i] = 100.0 * ((gradient[i] * in_double(surface.along[i])).norm() - 1.0);
  return values;
}

std::vector<double> bends(std::size_t vertices, const BendingTable& table, double phase) {
  const double at = (phase - std::floor(phase)) * table.phases;
  const auto count = static_cast<std::size_t>(table.phases);
  const std::size_t from = static_cast<std::size_t>(at) % count, to = (from + 1) % count;
  const double share = at - std::floor(at);
  std::vector<double> values(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    values[i] = mm_a_cm * ((1.0 - share) * static_cast<double>(table.values[from * vertices + i]) +
                           share * static_cast<double>(table.values[to * vertices + i]));
  return values;
}

}  // namespace

const char* title(SurfaceValue value) {
  switch (value) {
    case SurfaceValue::none:
      return "plain";
    case SurfaceValue::displacement:
      return "displacement, mm";
    case SurfaceValue::velocity:
      return "velocity, mm/s";
    case SurfaceValue::stretch:
      return "stretch along the vessel, %";
    case SurfaceValue::bending:
      return "change of curvature, 1/cm";
  }
  return "";
}

bool is_signed(SurfaceValue value) {
  return value == SurfaceValue::stretch || value == SurfaceValue::bending;
}

figure::Color color(SurfaceValue value, double t) {
  if (value == SurfaceValue::none) return figure::colors::lumen;
  return is_signed(value) ? figure::blue_to_vermilion(t) : figure::viridis(t);
}

std::vector<double> values_at(const ShownSurface& surface, const motion::MovingCage& cage, double phase,
                              SurfaceValue value, double interval_s, const BendingTable* bending) {
  switch (value) {
    case SurfaceValue::none:
      break;
    case SurfaceValue::displacement:
      return displacements(surface, cage, phase);
    case SurfaceValue::velocity:
      return speeds(surface, cage, phase, interval_s);
    case SurfaceValue::stretch:
      return stretches(surface, cage, phase);
    case SurfaceValue::bending:
      if (bending == nullptr) throw InvalidInput("changes of curvature need their table");
      return bends(surface.vertices.size(), *bending, phase);
  }
  return std::vector<double>(surface.vertices.size(), 0.0);
}

ValueRange value_range(const ShownSurface& surface, const motion::MovingCage& cage, SurfaceValue value,
                       const BendingTable* bending, const core::TaskContext& task) {
  double most = 0.0;
  for (int k = 0; k < range_phases; ++k) {
    task.throw_if_cancelled();
    auto values = values_at(surface, cage, static_cast<double>(k) / range_phases, value, 1.0, bending);
    for (double& v : values) v = std::abs(v);
    const auto place = static_cast<std::ptrdiff_t>(share_in_range * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    most = std::max(most, values[static_cast<std::size_t>(place)]);
  }
  // Where nothing moves the rounding of single precision is no range to be coloured.
  constexpr double nothing = 1e-3;
  const double high = most > nothing ? figure::round_above(most) : 1.0;
  return {is_signed(value) ? -high : 0.0, high};
}

}  // namespace ostia::glview
