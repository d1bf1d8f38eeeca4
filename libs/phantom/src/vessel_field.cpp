#include "ostia/phantom/vessel_field.h"

#include "ostia/geometry/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace ostia::phantom {
namespace {

using geometry::Box3;
using geometry::Centerline;

/// Axis pieces that share a box.
constexpr std::size_t chunk_pieces = 12;
constexpr float lumen_hu = 390.0f, wall_hu = 45.0f;

struct Chunk {
  std::int32_t vessel = 0;
  std::size_t first = 0, last = 0;  // axis points [first, last]
  Box3 box;                         // of the axis points, grown by the largest outer radius near them
};

Material material_of(PlaqueKind kind, float hu) {
  switch (kind) {
    case PlaqueKind::calcified:
      return {Label::calcified_plaque, hu};
    case PlaqueKind::fibrous:
    case PlaqueKind::mixed:
      return {Label::fibrous_plaque, hu};
    case PlaqueKind::soft:
      break;
  }
  return {Label::soft_plaque, hu};
}

/// Bodies of plaque taper towards their ends: what is left of the extent at a place along them.
bool holds(const Plaque& plaque, double s_mm, double theta, double depth) {
  const double along = 2.0 * std::abs(s_mm - plaque.s_centre_mm) / plaque.length_mm;
  if (along >= 1.0 || depth < plaque.depth_from || depth > plaque.depth_to) return false;
  const double around = std::abs(std::remainder(theta - plaque.theta_centre, 2.0 * std::numbers::pi));
  return 2.0 * around < plaque.theta_extent * std::sqrt(1.0 - along * along);
}

}  // namespace

struct VesselField::Impl {
  CoronaryTree tree;
  std::vector<Chunk> chunks;
  struct Node {
    Box3 box;
    std::int32_t left = -1, right = -1;  // -1: a leaf
    std::int32_t first = 0, last = 0;    // chunks [first, last)
  };
  std::vector<Node> nodes;

  std::int32_t build(std::int32_t first, std::int32_t last) {
    const auto at = static_cast<std::int32_t>(nodes.size());
    nodes.emplace_back();
    Box3 box;
    for (std::int32_t i = first; i < last; ++i) box.extend(chunks[static_cast<std::size_t>(i)].box);
    std::int32_t left = -1, right = -1;
    if (last - first > 2) {
      int axis = 0;
      box.sizes().maxCoeff(&axis);
      const std::int32_t middle = (first + last) / 2;
      std::nth_element(chunks.begin() + first, chunks.begin() + middle, chunks.begin() + last,
                       [axis](const Chunk& a, const Chunk& b) {
                         const double ca = a.box.center()[axis], cb = b.box.center()[axis];
                         return ca != cb ? ca < cb
                                         : std::tie(a.vessel, a.first) < std::tie(b.vessel, b.first);
                       });
      left = build(first, middle);
      right = build(middle, last);
    }
    nodes[static_cast<std::size_t>(at)] = {box, left, right, first, last};
    return at;
  }

  template <class Visit>
  void near(const Vec3& p, double reach, const Visit& visit) const {
    std::int32_t stack[64];
    int top = 0;
    if (!nodes.empty()) stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes[static_cast<std::size_t>(stack[--top])];
      if (node.box.squaredExteriorDistance(p) > reach * reach) continue;
      if (node.left >= 0) {
        stack[top++] = node.right;
        stack[top++] = node.left;
        continue;
      }
      for (std::int32_t i = node.first; i < node.last; ++i) {
        const Chunk& chunk = chunks[static_cast<std::size_t>(i)];
        if (chunk.box.squaredExteriorDistance(p) <= reach * reach) visit(chunk);
      }
    }
  }

  /// The place whose foot is at the axis' abscissa s, given the vector from the axis and the frames' mixture.
  Place place_at(std::int32_t vessel, std::size_t i, double t, double s, const Vec3& from_axis) const {
    const CoronaryVessel& v = tree.vessels[static_cast<std::size_t>(vessel)];
    const std::size_t j = std::min(i + 1, v.axis.size() - 1);
    const geometry::Frame &a = v.axis.frames[i], &b = v.axis.frames[j];
    const Vec3 n = (1.0 - t) * a.normal + t * b.normal, m = (1.0 - t) * a.binormal + t * b.binormal;
    Place place;
    place.vessel = vessel;
    place.s_mm = s;
    const double x = from_axis.dot(n), y = -from_axis.dot(m);
    place.theta = x == 0.0 && y == 0.0 ? 0.0 : std::atan2(y, x);
    place.rho_mm = from_axis.norm();
    place.lumen_mm = v.lumen.at(s, place.theta);
    place.wall_mm = v.wall.at(s, place.theta);
    return place;
  }

  /// Feet where the axis' normal planes, which turn evenly between its points, pass through p from behind to
  /// ahead.
  template <class Take>
  void feet(const Chunk& chunk, const Vec3& p, const Take& take) const {
    const Centerline& axis = tree.vessels[static_cast<std::size_t>(chunk.vessel)].axis;
    double ahead = (p - axis.points[chunk.first]).dot(axis.frames[chunk.first].tangent);
    if (chunk.first == 0 && ahead < 0.0) {
      const Vec3 aside = p - axis.points[0] - ahead * axis.frames[0].tangent;
      take(place_at(chunk.vessel, 0, 0.0, ahead, aside));
    }
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const double next = (p - axis.points[i + 1]).dot(axis.frames[i + 1].tangent);
      if (ahead >= 0.0 && next < 0.0) {
        double t = ahead / (ahead - next);
        for (int step = 0; step < 3; ++step) {  // the planes' equation is quadratic and nearly linear
          const Vec3 c = (1.0 - t) * axis.points[i] + t * axis.points[i + 1];
          const Vec3 tangent = (1.0 - t) * axis.frames[i].tangent + t * axis.frames[i + 1].tangent;
          const double f = (p - c).dot(tangent);
          const double slope = (p - c).dot(axis.frames[i + 1].tangent - axis.frames[i].tangent) -
                               (axis.points[i + 1] - axis.points[i]).dot(tangent);
          if (slope == 0.0) break;
          t = std::clamp(t - f / slope, 0.0, 1.0);
        }
        const Vec3 c = (1.0 - t) * axis.points[i] + t * axis.points[i + 1];
        const double s = axis.abscissa[i] + t * (axis.abscissa[i + 1] - axis.abscissa[i]);
        take(place_at(chunk.vessel, i, t, s, p - c));
      }
      ahead = next;
    }
    if (chunk.last + 1 == axis.size() && ahead >= 0.0) {
      const Vec3 aside = p - axis.points.back() - ahead * axis.frames.back().tangent;
      take(place_at(chunk.vessel, chunk.last, 0.0, axis.abscissa.back() + ahead, aside));
    }
  }

  /// How far a place lies beyond the vessel's flat ends; negative between them.
  double beyond(const Place& place) const {
    const double length = tree.vessels[static_cast<std::size_t>(place.vessel)].axis.abscissa.back();
    return std::max(-place.s_mm, place.s_mm - length);
  }

  double value(Boundary boundary, const Place& place) const {
    const double radius = boundary == Boundary::lumen ? place.lumen_mm : place.wall_mm;
    return std::max(place.rho_mm - radius, beyond(place));
  }
};

VesselField::VesselField(const CoronaryTree& tree) : impl_(std::make_unique<Impl>()) {
  impl_->tree = tree;
  for (std::size_t v = 0; v < tree.vessels.size(); ++v) {
    const Centerline& axis = tree.vessels[v].axis;
    const double reach = std::max(tree.vessels[v].lumen.largest(), tree.vessels[v].wall.largest());
    for (std::size_t first = 0; first + 1 < axis.size(); first += chunk_pieces) {
      Chunk chunk{static_cast<std::int32_t>(v), first, std::min(first + chunk_pieces, axis.size() - 1), {}};
      for (std::size_t i = chunk.first; i <= chunk.last; ++i) chunk.box.extend(axis.points[i]);
      double most = 0.0;
      for (std::size_t i = chunk.first; i <= chunk.last; i += 3)
        most = std::max(most, tree.vessels[v].wall.max_at(axis.abscissa[i]));
      const Vec3 grown = Vec3::Constant(std::min(reach, 1.1 * most + 0.05));
      chunk.box = Box3(chunk.box.min() - grown, chunk.box.max() + grown);
      impl_->chunks.push_back(chunk);
    }
  }
  if (!impl_->chunks.empty()) impl_->build(0, static_cast<std::int32_t>(impl_->chunks.size()));
}
VesselField::~VesselField() = default;
VesselField::VesselField(VesselField&&) noexcept = default;
VesselField& VesselField::operator=(VesselField&&) noexcept = default;

void VesselField::places(const Vec3& point, double reach_mm, std::vector<Place>& out) const {
  out.clear();
  impl_->near(point, reach_mm, [&](const Chunk& chunk) {
    impl_->feet(chunk, point, [&](const Place& place) {
      if (impl_->value(Boundary::wall, place) > reach_mm) return;
      for (Place& known : out) {
        if (known.vessel != place.vessel) continue;
        if (impl_->value(Boundary::lumen, place) < impl_->value(Boundary::lumen, known)) known = place;
        return;
      }
      out.push_back(place);
    });
  });
  std::sort(out.begin(), out.end(), [](const Place& a, const Place& b) { return a.vessel < b.vessel; });
}

double VesselField::value(Boundary boundary, const Vec3& point, double reach_mm) const {
  double least = reach_mm;
  impl_->near(point, reach_mm, [&](const Chunk& chunk) {
    impl_->feet(chunk, point,
                [&](const Place& place) { least = std::min(least, impl_->value(boundary, place)); });
  });
  return least;
}

std::optional<Material> VesselField::material(const Vec3& point) const {
  thread_local std::vector<Place> found;
  places(point, 0.0, found);
  if (found.empty()) return std::nullopt;
  for (const Place& place : found) {
    if (impl_->value(Boundary::lumen, place) < 0.0) return Material{Label::coronary_lumen, lumen_hu};
  }
  std::optional<Material> best;
  for (const Place& place : found) {
    if (impl_->value(Boundary::wall, place) >= 0.0) continue;
    const CoronaryVessel& vessel = impl_->tree.vessels[static_cast<std::size_t>(place.vessel)];
    const double depth = (place.rho_mm - place.lumen_mm) / std::max(1e-6, place.wall_mm - place.lumen_mm);
    for (const Plaque& plaque : vessel.plaques) {  // the last one that holds the place: cores lie in bodies
      if (holds(plaque, place.s_mm, place.theta, depth)) best = material_of(plaque.kind, plaque.hu);
    }
    if (!best) best = Material{Label::vessel_wall, wall_hu};
  }
  return best;
}

bool VesselField::near(const Box3& box, double reach_mm) const {
  const double reach2 = reach_mm * reach_mm;
  std::vector<std::int32_t> stack;
  if (!impl_->nodes.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const Impl::Node& node = impl_->nodes[static_cast<std::size_t>(stack.back())];
    stack.pop_back();
    if (node.box.squaredExteriorDistance(box) > reach2) continue;
    if (node.left >= 0) {
      stack.push_back(node.left);
      stack.push_back(node.right);
      continue;
    }
    for (std::int32_t i = node.first; i < node.last; ++i) {
      if (impl_->chunks[static_cast<std::size_t>(i)].box.squaredExteriorDistance(box) <= reach2) return true;
    }
  }
  return false;
}

Box3 VesselField::box() const {
  return impl_->nodes.empty() ? Box3() : impl_->nodes[0].box;
}

}  // namespace ostia::phantom
