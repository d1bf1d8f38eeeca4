#include "thin_branch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::reconstruction {
namespace {

using std::numbers::pi;
constexpr double thin = 0.15;         // of the wide vessel's radius, at most
constexpr double disc = 0.7;          // its radius, of the wide vessel's
constexpr double bent = -0.17364818;  // cosine of 100 degrees

struct Parts {
  std::size_t branch = 0, one = 0, other = 0;  ///< slots: the thin one, and the wide vessel's two ends
};

std::optional<Parts> parts_of(const std::vector<Slot>& slots) {
  if (slots.size() != 3) return std::nullopt;
  Parts parts;
  for (std::size_t i = 1; i < 3; ++i)
    if (slots[i].radius < slots[parts.branch].radius) parts.branch = i;
  parts.one = parts.branch == 0 ? 1 : 0;
  parts.other = parts.branch == 2 ? 1 : 2;
  const Slot &one = slots[parts.one], &other = slots[parts.other];
  if (slots[parts.branch].radius > thin * std::min(one.radius, other.radius) ||
      one.direction.dot(other.direction) > bent)
    return std::nullopt;
  return parts;
}

}  // namespace

std::optional<JointRings> about_thin_branch(const std::vector<Slot>& slots, int sides,
                                            const JointSurface& surface) {
  const auto parts = parts_of(slots);
  if (!parts) return std::nullopt;
  const Slot &one = slots[parts->one], &other = slots[parts->other];
  const Vec3 along = (other.direction - one.direction).normalized();
  const Vec3 lateral = slots[parts->branch].direction - slots[parts->branch].direction.dot(along) * along;
  if (lateral.norm() < 0.05) return std::nullopt;
  const Vec3 out = lateral.normalized(), side = along.cross(out);
  const double radius = std::min(one.radius, other.radius);
  // Where the branch's axis leaves the wide vessel's wall.
  const Vec3 way = slots[parts->branch].direction * (radius / lateral.norm());
  const Vec3 middle = surface.centre + way.dot(along) * along;

  JointRings made;
  const auto add = [&](const Vec3& point) {
    made.points.push_back(point);
    return static_cast<std::int32_t>(made.points.size() - 1);
  };
  std::vector<std::int32_t> circle;  // from the side by way of `along`
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * pi * k / sides;
    const double across = disc * std::cos(angle);
    circle.push_back(add(surface.onto(middle + radius * (disc * std::sin(angle) * along + across * side +
                                                         std::sqrt(1.0 - across * across) * out))));
  }
  std::vector<std::int32_t> back;       // from the circle's first point to the one opposite, behind
  const double from = std::acos(disc);  // from `side` towards `out`
  for (int k = 1; k < sides / 2; ++k) {
    const double angle = from - (pi + 2.0 * from) * 2.0 * k / sides;
    back.push_back(add(surface.onto(middle + radius * (std::cos(angle) * side + std::sin(angle) * out))));
  }
  const auto half = static_cast<std::size_t>(sides / 2);
  made.rings.resize(3);
  // Counter-clockwise about the branch's way out is from `side` to `along`, and about `along` from `out` to
  // `side`.
  made.rings[parts->branch] = circle;
  std::vector<std::int32_t>& forward = made.rings[parts->other];
  forward = back;
  forward.insert(forward.end(), circle.rbegin() + static_cast<std::ptrdiff_t>(half) - 1, circle.rend());
  std::vector<std::int32_t>& backward = made.rings[parts->one];
  backward.assign(back.rbegin(), back.rend());
  backward.push_back(circle[0]);
  backward.insert(backward.end(), circle.rbegin(), circle.rbegin() + static_cast<std::ptrdiff_t>(half));
  made.clearance.resize(3);
  for (std::size_t i = 0; i < 3; ++i)
    for (const std::int32_t p : made.rings[i]) {
      const Vec3 reached = made.points[static_cast<std::size_t>(p)] - surface.centre;
      const double far = reached.dot(slots[i].direction);
      if (far > slots[i].reach) return std::nullopt;
      made.clearance[i] = std::max(made.clearance[i], far);
    }
  // The branch's section need not be beyond the disc, which lies on the wall, but clear of the wall.
  const Slot& branch = slots[parts->branch];
  const double sine = lateral.norm(), cosine = std::abs(branch.direction.dot(along));
  made.clearance[parts->branch] = (radius + branch.radius * cosine) / sine;
  return made;
}

}  // namespace ostia::reconstruction
