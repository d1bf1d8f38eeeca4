#include "ostia/meshing/flat_caps.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace ostia::meshing {
namespace {

using geometry::Triangle;
using geometry::TriMesh;
using geometry::Vec3;

/// Triangles belong to one smooth region where they meet at less than this.
constexpr double smooth_deg = 12.0;
/// A cap is as wide as the lumen behind it, within these factors.
constexpr double narrowest_cap = 0.6, widest_cap = 1.67;
constexpr std::array depths_radii{0.5, 1.5};
constexpr int rays_across = 16;
constexpr std::size_t fewest_on_rim = 6;  // edges: four corners are a flat spot of a rough wall

/// An edge between two triangles.
struct SharedEdge {
  std::int32_t a, b;         ///< its points
  std::int32_t left, right;  ///< its triangles; right < 0 on a border
};

Vec3 doubled_area(const TriMesh& mesh, std::int32_t triangle) {
  const Triangle& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  const Vec3& a = mesh.points[static_cast<std::size_t>(t[0])];
  return (mesh.points[static_cast<std::size_t>(t[1])] - a)
      .cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
}

std::vector<SharedEdge> shared_edges(const TriMesh& mesh) {
  struct Side {
    std::int32_t low, high, triangle;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
      sides.push_back({low, high, static_cast<std::int32_t>(i)});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.triangle); });
  std::vector<SharedEdge> edges;
  for (const Side& s : sides) {
    if (!edges.empty() && edges.back().a == s.low && edges.back().b == s.high)
      edges.back().right = s.triangle;
    else
      edges.push_back({s.low, s.high, s.triangle, -1});
  }
  return edges;
}

/// What is looked at once for all candidates.
struct Look {
  const TriMesh& mesh;
  std::vector<SharedEdge> edges;
  std::vector<Vec3> normals;  ///< unit; zero for a triangle without area

  explicit Look(const TriMesh& m) : mesh(m), edges(shared_edges(m)) {
    for (std::size_t i = 0; i < m.triangles.size(); ++i)
      normals.push_back(doubled_area(m, static_cast<std::int32_t>(i)).normalized());
  }
  double angle_deg(const SharedEdge& e) const {
    const double cosine =
        normals[static_cast<std::size_t>(e.left)].dot(normals[static_cast<std::size_t>(e.right)]);
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
  }
};

/// A connected set of triangles that may be a cap.
struct Region {
  std::vector<std::int32_t> triangles;
  std::vector<std::size_t> rim;  ///< of Look::edges
  double area_mm2 = 0.0, rim_mm = 0.0, rim_deg = 0.0, deviation_mm = 0.0;
  bool one_loop = false, on_border = false;
  GivenEnd end;
};

/// Triangles joined across the edges that `same` accepts.
template <class Same>
std::vector<Region> regions(const Look& look, Same same) {
  geometry::DisjointSets sets(look.mesh.triangles.size());
  for (const SharedEdge& e : look.edges)
    if (e.right >= 0 && same(e)) sets.join(e.left, e.right);
  std::map<std::int32_t, std::size_t> number;
  std::vector<Region> found;
  std::vector<std::size_t> region_of;
  for (std::size_t i = 0; i < look.mesh.triangles.size(); ++i) {
    const auto [at, is_new] = number.emplace(sets.find(static_cast<std::int32_t>(i)), found.size());
    if (is_new) found.emplace_back();
    found[at->second].triangles.push_back(static_cast<std::int32_t>(i));
    region_of.push_back(at->second);
  }
  for (std::size_t k = 0; k < look.edges.size(); ++k) {
    const SharedEdge& e = look.edges[k];
    const std::size_t left = region_of[static_cast<std::size_t>(e.left)];
    if (e.right < 0) {
      found[left].on_border = true;
      continue;
    }
    const std::size_t right = region_of[static_cast<std::size_t>(e.right)];
    if (left == right) continue;
    found[left].rim.push_back(k);
    found[right].rim.push_back(k);
  }
  return found;
}

/// A rim whose points have two of its edges each and hang together is one loop.
bool is_one_loop(const Look& look, const std::vector<std::size_t>& rim) {
  std::map<std::int32_t, std::vector<std::int32_t>> next;
  for (const std::size_t k : rim) {
    next[look.edges[k].a].push_back(look.edges[k].b);
    next[look.edges[k].b].push_back(look.edges[k].a);
  }
  if (next.size() < 3) return false;
  for (const auto& [point, others] : next)
    if (others.size() != 2) return false;
  std::size_t steps = 0;
  std::int32_t before = -1, at = next.begin()->first;
  do {
    const std::vector<std::int32_t>& others = next[at];
    const std::int32_t to = others[0] == before ? others[1] : others[0];
    before = at;
    at = to;
    ++steps;
  } while (at != next.begin()->first && steps <= next.size());
  return steps == next.size();
}

void measure(const Look& look, Region& region) {
  const TriMesh& mesh = look.mesh;
  Vec3 sum = Vec3::Zero(), centre = Vec3::Zero();
  for (const std::int32_t t : region.triangles) {
    sum += 0.5 * doubled_area(mesh, t);
    region.area_mm2 += 0.5 * doubled_area(mesh, t).norm();
  }
  region.end.normal = sum.normalized();
  for (const std::size_t k : region.rim) {
    const SharedEdge& e = look.edges[k];
    const Vec3 &a = mesh.points[static_cast<std::size_t>(e.a)],
               &b = mesh.points[static_cast<std::size_t>(e.b)];
    const double length = (b - a).norm();
    region.rim_mm += length;
    region.rim_deg += length * look.angle_deg(e);
    centre += length * 0.5 * (a + b);
  }
  if (!(region.rim_mm > 0.0)) return;
  region.rim_deg /= region.rim_mm;
  region.end.centre = centre / region.rim_mm;
  region.end.radius_mm = std::sqrt(region.area_mm2 / std::numbers::pi);
  for (const std::int32_t t : region.triangles)
    for (const std::int32_t v : mesh.triangles[static_cast<std::size_t>(t)])
      region.deviation_mm = std::max(
          region.deviation_mm,
          std::abs((mesh.points[static_cast<std::size_t>(v)] - region.end.centre).dot(region.end.normal)));
  region.one_loop = is_one_loop(look, region.rim);
}

bool is_flat(const Region& region, const FlatCapOptions& o) {
  const double roundness = 4.0 * std::numbers::pi * region.area_mm2 / (region.rim_mm * region.rim_mm);
  return !region.on_border && region.one_loop && region.rim.size() >= fewest_on_rim &&
         roundness >= o.least_roundness && region.deviation_mm <= o.flat_tolerance * region.end.radius_mm;
}

std::vector<Region> caps_by_label(const Look& look, const geometry::FacedSurface& surface,
                                  const FlatCapOptions& options) {
  std::vector<Region> caps;
  std::vector<Region> all = regions(look, [&](const SharedEdge& e) {
    return surface.face_ids[static_cast<std::size_t>(e.left)] ==
           surface.face_ids[static_cast<std::size_t>(e.right)];
  });
  std::map<std::int32_t, int> parts;  // a cap's label is one piece
  for (const Region& region : all) ++parts[surface.face_ids[static_cast<std::size_t>(region.triangles[0])]];
  for (Region& region : all) {
    const std::int32_t id = surface.face_ids[static_cast<std::size_t>(region.triangles[0])];
    const auto face = std::ranges::find(surface.faces, id, &geometry::Face::id);
    measure(look, region);
    if (parts[id] > 1 || !is_flat(region, options) || region.rim_deg < 0.5 * options.least_rim_deg) continue;
    if (face != surface.faces.end()) {
      const GivenEnd named = end_named(face->name);
      region.end.name = named.name;
      region.end.kind = named.kind;
    }
    caps.push_back(std::move(region));
  }
  return caps;
}

std::vector<Region> caps_by_shape(const Look& look, const FlatCapOptions& options) {
  std::vector<Region> caps;
  std::optional<geometry::AabbTree> tree;
  for (Region& region : regions(look, [&](const SharedEdge& e) { return look.angle_deg(e) < smooth_deg; })) {
    measure(look, region);
    if (!is_flat(region, options) || region.rim_deg < options.least_rim_deg) continue;
    if (!tree) tree.emplace(look.mesh);
    // A bump of a rough wall has its own width only as far as it is high.
    const bool as_wide = std::ranges::all_of(depths_radii, [&](double depth) {
      const double behind = lumen_width_behind(*tree, region.end, depth);
      return region.end.radius_mm >= narrowest_cap * behind && region.end.radius_mm <= widest_cap * behind;
    });
    if (!as_wide) continue;
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
  std::vector<Region> caps;
  if (!surface.face_ids.empty()) caps = caps_by_label(look, surface, options);
  if (caps.empty()) caps = caps_by_shape(look, options);
  task.throw_if_cancelled();
  keep_those_apart(look, caps);
  keep_those_with_wall(mesh, caps);
  std::vector<bool> keep(mesh.triangles.size(), true);
  for (Region& cap : caps) {
    for (const std::int32_t t : cap.triangles) keep[static_cast<std::size_t>(t)] = false;
    opened.ends.push_back(std::move(cap.end));
  }
  opened.wall = caps.empty() ? mesh : geometry::subset(mesh, keep);
  return opened;
}

}  // namespace ostia::meshing
