#include "joint_rings.h"

#include "thin_branch.h"

#include "ostia/geometry/frame.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace ostia::reconstruction {
namespace {

using std::numbers::pi;

/// Two unit vectors that make a right-handed frame with the axis.
std::array<Vec3, 2> across(const Vec3& axis) {
  const Vec3 first = geometry::initial_normal(axis);
  const Vec3 e = (first - first.dot(axis) * axis).normalized();
  return {e, axis.cross(e)};
}

double azimuth(const std::array<Vec3, 2>& basis, const Vec3& direction) {
  return std::atan2(direction.dot(basis[1]), direction.dot(basis[0]));
}

/// How well the branches lie round an axis: far from its poles, and apart from each other.
double merit(const std::vector<Slot>& slots, const Vec3& axis) {
  const auto basis = across(axis);
  double flattest = 1.0;
  std::vector<double> angles;
  for (const Slot& slot : slots) {
    flattest = std::min(flattest, slot.direction.cross(axis).norm());
    angles.push_back(azimuth(basis, slot.direction));
  }
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::min(gap, angles[i] - angles[i - 1]);
  return flattest + 0.3 * gap * static_cast<double>(slots.size()) / (2.0 * pi);
}

Vec3 axis_of(const std::vector<Slot>& slots) {
  std::vector<Vec3> candidates;
  for (std::size_t i = 0; i < slots.size(); ++i)
    for (std::size_t k = i + 1; k < slots.size(); ++k) {
      const Vec3 normal = slots[i].direction.cross(slots[k].direction);
      if (normal.norm() > 1e-6) candidates.push_back(normal.normalized());
    }
  if (slots.size() > 3) {
    for (std::size_t i = candidates.size(); i-- > 0;)
      for (std::size_t k = 0; k < i; ++k)
        for (const double sign : {-1.0, 1.0}) {
          const Vec3 sum = candidates[i] + sign * candidates[k];
          if (sum.norm() > 0.1) candidates.push_back(sum.normalized());
        }
  } else if (slots.size() == 3 && candidates.size() == 3) {
    // The normal of three ends' plane, which is that of the fork where it is flat.
    const Vec3 plane =
        (slots[1].direction - slots[0].direction).cross(slots[2].direction - slots[0].direction);
    if (plane.norm() > 1e-6) candidates.push_back(plane.normalized());
  }
  if (candidates.empty()) return across(slots[0].direction)[0];
  if (slots.size() == 2) return candidates[0];
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double value = merit(slots, candidates[i]);
    if (value < most + 1e-3) continue;
    most = value;
    best = i;
  }
  return candidates[best];
}

Vec3 turned(const Vec3& from, const Vec3& to, double angle) {
  const Vec3 side = (to - to.dot(from) * from);
  if (side.norm() < 1e-9) return from;
  return std::cos(angle) * from + std::sin(angle) * side.normalized();
}

/// The direction of the crotch between two neighbours: where their walls meet, for tubes of these radii.
Vec3 crotch(const Slot& a, const Slot& b, const Vec3& axis) {
  const auto basis = across(axis);
  const double from = azimuth(basis, a.direction);
  double gap = azimuth(basis, b.direction) - from;
  while (gap <= 0.0) gap += 2.0 * pi;
  const double middle = from + 0.5 * gap;
  const Vec3 halfway = std::cos(middle) * basis[0] + std::sin(middle) * basis[1];
  const double angle = std::acos(std::clamp(a.direction.dot(b.direction), -1.0, 1.0));
  // Towards a straight line, and beyond it, walls do not meet: the middle.
  const double bend = std::clamp((std::max(gap, angle) - 2.9) / (3.1 - 2.9), 0.0, 1.0);
  if (bend >= 1.0) return halfway;
  const double least = 0.02 * angle;
  const double share =
      std::clamp(std::atan2(std::sin(angle), b.radius / a.radius + std::cos(angle)), least, angle - least);
  const Vec3 met = turned(a.direction, b.direction, share);
  return turned(met, halfway, bend * std::acos(std::clamp(met.dot(halfway), -1.0, 1.0)));
}

/// `count` - 1 points between the ends of a path over the surface, evenly along it or by its samples.
std::vector<Vec3> spread(const std::vector<Vec3>& path, int count, bool even) {
  std::vector<double> way = geometry::abscissas(path);
  if (!even) std::iota(way.begin(), way.end(), 0.0);
  std::vector<Vec3> points;
  std::size_t i = 1;
  for (int k = 1; k < count; ++k) {
    const double s = way.back() * k / count;
    while (i + 1 < path.size() && way[i] < s) ++i;
    const double t = way[i] > way[i - 1] ? (s - way[i - 1]) / (way[i] - way[i - 1]) : 0.0;
    points.push_back((1.0 - t) * path[i - 1] + t * path[i]);
  }
  return points;
}

/// Points and the arcs between them, from which rings are put together.
class Map {
 public:
  explicit Map(const SurfacePoint& surface) : surface_(surface) {}
  std::int32_t add(const Vec3& point) {
    made.points.push_back(point);
    return static_cast<std::int32_t>(made.points.size() - 1);
  }
  std::vector<std::int32_t> add(const std::vector<Vec3>& points) {
    std::vector<std::int32_t> added;
    for (const Vec3& point : points) added.push_back(add(point));
    return added;
  }
  /// The surface in these directions.
  std::vector<Vec3> path(const std::vector<Vec3>& directions) const {
    std::vector<Vec3> points;
    for (const Vec3& direction : directions) points.push_back(surface_(direction));
    return points;
  }
  const SurfacePoint& surface() const { return surface_; }
  JointRings made;

 private:
  const SurfacePoint& surface_;
};

void append(std::vector<std::int32_t>& ring, std::vector<std::int32_t> arc, bool backwards) {
  if (backwards) std::reverse(arc.begin(), arc.end());
  ring.insert(ring.end(), arc.begin(), arc.end());
}

constexpr int samples = 24;  // of an arc

/// Between the poles by way of the crotch, which is one of its points where it has a middle one.
std::vector<Vec3> arc_by(const Map& map, const Vec3& from, const Vec3& middle, const Vec3& to, int count,
                         bool even) {
  const auto half = [&](const Vec3& a, const Vec3& b) {
    const double angle = std::acos(std::clamp(a.dot(b), -1.0, 1.0));
    std::vector<Vec3> directions;
    for (int k = 0; k <= samples; ++k) directions.push_back(turned(a, b, angle * k / samples));
    return map.path(directions);
  };
  std::vector<Vec3> first = half(from, middle);
  const std::vector<Vec3> second = half(middle, to);
  if (count % 2 == 0) {
    std::vector<Vec3> points = spread(first, count / 2, even);
    points.push_back(second.front());
    for (const Vec3& point : spread(second, count / 2, even)) points.push_back(point);
    return points;
  }
  first.insert(first.end(), second.begin() + 1, second.end());
  return spread(first, count, even);
}

JointRings two_poles(const std::vector<Slot>& slots, int sides, bool even, const SurfacePoint& surface) {
  const std::size_t n = slots.size();
  const Vec3 axis = axis_of(slots);
  const auto basis = across(axis);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return azimuth(basis, slots[a].direction) < azimuth(basis, slots[b].direction);
  });
  Map map(surface);
  const std::int32_t north = map.add(surface(axis)), south = map.add(surface(-axis));
  std::vector<std::vector<std::int32_t>> arcs;  // arcs[i]: from north to south, after the i-th of the order
  for (std::size_t i = 0; i < n; ++i)
    arcs.push_back(map.add(arc_by(map, axis, crotch(slots[order[i]], slots[order[(i + 1) % n]], axis),
                                  Vec3(-axis), sides / 2, even)));
  map.made.rings.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<std::int32_t>& ring = map.made.rings[order[i]];
    ring.push_back(north);
    append(ring, arcs[(i + n - 1) % n], false);
    ring.push_back(south);
    append(ring, arcs[i], true);
  }
  return std::move(map.made);
}

/// Directions of the border between two branches, which is the shorter way from one pole to another.
std::vector<Vec3> border(const Vec3& from, const Vec3& to) {
  const double angle = std::acos(std::clamp(from.dot(to), -1.0, 1.0));
  std::vector<Vec3> directions;
  for (int k = 0; k <= 2 * samples; ++k) directions.push_back(turned(from, to, angle * k / (2.0 * samples)));
  return directions;
}

/// The two slots that a pair leaves.
std::array<std::size_t, 2> others(std::size_t i, std::size_t k) {
  std::array<std::size_t, 2> rest{};
  std::size_t count = 0;
  for (std::size_t s = 0; s < 4; ++s)
    if (s != i && s != k) rest[count++] = s;
  return rest;
}

/// Outward normals of the tetrahedron of four directions; the i-th is away from direction i. None if flat.
std::optional<std::array<Vec3, 4>> poles_of(const std::vector<Slot>& slots) {
  std::array<Vec3, 4> poles{};
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Vec3, 3> face{};
    std::size_t count = 0;
    for (std::size_t s = 0; s < 4; ++s)
      if (s != i) face[count++] = slots[s].direction;
    const Vec3 normal = (face[1] - face[0]).cross(face[2] - face[0]);
    if (normal.norm() < 1e-6) return std::nullopt;
    poles[i] = normal.normalized();
    const double inwards = poles[i].dot(slots[i].direction - face[0]);
    if (std::abs(inwards) < 1e-3) return std::nullopt;
    if (inwards > 0.0) poles[i] = -poles[i];
  }
  return poles;
}

struct FourArcs {
  std::array<std::array<std::vector<Vec3>, 4>, 4> paths{};  // [i][k], i < k: from the pole of lesser number
  std::array<int, 3> edges{};                               // of the pairs 01|23, 02|13, 03|12
};
std::size_t pair_of(std::size_t i, std::size_t k) {
  return i == 0 ? k - 1 : k == 0 ? i - 1 : pair_of(0, 6 - i - k);
}

/// None where a pair of arcs is so short that it had better be none: then the branches lie in a plane.
std::optional<FourArcs> four_arcs(const Map& map, const std::array<Vec3, 4>& poles, int sides) {
  FourArcs arcs;
  std::array<double, 3> lengths{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = i + 1; k < 4; ++k) {
      const auto [p, q] = others(i, k);
      arcs.paths[i][k] = map.path(border(poles[p], poles[q]));
      lengths[pair_of(i, k)] += geometry::abscissas(arcs.paths[i][k]).back();
    }
  const double whole = lengths[0] + lengths[1] + lengths[2];
  std::array<double, 3> left{};
  int given = 0;
  for (std::size_t p = 0; p < 3; ++p) {
    const double share = sides * lengths[p] / whole;
    if (share < 0.5) return std::nullopt;
    arcs.edges[p] = std::max(1, static_cast<int>(share));
    left[p] = share - arcs.edges[p];
    given += arcs.edges[p];
  }
  for (; given < sides; ++given) {
    const auto most = static_cast<std::size_t>(std::max_element(left.begin(), left.end()) - left.begin());
    ++arcs.edges[most];
    left[most] -= 1.0;
  }
  for (; given > sides; --given) {
    const auto most =
        static_cast<std::size_t>(std::max_element(arcs.edges.begin(), arcs.edges.end()) - arcs.edges.begin());
    --arcs.edges[most];
  }
  return arcs;
}

std::optional<JointRings> four_poles(const std::vector<Slot>& slots, int sides, bool even,
                                     const SurfacePoint& surface) {
  const auto poles = poles_of(slots);
  if (!poles) return std::nullopt;
  Map map(surface);
  const auto arcs = four_arcs(map, *poles, sides);
  if (!arcs) return std::nullopt;
  for (const Vec3& pole : *poles) map.add(surface(pole));
  std::array<std::array<std::vector<std::int32_t>, 4>, 4> between;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = i + 1; k < 4; ++k)
      between[i][k] = map.add(spread(arcs->paths[i][k], arcs->edges[pair_of(i, k)], even));
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<std::size_t> corners;
    for (std::size_t s = 0; s < 4; ++s)
      if (s != i) corners.push_back(s);
    const Vec3 way =
        ((*poles)[corners[1]] - (*poles)[corners[0]]).cross((*poles)[corners[2]] - (*poles)[corners[0]]);
    if (way.dot(slots[i].direction) < 0.0) std::swap(corners[1], corners[2]);
    std::vector<std::int32_t>& ring = map.made.rings.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t p = corners[c], q = corners[(c + 1) % 3], k = corners[(c + 2) % 3];
      ring.push_back(static_cast<std::int32_t>(p));
      append(ring, between[std::min(i, k)][std::max(i, k)], p > q);
    }
  }
  return std::move(map.made);
}

}  // namespace

JointRings rings_about(const std::vector<Slot>& slots, int sides, const JointStyle& style,
                       const JointSurface& surface) {
  if (style.disc)
    if (auto made = about_thin_branch(slots, sides, surface)) return std::move(*made);
  if (style.four_poles && slots.size() == 4)
    if (auto made = four_poles(slots, sides, style.even, surface.at)) return std::move(*made);
  return two_poles(slots, sides, style.even, surface.at);
}

}  // namespace ostia::reconstruction
