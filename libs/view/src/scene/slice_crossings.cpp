#include "scene/slice_crossings.h"

#include "ostia/session/beating.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ostia::view {
namespace {

constexpr double farthest_radii = 3.0;  // from its axis that a lumen reaches
// Along an axis: a lumen that a narrowing takes off the slice goes on beyond it.
constexpr double axis_seed_step_mm = 5.0;

std::optional<Vec2> in_picture(const reformat::Plane& plane, const Vec3& place) {
  const Vec2 px = reformat::project(plane, place).picture_px;
  if (!(px.x() >= 0.0 && px.y() >= 0.0 && px.x() <= plane.width && px.y() <= plane.height))
    return std::nullopt;
  return px;
}

/// A place of an axis that the picture shows: where it crosses the plane, or the foot of one of its points.
struct Foot {
  bool crossing = false;
  std::size_t point = 0;  // of the axis; of a crossing the one before
  double s_mm = 0.0;
  double radii = 0.0;  // from the plane
  Vec2 px = Vec2::Zero();
  Vec3 place = Vec3::Zero();  // on the plane
  bool within = true;         // the lumen
};

/// All along one axis, in order. Without radii there are crossings alone.
std::vector<Foot> feet_of(const geometry::Centerline& axis, const reformat::Plane& plane) {
  std::vector<Foot> found;
  const Vec3 normal = plane.normal();
  const bool radii = axis.radius.size() == axis.points.size();
  double s = 0.0;
  for (std::size_t i = 0; i < axis.points.size(); ++i) {
    const Vec3& here = axis.points[i];
    const double a = (here - plane.origin).dot(normal);
    const double share = radii ? std::abs(a) / axis.radius[i] : std::numeric_limits<double>::infinity();
    if (share < farthest_radii)
      if (const auto px = in_picture(plane, here))
        found.push_back({false, i, s, share, *px, here - a * normal, share < 1.0});
    if (i + 1 == axis.points.size()) break;
    const Vec3& next = axis.points[i + 1];
    const double length = (next - here).norm(), b = (next - plane.origin).dot(normal);
    if ((a < 0.0) != (b < 0.0)) {
      const double t = a / (a - b);
      const Vec3 at = here + t * (next - here);
      if (const auto px = in_picture(plane, at))
        found.push_back({true, i, s + t * length, 0.0, *px, at, true});
    }
    s += length;
  }
  return found;
}

/// Calls `visit` with each segment's axis and a vessel that it belongs to.
template <class Visit>
void for_axes(const lumen::LumenModel& model, const Visit& visit) {
  for (const geometry::TreeSegment& segment : model.tree.segments)
    for (const geometry::Vessel& vessel : model.tree.vessels)
      if (std::find(vessel.segments.begin(), vessel.segments.end(), segment.id) != vessel.segments.end()) {
        visit(segment.axis, vessel.id);
        break;
      }
}

/// Beyond its radius the wall itself says whether a foot is in the lumen.
void ask_wall(const lumen::ScalarField& wall, std::vector<Foot>& feet) {
  std::vector<Foot*> asked;
  std::vector<Vec3> places;
  for (Foot& foot : feet)
    if (!foot.within) {
      asked.push_back(&foot);
      places.push_back(foot.place);
    }
  std::vector<double> values(places.size());
  wall.values(places, values);
  for (std::size_t i = 0; i < asked.size(); ++i) asked[i]->within = values[i] < 0.0;
}

/// Of feet side by side all crossings and, where there is none, the one nearest to its axis; of the others
/// as many as are axis_seed_step_mm from those.
void add_seeds(std::vector<Foot>::const_iterator first, std::vector<Foot>::const_iterator last,
               std::vector<Vec2>& seeds) {
  std::vector<double> taken;
  const auto take = [&](const Foot& foot) {
    taken.push_back(foot.s_mm);
    seeds.push_back(foot.px);
  };
  std::for_each(first, last, [&](const Foot& foot) {
    if (foot.crossing) take(foot);
  });
  if (taken.empty())
    take(*std::min_element(first, last, [](const Foot& a, const Foot& b) { return a.radii < b.radii; }));
  std::for_each(first, last, [&](const Foot& foot) {
    if (std::all_of(taken.begin(), taken.end(),
                    [&](double s) { return std::abs(s - foot.s_mm) >= axis_seed_step_mm; }))
      take(foot);
  });
}

}  // namespace

std::vector<AxisCrossing> crossings(const lumen::LumenModel& model, const reformat::Plane& plane,
                                    const session::ShownPhase* phase) {
  std::vector<AxisCrossing> found;
  const auto add = [&](const geometry::Centerline& axis, std::int32_t vessel) {
    for (const Foot& foot : feet_of(axis, plane))
      if (foot.crossing) found.push_back({foot.px, vessel});
  };
  if (!phase) {
    for_axes(model, add);
    return found;
  }
  constexpr double step_mm = 0.5;
  for (const auto& vessel : model.vessels) {
    const session::CarriedAxis& carried = phase->axis(vessel->vessel);
    const double from = carried.here(vessel->own_from_mm), length = carried.curve()->length();
    geometry::Centerline own;  // before it the axis is another vessel's
    for (double s = from; s < length + step_mm; s += step_mm)
      own.points.push_back(carried.curve()->point(std::min(s, length)));
    add(own, vessel->vessel);
  }
  return found;
}

std::vector<Vec2> slice_seeds(const lumen::LumenModel& model, const lumen::ScalarField& wall,
                              const reformat::Plane& plane) {
  std::vector<Vec2> seeds;
  for_axes(model, [&](const geometry::Centerline& axis, std::int32_t) {
    std::vector<Foot> feet = feet_of(axis, plane);
    ask_wall(wall, feet);
    std::erase_if(feet, [](const Foot& foot) { return !foot.within; });
    for (auto first = feet.cbegin(); first != feet.cend();) {
      auto last = std::next(first);
      while (last != feet.cend() && last->point <= std::prev(last)->point + 1) ++last;
      add_seeds(first, last, seeds);
      first = last;
    }
  });
  return seeds;
}

}  // namespace ostia::view
