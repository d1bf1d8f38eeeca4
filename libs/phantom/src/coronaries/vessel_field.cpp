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
  double most_mm = 0.0;             // that radius
};

/// Squared distance of a point from a box, 0 inside; without the branches of Eigen's, which are guessed
/// wrong.
double squared_distance(const Box3& box, const Vec3& p) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0.0).squaredNorm();
}

/// What the search for feet reads of an axis point, side by side in memory.
struct Station {
  Vec3 point, tangent;
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

/// Nodules of calcium are lenses; other bodies fill the wall's thickness and taper towards their ends.
bool holds(const Plaque& plaque, double s_mm, double theta, double depth) {
  const double along = 2.0 * std::abs(s_mm - plaque.s_centre_mm) / plaque.length_mm;
  if (along >= 1.0 || depth < plaque.depth_from || depth > plaque.depth_to) return false;
  const double turn = std::abs(std::remainder(theta - plaque.theta_centre, 2.0 * std::numbers::pi));
  const double around = 2.0 * turn / plaque.theta_extent;
  const double left = 1.0 - along * along - around * around;
  if (plaque.kind != PlaqueKind::calcified) return left > 0.0;
  const double through = (2.0 * depth - plaque.depth_from - plaque.depth_to) /
                         std::max(1e-6, plaque.depth_to - plaque.depth_from);
  return left > through * through;
}

/// Whether a place within the thickness of a stent lies on one of its struts: rings of zigzags in phase,
/// three links from each to the next.
bool is_metal(const Stent& stent, const VesselField::Place& place) {
  if (!stent.struts) return true;
  constexpr double pitch_mm = 1.1, swing_mm = 0.4, half_width_mm = 0.05;
  constexpr int crowns = 6, links = 3;
  const double s = place.s_mm - stent.s_from_mm, turn = 2.0 * std::numbers::pi;
  // From -1 to 1 and back with every crown.
  const double saw = 4.0 * std::abs(std::remainder(place.theta * crowns / turn, 1.0)) - 1.0;
  const double radius = std::max(0.2, place.lumen_mm);
  const double slope = 4.0 * swing_mm * crowns / (turn * radius);
  const double along = s - swing_mm * saw;
  const double ring = pitch_mm * (std::floor(along / pitch_mm) + 0.5);
  if (std::abs(along - ring) < half_width_mm * std::sqrt(1.0 + slope * slope)) return true;
  const double aside = std::remainder(
      place.theta - (std::fmod(std::floor(along / pitch_mm), 2.0) * 0.5 * turn / links), turn / links);
  return std::abs(aside) * radius < half_width_mm;
}

}  // namespace

struct VesselField::Impl {
  CoronaryTree tree;
  std::vector<std::vector<Station>> stations;  // one list a vessel
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

  /// `visit` may shorten the reach as it goes.
  template <class Visit>
  void near(const Vec3& p, const double& reach, const Visit& visit) const {
    std::int32_t stack[64];
    int top = 0;
    if (!nodes.empty()) stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes[static_cast<std::size_t>(stack[--top])];
      const double bound = reach > 0.0 ? reach * reach : 0.0;
      if (squared_distance(node.box, p) > bound) continue;
      if (node.left >= 0) {
        stack[top++] = node.right;
        stack[top++] = node.left;
        continue;
      }
      for (std::int32_t i = node.first; i < node.last; ++i) {
        const Chunk& chunk = chunks[static_cast<std::size_t>(i)];
        if (squared_distance(chunk.box, p) <= bound) visit(chunk);
      }
    }
  }

  /// A foot on an axis: at `t` between points `i` and the next, `s_mm` along, and the way from it to the
  /// place.
  struct Foot {
    std::int32_t vessel = 0;
    std::size_t i = 0;
    double t = 0.0, s_mm = 0.0;
    Vec3 aside;
  };

  /// The place of a foot; `lumen_mm` and `wall_mm` only when asked for.
  Place place_at(const Foot& foot, bool lumen, bool wall) const {
    const CoronaryVessel& v = tree.vessels[static_cast<std::size_t>(foot.vessel)];
    const std::size_t j = std::min(foot.i + 1, v.axis.size() - 1);
    const geometry::Frame &a = v.axis.frames[foot.i], &b = v.axis.frames[j];
    const Vec3 n = (1.0 - foot.t) * a.normal + foot.t * b.normal;
    const Vec3 m = (1.0 - foot.t) * a.binormal + foot.t * b.binormal;
    Place place;
    place.vessel = foot.vessel;
    place.s_mm = foot.s_mm;
    const double x = foot.aside.dot(n), y = -foot.aside.dot(m);  // geometry::radial_direction's angle
    place.theta = x == 0.0 && y == 0.0 ? 0.0 : std::atan2(y, x);
    place.rho_mm = foot.aside.norm();
    if (lumen) place.lumen_mm = v.lumen.at(foot.s_mm, place.theta);
    if (wall) place.wall_mm = v.wall.at(foot.s_mm, place.theta);
    return place;
  }

  /// The foot where the axis' normal planes, which turn evenly between its points, pass through p from behind
  /// to ahead (there is one at most nearer than the axis' radius of curvature, in so short a piece); places
  /// beyond the ends have their foot at the end.
  template <class Take>
  void feet(const Chunk& chunk, const Vec3& p, const Take& take) const {
    const auto& axis = stations[static_cast<std::size_t>(chunk.vessel)];
    const auto& abscissa = tree.vessels[static_cast<std::size_t>(chunk.vessel)].axis.abscissa;
    const auto ahead_of = [&](std::size_t i) { return (p - axis[i].point).dot(axis[i].tangent); };
    double ahead = ahead_of(chunk.first), next = ahead_of(chunk.last);
    if (chunk.first == 0 && ahead < 0.0)
      take(Foot{chunk.vessel, 0, 0.0, ahead, p - axis[0].point - ahead * axis[0].tangent});
    if (chunk.last + 1 == axis.size() && next >= 0.0)
      take(Foot{chunk.vessel, chunk.last, 0.0, abscissa.back() + next,
                p - axis.back().point - next * axis.back().tangent});
    if (ahead < 0.0 || next >= 0.0) return;
    std::size_t i = chunk.first, j = chunk.last;
    while (j - i > 1) {
      const std::size_t middle = (i + j) / 2;
      const double there = ahead_of(middle);
      (there >= 0.0 ? i : j) = middle;
      (there >= 0.0 ? ahead : next) = there;
    }
    const Station &a = axis[i], &b = axis[j];
    double t = ahead / (ahead - next);
    for (int step = 0; step < 2; ++step) {  // the planes' equation is quadratic and nearly linear
      const Vec3 from = p - ((1.0 - t) * a.point + t * b.point);
      const Vec3 tangent = (1.0 - t) * a.tangent + t * b.tangent;
      const double slope = from.dot(b.tangent - a.tangent) - (b.point - a.point).dot(tangent);
      if (slope == 0.0) break;
      t = std::clamp(t - from.dot(tangent) / slope, 0.0, 1.0);
    }
    take(Foot{chunk.vessel, i, t, abscissa[i] + t * (abscissa[j] - abscissa[i]),
              p - ((1.0 - t) * a.point + t * b.point)});
  }

  /// How far a place lies beyond the vessel's flat ends; negative between them.
  double beyond(const Place& place) const {
    const double length = tree.vessels[static_cast<std::size_t>(place.vessel)].axis.abscissa.back();
    return std::max(-place.s_mm, place.s_mm - length);
  }

  const Stent* stent_at(const Place& place) const {
    for (const Stent& stent : tree.vessels[static_cast<std::size_t>(place.vessel)].stents)
      if (place.s_mm >= stent.s_from_mm && place.s_mm <= stent.s_to_mm) return &stent;
    return nullptr;
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
    impl_->stations.emplace_back();
    for (std::size_t i = 0; i < axis.size(); ++i)
      impl_->stations.back().push_back({axis.points[i], axis.frames[i].tangent});
    for (std::size_t first = 0; first + 1 < axis.size(); first += chunk_pieces) {
      Chunk chunk{
          static_cast<std::int32_t>(v), first, std::min(first + chunk_pieces, axis.size() - 1), {}, 0.0};
      for (std::size_t i = chunk.first; i <= chunk.last; ++i) chunk.box.extend(axis.points[i]);
      double most = 0.0;
      for (std::size_t i = chunk.first; i <= chunk.last; i += 3)
        most = std::max(most, tree.vessels[v].wall.max_at(axis.abscissa[i]));
      chunk.most_mm = std::min(reach, 1.1 * most + 0.05);
      const Vec3 grown = Vec3::Constant(chunk.most_mm);
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
    impl_->feet(chunk, point, [&](const Impl::Foot& foot) {
      if (foot.aside.norm() - chunk.most_mm > reach_mm) return;
      const Place place = impl_->place_at(foot, true, true);
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
  const bool lumen = boundary == Boundary::lumen;
  impl_->near(point, least, [&](const Chunk& chunk) {
    impl_->feet(chunk, point, [&](const Impl::Foot& foot) {
      if (foot.aside.norm() - chunk.most_mm >= least) return;
      least = std::min(least, impl_->value(boundary, impl_->place_at(foot, lumen, !lumen)));
    });
  });
  return least;
}

std::optional<Material> VesselField::material(const Vec3& point) const {
  thread_local std::vector<Place> found;
  places(point, 0.0, found);
  if (found.empty()) return std::nullopt;
  std::optional<Material> metal;
  for (const Place& place : found) {
    const double inside = impl_->value(Boundary::lumen, place);
    if (inside >= 0.0) continue;
    // Where a branch leaves, its mouth stays open.
    const Stent* const stent = impl_->stent_at(place);
    if (stent == nullptr || inside < -stent->thickness_mm || !is_metal(*stent, place))
      return Material{Label::coronary_lumen, lumen_hu};
    metal = Material{Label::metal, stent->hu};
  }
  if (metal) return metal;
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
