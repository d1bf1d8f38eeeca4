// A branch cut into steps: what does not depend on the flow.

#include "circle.h"

#include "ostia/hemodynamics/vessel_pressure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::hemodynamics {
namespace {

double area_between(const Station& a, const Station& b, double t) {
  const double root = (1.0 - t) * std::sqrt(a.area_mm2) + t * std::sqrt(b.area_mm2);
  return root * root;
}

/// Of 1 / area^2, over a stretch on which the radius is linear: exact for a cone.
double cone_integral(double length, double area_a, double area_b) {
  const double a = std::sqrt(area_a), b = std::sqrt(area_b);
  return length * (a * a + a * b + b * b) / (3.0 * a * a * a * b * b * b);
}

PreparedBranch::Step step_between(const Station& a, const Station& b, double from, double to) {
  PreparedBranch::Step step;
  const double middle = 0.5 * (from + to);
  const auto mix = [middle](double x, double y) { return (1.0 - middle) * x + middle * y; };
  step.length_mm = (to - from) * (b.s_mm - a.s_mm);
  step.area_mm2[0] = area_between(a, b, from);
  step.area_mm2[1] = area_between(a, b, middle);
  step.area_mm2[2] = area_between(a, b, to);
  const double shape = mix(a.shape.viscous, b.shape.viscous);
  step.friction_mm3 = shape * cone_integral(step.length_mm, step.area_mm2[0], step.area_mm2[2]);
  step.mean_friction_mm4 = step.friction_mm3 / step.length_mm;
  step.diameter_mm = 2.0 * std::sqrt(step.area_mm2[1] / pi);
  step.perimeter_mm = pi * step.diameter_mm * mix(a.shape.perimeter, b.shape.perimeter);
  step.bend = std::sqrt(std::max(0.0, 0.5 * step.diameter_mm * mix(a.curvature_per_mm, b.curvature_per_mm)));
  return step;
}

/// Over a diameter about the place, so that a rough wall is none that widens; in a throat over less, by its
/// share of the branch's calibre, so that it does not begin before the throat's end.
void set_widening(std::vector<PreparedBranch::Step>& steps) {
  std::vector<double> s = {0.0}, log_area = {std::log(steps.front().area_mm2[0])};
  for (const PreparedBranch::Step& step : steps) {
    s.push_back(s.back() + step.length_mm);
    log_area.push_back(std::log(step.area_mm2[2]));
  }
  double widest = 0.0;
  for (const PreparedBranch::Step& step : steps) widest = std::max(widest, step.diameter_mm);
  std::size_t before = 0, behind = 0;
  const auto at = [&](double place, std::size_t& i) {
    while (i + 2 < s.size() && s[i + 1] <= place) ++i;
    while (i > 0 && s[i] > place) --i;
    const double t = (place - s[i]) / (s[i + 1] - s[i]);
    return log_area[i] + t * (log_area[i + 1] - log_area[i]);
  };
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double middle = 0.5 * (s[k] + s[k + 1]),
                 reach = 0.5 * steps[k].diameter_mm * steps[k].diameter_mm / widest;
    const double from = std::max(0.0, middle - reach), to = std::min(s.back(), middle + reach);
    steps[k].widening = (at(to, behind) - at(from, before)) / (to - from);
  }
}

/// Where a jet would go from the last throat: straight on, and wider by a twentieth of its way. Of the form
/// alone, so that nothing jumps with the flow.
void set_leans(const std::vector<Station>& stations, const std::vector<std::size_t>& station_of,
               const std::vector<double>& part_of, std::vector<PreparedBranch::Step>& steps) {
  constexpr double spread = 0.05;                            // of the way
  constexpr double least_gap = 0.05, another_throat = 0.95;  // of the radius, of the widest since the last
  const auto tangent_at = [&](std::size_t i) {
    const double half = 0.5 * stations[i].diameter_mm();
    std::size_t a = i, b = i;
    while (a > 0 && stations[i].s_mm - stations[a].s_mm < half) --a;
    while (b + 1 < stations.size() && stations[b].s_mm - stations[i].s_mm < half) ++b;
    const Vec3 way = stations[b].point - stations[a].point;
    return way.norm() > 1e-9 ? Vec3(way.normalized()) : Vec3(Vec3::Zero());
  };
  double jet = 0.5 * stations.front().diameter_mm(), widest = jet, lean = 0.0;
  std::size_t throat = 0;
  Vec3 direction = tangent_at(0);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const std::size_t i = station_of[k];
    const double radius = 0.5 * steps[k].diameter_mm;
    jet += spread * steps[k].length_mm;
    widest = std::max(widest, radius);
    if (radius <= jet) {
      // As wide as the lumen: a jet that leans goes on so until the next narrowing.
      if (radius < another_throat * widest) lean = 0.0, widest = radius;
      steps[k].lean = lean;
      jet = radius;
      if (throat != i) direction = tangent_at(i);
      throat = i;
      continue;
    }
    const Vec3 place = (1.0 - part_of[k]) * stations[i].point + part_of[k] * stations[i + 1].point;
    const Vec3 way = place - stations[throat].point;
    const double aside = (way - way.dot(direction) * direction).norm();
    if (direction.squaredNorm() > 0.0)
      steps[k].lean = lean = std::min(1.0, aside / std::max(radius - jet, least_gap * radius));
  }
}

}  // namespace

PreparedBranch prepare(const Branch& branch, const FlowModel& model) {
  validate(branch);
  validate(model);
  PreparedBranch out;
  out.lumped = branch.lumped;
  out.start_momentum = branch.parent < 0 ? model.root_momentum : developed_momentum;
  out.stations = branch.stations.size();
  while (out.open_stations < out.stations && branch.stations[out.open_stations].area_mm2 > shut_mm2)
    ++out.open_stations;
  if (branch.stations.empty()) return out;
  out.first_area_mm2 = branch.stations.front().area_mm2;
  out.last_area_mm2 = branch.stations.back().area_mm2;
  if (out.shut()) return out;
  std::vector<std::size_t> station_of;  // before each step
  std::vector<double> part_of;          // of the way to the next, in its middle
  for (std::size_t i = 1; i < branch.stations.size(); ++i) {
    const Station &a = branch.stations[i - 1], &b = branch.stations[i];
    const double length = b.s_mm - a.s_mm;
    // Also where the area changes fast: half of it or twice as much within a step at most.
    const double turns = std::abs(std::log(b.area_mm2 / a.area_mm2)) / std::numbers::ln2;
    const int steps =
        std::clamp(static_cast<int>(std::ceil(std::max(length / model.step_mm - 1e-9, turns))), 1, 10000);
    for (int k = 0; k < steps; ++k) {
      out.steps.push_back(
          step_between(a, b, static_cast<double>(k) / steps, static_cast<double>(k + 1) / steps));
      station_of.push_back(i - 1);
      part_of.push_back((k + 0.5) / steps);
    }
    out.steps.back().station = true;
  }
  set_widening(out.steps);
  set_leans(branch.stations, station_of, part_of, out.steps);
  return out;
}

}  // namespace ostia::hemodynamics
