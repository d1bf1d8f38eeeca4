#include "ostia/meshing/flat_caps.h"

#include "cutting/cap_regions.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace ostia::meshing {
namespace {

using geometry::Triangle;
using geometry::TriMesh;
using geometry::Vec3;

/// Triangles belong to one smooth region where they meet at less than this.
constexpr double smooth_deg = 12.0;
constexpr int rays_across = 16;

/// Slim triangles, whose normals are mostly rounding or what little their rim is uneven, part no smooth
/// region: what lies beyond them on either side says whether it goes on.
class SlimTriangles {
 public:
  explicit SlimTriangles(const Look& look) : look_(look) {
    constexpr double slim = 0.03;  // height over the longest edge
    for (std::size_t k = 0; k < look.edges.size(); ++k)
      for (const std::int32_t t : {look.edges[k].left, look.edges[k].right})
        if (t >= 0 && doubled_area(look.mesh, t).norm() < slim * squared_length(k)) sides_[t];
    if (sides_.empty()) return;
    for (std::size_t k = 0; k < look.edges.size(); ++k)
      for (const std::int32_t t : {look.edges[k].left, look.edges[k].right})
        if (const auto found = sides_.find(t); found != sides_.end()) found->second.push_back(k);
    for (auto& [t, edges] : sides_)
      std::ranges::sort(edges, std::greater{}, [&](std::size_t k) { return squared_length(k); });
  }

  /// For each of Look::edges whether the region goes on across it, by what lies beyond slim triangles.
  std::vector<std::uint8_t> bridged() const {
    std::vector<std::uint8_t> result(look_.edges.size(), 0);
    std::vector<std::size_t> crossed;
    for (const auto& [t, edges] : sides_) {
      if (edges.size() != 3) continue;
      crossed.clear();
      const std::int32_t one = beyond(t, edges[0], crossed), other = beyond(t, edges[1], crossed);
      if (one < 0 || other < 0 || look_.angle_deg({0, 0, one, other}) >= smooth_deg) continue;
      for (const std::size_t k : crossed) result[k] = 1;
    }
    return result;
  }

 private:
  double squared_length(std::size_t k) const {
    const SharedEdge& e = look_.edges[k];
    return (look_.mesh.points[static_cast<std::size_t>(e.a)] -
            look_.mesh.points[static_cast<std::size_t>(e.b)])
        .squaredNorm();
  }

  /// The first triangle that is not slim, out of `t` across its long edge `k` and across long edges from
  /// there on; -1 where there is none near by. Appends the edges on the way.
  std::int32_t beyond(std::int32_t t, std::size_t k, std::vector<std::size_t>& crossed) const {
    constexpr int most_steps = 8;
    for (int step = 0; step < most_steps; ++step) {
      crossed.push_back(k);
      t = look_.edges[k].left == t ? look_.edges[k].right : look_.edges[k].left;
      if (t < 0) return -1;
      const auto slim = sides_.find(t);
      if (slim == sides_.end()) return t;
      const std::vector<std::size_t>& edges = slim->second;
      if (edges.size() != 3 || edges[2] == k) return -1;
      k = edges[0] == k ? edges[1] : edges[0];
    }
    return -1;
  }

  const Look& look_;
  std::map<std::int32_t, std::vector<std::size_t>> sides_;  // of each its edges, the longest first
};

std::vector<Region> caps_by_shape(const Look& look, const FlatCapOptions& options) {
  std::vector<Region> caps;
  std::optional<geometry::AabbTree> tree;
  const std::vector<std::uint8_t> bridged = SlimTriangles(look).bridged();
  const auto smooth = [&](const SharedEdge& e) {
    return bridged[static_cast<std::size_t>(&e - look.edges.data())] != 0 || look.angle_deg(e) < smooth_deg;
  };
  for (Region& region : regions(look, smooth)) {
    measure(look, region);
    if (!is_flat(region, options) || region.rim_deg < options.least_rim_deg) continue;
    if (!tree) tree.emplace(look.mesh);
    if (!is_as_wide_as_lumen(*tree, region.end)) continue;
    caps.push_back(std::move(region));
  }
  return caps;
}

/// Caps that touch another one leave no rim that is a loop: they are flat spots of a rough wall.
void keep_those_apart(const Look& look, std::vector<Region>& caps) {
  std::map<std::int32_t, int> uses;
  const auto points_of_rim = [&](const Region& cap) {
    std::set<std::int32_t> points;
    for (const std::size_t k : cap.rim) points.insert({look.edges[k].a, look.edges[k].b});
    return points;
  };
  for (const Region& cap : caps)
    for (const std::int32_t p : points_of_rim(cap)) ++uses[p];
  std::erase_if(caps, [&](const Region& cap) {
    return std::ranges::any_of(points_of_rim(cap), [&](std::int32_t p) { return uses[p] > 1; });
  });
}

/// A part that would be nothing but caps (a box, a disc) is no vessel: its regions are no caps.
void keep_those_with_wall(const TriMesh& mesh, std::vector<Region>& caps) {
  const std::vector<std::int32_t> part = geometry::components(mesh);
  std::map<std::int32_t, double> area;
  for (std::size_t i = 0; i < part.size(); ++i)
    area[part[i]] += 0.5 * doubled_area(mesh, static_cast<std::int32_t>(i)).norm();
  std::map<std::int32_t, double> capped;
  const auto part_of = [&](const Region& cap) { return part[static_cast<std::size_t>(cap.triangles[0])]; };
  for (const Region& cap : caps) capped[part_of(cap)] += cap.area_mm2;
  std::erase_if(caps, [&](const Region& cap) { return capped[part_of(cap)] > 0.5 * area[part_of(cap)]; });
}

/// Labels that no cap came of; a cap that was known by its shape takes its label's name.
std::vector<LabelNotTaken> still_not_taken(const LabelledCaps& labelled, std::vector<Region>& caps) {
  std::vector<LabelNotTaken> none = labelled.not_taken;
  for (const Region& cap : labelled.caps) none.push_back({cap.end, true});
  std::erase_if(none, [&](const LabelNotTaken& one) {
    const auto same = std::ranges::find_if(caps, [&](const Region& cap) {
      return (cap.end.centre - one.end.centre).norm() < 0.5 * cap.end.radius_mm;
    });
    if (same == caps.end()) return false;
    if (same->end.name.empty()) same->end.name = one.end.name, same->end.kind = one.end.kind;
    return true;
  });
  return none;
}

std::string without_start(std::string name, const std::string& start) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  if (name.size() >= start.size() &&
      std::equal(start.begin(), start.end(), name.begin(), [&](char s, char n) { return same(n, s); }))
    return name.substr(start.size());
  return name;
}

}  // namespace

void validate(const FlatCapOptions& o) {
  const auto in = [](double value, double low, double high, const char* name) {
    if (!(value >= low && value <= high))
      throw InvalidInput(std::string("flat caps: ") + name + " " + std::to_string(value) + " must lie in [" +
                         std::to_string(low) + ", " + std::to_string(high) + "]");
  };
  in(o.flat_tolerance, 1e-9, 0.5, "flat_tolerance");
  in(o.least_rim_deg, 10.0, 90.0, "least_rim_deg");
  in(o.least_roundness, 1e-9, 1.0, "least_roundness");
}

GivenEnd end_at_loop(const TriMesh& mesh, const std::vector<std::int32_t>& loop) {
  GivenEnd end;
  Vec3 area = Vec3::Zero();
  double length = 0.0;
  const auto at = [&](std::size_t i) -> const Vec3& {
    return mesh.points[static_cast<std::size_t>(loop[i % loop.size()])];
  };
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double step = (at(i + 1) - at(i)).norm();
    end.centre += step * 0.5 * (at(i) + at(i + 1));
    length += step;
  }
  if (length > 0.0) end.centre /= length;
  for (std::size_t i = 0; i < loop.size(); ++i)
    area -= 0.5 * (at(i) - end.centre).cross(at(i + 1) - end.centre);  // the hole lies to the right
  end.normal = area.normalized();
  end.radius_mm = std::sqrt(area.norm() / std::numbers::pi);
  return end;
}

double lumen_width_behind(const geometry::AabbTree& tree, const GivenEnd& end, double depth_radii) {
  // In steps, in the middle of the lumen again after each: where the end is aslant, its normal leaves it.
  constexpr double step_radii = 0.25, most_aside = 1.5;
  const Vec3 across = end.normal.unitOrthogonal(), other = end.normal.cross(across);
  Vec3 middle = end.centre;
  std::vector<double> lengths;
  const int steps = std::max(1, static_cast<int>(std::lround(depth_radii / step_radii)));
  const double step = depth_radii / steps * end.radius_mm;
  for (int k = 0; k < steps; ++k) {
    middle -= step * end.normal;
    lengths.clear();
    Vec3 aside = Vec3::Zero();  // of a circle's middle: 2 / n of the sum of the lengths
    for (int i = 0; i < rays_across; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / rays_across;
      const Vec3 way = std::cos(angle) * across + std::sin(angle) * other;
      if (const auto hit = tree.first_hit(middle, way)) {
        lengths.push_back(hit->t);
        aside += 2.0 / rays_across * hit->t * way;
      }
    }
    if (static_cast<int>(lengths.size()) < rays_across || k + 1 == steps) continue;
    middle += aside * std::min(1.0, most_aside * step / std::max(aside.norm(), 1e-300));
  }
  if (lengths.size() < rays_across / 2) return 0.0;
  std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2));
  return lengths[lengths.size() / 2];
}

bool is_hole_in_wall(const geometry::AabbTree& closed, const GivenEnd& opening) {
  constexpr double hole_share = 0.55;
  return opening.radius_mm < hole_share * lumen_width_behind(closed, opening);
}

GivenEnd end_named(const std::string& name) {
  GivenEnd end;
  std::string rest = name;
  for (const std::string suffix : {".vtp", ".stl"})
    if (rest.size() > suffix.size() && rest.ends_with(suffix)) rest.resize(rest.size() - suffix.size());
  for (const auto& [start, kind] : {std::pair{"inlet", geometry::FaceKind::inlet},
                                    {"inflow", geometry::FaceKind::inlet},
                                    {"outlet", geometry::FaceKind::outlet},
                                    {"outflow", geometry::FaceKind::outlet}}) {
    const std::string shorter = without_start(rest, start);
    if (shorter == rest) continue;
    end.kind = kind;
    rest = shorter;
    break;
  }
  rest = without_start(rest, "cap_");
  for (char& c : rest)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  const std::size_t first = rest.find_first_not_of('_');
  end.name = first == std::string::npos ? "" : rest.substr(first);
  return end;
}

OpenedCaps without_flat_caps(const geometry::FacedSurface& surface, const FlatCapOptions& options,
                             const core::TaskContext& task) {
  validate(options);
  const TriMesh& mesh = surface.mesh;
  if (!surface.face_ids.empty() && surface.face_ids.size() != mesh.triangles.size())
    throw InvalidInput("flat caps: " + std::to_string(surface.face_ids.size()) + " face ids for " +
                       std::to_string(mesh.triangles.size()) + " triangles; one a triangle is needed");
  OpenedCaps opened;
  const Look look(mesh);
  task.throw_if_cancelled();
  LabelledCaps labelled;
  if (!surface.face_ids.empty()) labelled = caps_by_label(look, surface, options);
  std::vector<Region> caps = labelled.caps;
  if (caps.empty() && options.by_shape) caps = caps_by_shape(look, options);
  task.throw_if_cancelled();
  keep_those_apart(look, caps);
  keep_those_with_wall(mesh, caps);
  opened.not_taken = still_not_taken(labelled, caps);
  std::vector<bool> keep(mesh.triangles.size(), true);
  for (Region& cap : caps) {
    for (const std::int32_t t : cap.triangles) keep[static_cast<std::size_t>(t)] = false;
    opened.ends.push_back(std::move(cap.end));
  }
  opened.wall = caps.empty() ? mesh : geometry::subset(mesh, keep);
  return opened;
}

}  // namespace ostia::meshing
