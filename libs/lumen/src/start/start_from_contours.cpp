#include "start/start_walls.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::lumen {
namespace {

using std::numbers::pi;
constexpr int angles = 96;
constexpr double passage_mm = 3.0;  ///< from the last contour to the tube
/// A contour's plane may meet the axis so far from where the contour says it is, or from its middle's foot.
constexpr double plane_reach_mm = 3.0;
/// A contour whose middle is farther from the axis is not the vessel's at that place.
constexpr double farthest_contour_mm = 5.0;

struct Ring {
  double s = 0.0;
  std::vector<double> r;  ///< at equal angles
};
/// Rings that stand in one stretch.
using Stretch = std::vector<Ring>;

std::string place_of(const geometry::ContourSection& section, double s_mm) {
  return "the contour at " + std::to_string(s_mm) + " mm of section " + section.section + " (" +
         section.vessel + ", " + section.observer + ")";
}

/// Where the axis passes the contour's plane: near where the contour says it is, or, for abscissas counted
/// from a branch's own origin, near the contour itself.
double crossing_abscissa(const AxisCurve& axis, const geometry::ContourSection& section,
                         const geometry::Contour& contour) {
  const Vec3 normal = geometry::contour_normal(contour), centre = geometry::contour_centroid(contour);
  const auto height = [&](double s) { return (axis.point(s) - centre).dot(normal); };
  double guess = axis.nearest_foot(centre).s_mm;
  if (const auto foot = axis.foot_near(centre, contour.s_mm, plane_reach_mm);
      foot && foot->rho_mm < farthest_contour_mm)
    guess = foot->s_mm;
  const double low = std::max(0.0, guess - plane_reach_mm);
  const double high = std::min(axis.length(), guess + plane_reach_mm);
  double best = -1.0;
  constexpr int steps = 60;
  for (int i = 0; i < steps; ++i) {
    double a = low + (high - low) * i / steps, b = low + (high - low) * (i + 1) / steps;
    if ((height(a) < 0.0) == (height(b) < 0.0)) continue;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (a + b);
      ((height(middle) < 0.0) == (height(a) < 0.0) ? a : b) = middle;
    }
    if (best < 0.0 || std::abs(a - guess) < std::abs(best - guess)) best = a;
  }
  if (best >= 0.0) return best;
  const double nearer = std::abs(height(low)) < std::abs(height(high)) ? low : high;
  if (high > low && std::abs(height(nearer)) < 0.1) return nearer;  // a contour on the very end
  throw InvalidInput(place_of(section, contour.s_mm) +
                     " does not meet the vessel's axis; do contours and axis belong together?");
}

/// Distances from the axis to the contour in its plane, at equal angles.
Ring ring_of(const AxisCurve& axis, const geometry::ContourSection& section,
             const geometry::Contour& contour) {
  Ring ring;
  ring.s = crossing_abscissa(axis, section, contour);
  const Vec3 origin = axis.point(ring.s), normal = geometry::contour_normal(contour);
  const geometry::Frame frame = axis.frame(ring.s);
  for (int k = 0; k < angles; ++k) {
    Vec3 d = geometry::radial_direction(frame, 2.0 * pi * k / angles);
    d = (d - d.dot(normal) * normal).normalized();
    const Vec3 across = normal.cross(d);
    double nearest = 0.0;
    int crossings = 0;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      const Vec3 a = contour.points[i] - origin;
      const Vec3 b = contour.points[(i + 1) % contour.points.size()] - origin;
      const double ya = a.dot(across), yb = b.dot(across);
      if ((ya < 0.0) == (yb < 0.0)) continue;
      const double t = ya / (ya - yb), x = a.dot(d) + t * (b.dot(d) - a.dot(d));
      if (x <= 0.0) continue;
      nearest = crossings == 0 ? x : std::min(nearest, x);
      ++crossings;
    }
    if (crossings % 2 == 0)
      throw InvalidInput(place_of(section, contour.s_mm) +
                         " does not go around the vessel's axis; move the axis inside or mend the contour");
    ring.r.push_back(nearest);
  }
  return ring;
}

/// r at an angle between the ring's angles: cubic and periodic.
double at_angle(const Ring& ring, double theta) {
  const double turn = theta / (2.0 * pi);
  const double x = (turn - std::floor(turn)) * angles;
  const int k = static_cast<int>(x);
  const auto value = [&](int i) { return ring.r[static_cast<std::size_t>((i + angles) % angles)]; };
  const double t = x - k, u = 1.0 - t, a = value(k), b = value(k + 1);
  const double ma = 0.5 * (b - value(k - 1)), mb = 0.5 * (value(k + 2) - a);
  return u * u * (1.0 + 2.0 * t) * a + t * t * (3.0 - 2.0 * t) * b + t * u * (u * ma - t * mb);
}

/// Through the rings by cubic pieces that never overshoot their ends' larger or smaller value by more than
/// the slopes' harmonic mean allows (Fritsch and Butland 1984).
double at_place(const Stretch& stretch, double s, double theta) {
  if (s <= stretch.front().s) return at_angle(stretch.front(), theta);
  if (s >= stretch.back().s) return at_angle(stretch.back(), theta);
  const auto upper = std::upper_bound(stretch.begin(), stretch.end(), s,
                                      [](double at, const Ring& ring) { return at < ring.s; });
  const auto i = static_cast<std::size_t>(upper - stretch.begin()) - 1;
  const auto chord = [&](std::size_t k) {
    return (at_angle(stretch[k + 1], theta) - at_angle(stretch[k], theta)) /
           (stretch[k + 1].s - stretch[k].s);
  };
  const auto slope = [&](std::size_t k) {
    if (k == 0) return chord(0);
    if (k + 1 == stretch.size()) return chord(k - 1);
    const double before = chord(k - 1), after = chord(k);
    return before * after <= 0.0 ? 0.0 : 2.0 * before * after / (before + after);
  };
  const double h = stretch[i + 1].s - stretch[i].s, t = (s - stretch[i].s) / h, u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * at_angle(stretch[i], theta) +
         t * t * (3.0 - 2.0 * t) * at_angle(stretch[i + 1], theta) +
         h * t * u * (u * slope(i) - t * slope(i + 1));
}

/// 1 on a covered stretch, falling smoothly to 0 over `width` beyond it.
double fade(double beyond, double width) {
  const double x = std::clamp(beyond / width, 0.0, 1.0);
  return 1.0 - x * x * (3.0 - 2.0 * x);
}

struct Covered {
  std::vector<Stretch> stretches;  ///< ascending
  EvenTable tube;

  double operator()(double s, double theta) const {
    double r = tube.at(s);
    const auto ratio = [&](const Ring& ring) { return at_angle(ring, theta) / tube.at(ring.s) - 1.0; };
    double change = 0.0;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const Ring &first = stretches[i].front(), &last = stretches[i].back();
      if (s >= first.s && s <= last.s) return at_place(stretches[i], s, theta);
      const bool before = s < first.s;
      if (!before && i + 1 < stretches.size() && s > stretches[i + 1].front().s) continue;
      if (before && i > 0 && s < stretches[i - 1].back().s) continue;
      double width = passage_mm;
      if (before && i > 0) width = std::min(width, 0.5 * (first.s - stretches[i - 1].back().s));
      if (!before && i + 1 < stretches.size())
        width = std::min(width, 0.5 * (stretches[i + 1].front().s - last.s));
      change += ratio(before ? first : last) * fade(before ? first.s - s : s - last.s, width);
    }
    return r * (1.0 + change);
  }
};

const geometry::Vessel* named(const geometry::VesselTree& tree, const std::string& name) {
  const auto found = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                  [&](const geometry::Vessel& v) { return v.name == name; });
  return found == tree.vessels.end() ? nullptr : &*found;
}

}  // namespace

void check_contours(const geometry::VesselTree& tree, const geometry::ContourSet& contours) {
  for (const geometry::ContourSection& section : contours.sections) {
    if (section.boundary != "lumen") continue;
    const std::string name =
        "section " + section.section + " (" + section.vessel + ", " + section.observer + ")";
    if (auto fault = geometry::find_fault(section))
      throw InvalidInput("the contours of " + name + " cannot be used: " + *fault);
    if (!named(tree, section.vessel))
      throw InvalidInput("the contours of " + name + " belong to a vessel that the tree does not have");
    for (const geometry::ContourSection& other : contours.sections) {
      if (&other == &section) break;
      if (other.boundary != "lumen" || other.vessel != section.vessel) continue;
      if (other.contours.front().s_mm <= section.contours.back().s_mm &&
          section.contours.front().s_mm <= other.contours.back().s_mm)
        throw InvalidInput("the contours of " + name + " overlap those of section " + other.section + " (" +
                           other.observer + "); choose one observer and one section a place");
    }
  }
}

RadialWall wall_through_contours(const StartVessel& start, const geometry::ContourSet& contours) {
  auto covered = std::make_shared<Covered>();
  covered->tube = start.radius;
  for (const geometry::ContourSection& section : contours.sections) {
    if (section.boundary != "lumen" || section.vessel != start.vessel->name) continue;
    Stretch stretch;
    for (const geometry::Contour& contour : section.contours) {
      Ring ring = ring_of(*start.axis, section, contour);
      if (!stretch.empty() && ring.s <= stretch.back().s + 1e-3)
        throw InvalidInput(place_of(section, contour.s_mm) +
                           " crosses the contour before it at the vessel's axis");
      stretch.push_back(std::move(ring));
    }
    covered->stretches.push_back(std::move(stretch));
  }
  std::sort(covered->stretches.begin(), covered->stretches.end(),
            [](const Stretch& a, const Stretch& b) { return a.front().s < b.front().s; });
  return [covered = std::shared_ptr<const Covered>(covered)](double s, double theta) {
    return std::max(0.1, (*covered)(s, theta));
  };
}

}  // namespace ostia::lumen
