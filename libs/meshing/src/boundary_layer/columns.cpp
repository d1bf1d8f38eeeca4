#include "boundary_layer/columns.h"

#include "cutting/cap_filling.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/meshing/quality.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

constexpr double thinning = 0.8;             // of the share of a point at fault, a round
constexpr double least_share = 1e-4;         // thinner than this is no layer
constexpr double most_visible_below = 0.05;  // share below which the direction is the most visible one
constexpr double thin_limit_kept = 0.95;     // of what an infinitely thin prism has, where that is too little

std::vector<double> layer_heights(int layers, double growth) {
  std::vector<double> heights{0.0};
  double step = 1.0;
  for (int i = 0; i < layers; ++i, step *= growth) heights.push_back(heights.back() + step);
  const double total = heights.back();
  for (double& h : heights) h /= total;
  return heights;
}

std::vector<double> visibilities(const std::vector<SightCone>& cones) {
  std::vector<double> largest(cones.size());
  core::parallel_for(cones.size(), 256,
                     [&](std::size_t i) { largest[i] = least_product(cones[i], most_visible(cones[i])); });
  return largest;
}

/// The least of quality over what is required around a point: at least 1 is well.
double standing(const Columns& columns, std::int32_t v) {
  double least = 1e300;
  for (const std::int32_t f : columns.wall.triangles_of[static_cast<std::size_t>(v)]) {
    const auto t = static_cast<std::size_t>(f);
    least = std::min(least, columns.quality(t) / std::max(columns.required(t), 1e-6));
  }
  return least;
}

/// Turns the direction of a point to where the worst column around it gets best. The candidates lie between
/// the direction, the neighbours' mean, and the most visible one.
void turn(Columns& columns, std::int32_t v) {
  const auto i = static_cast<std::size_t>(v);
  Vec3 mean = Vec3::Zero();
  for (const std::int32_t u : columns.wall.neighbours[i])
    mean += columns.directions[static_cast<std::size_t>(u)];
  const Vec3 visible = most_visible(columns.cones[i]);
  Vec3 best = columns.directions[i];
  double best_standing = standing(columns, v);
  const Vec3 start = best;
  for (const Vec3& target : {columns.wall.admissible(v, mean), visible})
    for (const double share : {0.3, 0.6, 1.0}) {
      const Vec3 candidate = columns.wall.admissible(v, (1.0 - share) * start + share * target);
      if (!candidate.allFinite() || !(least_product(columns.cones[i], candidate) > 0.0)) continue;
      columns.directions[i] = candidate;
      const double found = standing(columns, v);
      if (found > best_standing) best_standing = found, best = candidate;
    }
  columns.directions[i] = best;
}

/// Triangles whose column or inner triangle is not as required.
std::vector<std::size_t> local_faults(const Columns& columns) {
  std::vector<char> bad(columns.wall.mesh.triangles.size(), 0);
  core::parallel_for(bad.size(), 256, [&](std::size_t f) {
    bad[f] = columns.quality(f) < columns.required(f) ||
             columns.inner_angle_deg(f) < columns.required_angle_deg(f);
  });
  std::vector<std::size_t> faults;
  for (std::size_t f = 0; f < bad.size(); ++f)
    if (bad[f] != 0) faults.push_back(f);
  return faults;
}

std::vector<std::int32_t> points_of(const Columns& columns, const std::vector<std::size_t>& triangles) {
  std::vector<std::int32_t> points;
  for (const std::size_t f : triangles)
    for (const std::int32_t v : columns.wall.mesh.triangles[f]) points.push_back(v);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// Points of the wall where a cap cannot be filled, or where wall, layers' sides and inner surface cross.
std::vector<std::int32_t> global_faults(const Columns& columns) {
  const LayerWall& wall = columns.wall;
  const auto n = static_cast<std::int32_t>(wall.mesh.points.size());
  std::vector<std::int32_t> points;
  geometry::TriMesh all;
  try {
    all = columns.inner().mesh;
  } catch (const GeometryError&) {  // a ring crosses itself
    for (const WallRing& ring : wall.rings) points.insert(points.end(), ring.loop.begin(), ring.loop.end());
    std::sort(points.begin(), points.end());
    return points;
  }
  const auto first_outer = static_cast<std::int32_t>(all.points.size());
  all.points.insert(all.points.end(), wall.mesh.points.begin(), wall.mesh.points.end());
  for (geometry::Triangle t : wall.mesh.triangles) {
    for (std::int32_t& v : t) v += first_outer;
    all.triangles.push_back(t);
  }
  for (const WallRing& ring : wall.rings)
    for (std::size_t i = 0; i < ring.loop.size(); ++i) {
      const std::int32_t a = ring.loop[i], b = ring.loop[(i + 1) % ring.loop.size()];
      all.triangles.push_back({first_outer + b, first_outer + a, a});
      all.triangles.push_back({first_outer + b, a, b});
    }
  for (const auto& [s, t] : geometry::self_intersections(all))
    for (const std::int32_t f : {s, t})
      for (const std::int32_t v : all.triangles[static_cast<std::size_t>(f)])
        if (v < n || v >= first_outer) points.push_back(v < n ? v : v - first_outer);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

void thin(Columns& columns, const std::vector<std::int32_t>& points) {
  for (const std::int32_t v : points) {
    const auto i = static_cast<std::size_t>(v);
    columns.shares[i] *= thinning;
    // In the limit of no thickness each corner depends on its own direction alone.
    if (columns.shares[i] < most_visible_below) columns.directions[i] = most_visible(columns.cones[i]);
  }
  limit_shares(columns.wall, columns.wanted_mm, columns.options.gradation, columns.shares);
  const auto least = std::min_element(columns.shares.begin(), columns.shares.end());
  if (*least < least_share)
    throw GeometryError(
        "boundary layers cannot be made valid near " +
        place_text(columns.wall.point(static_cast<std::int32_t>(least - columns.shares.begin()))) +
        " at any thickness; smooth or remesh the surface there");
}

}  // namespace

Columns::Columns(const LayerWall& the_wall, std::vector<SightCone> sight, const BoundaryLayerOptions& o)
    : wall(the_wall),
      cones(std::move(sight)),
      options(o),
      heights(layer_heights(o.layers, o.growth)),
      visibility(visibilities(cones)),
      directions(march_directions(wall, cones)),
      shares(wall.mesh.points.size(), 1.0) {
  for (const double edge : wall.local_edge_mm) wanted_mm.push_back(options.thickness * edge);
}

Vec3 Columns::at(std::int32_t v, std::size_t layer) const {
  if (layer == 0) return wall.point(v);
  const auto i = static_cast<std::size_t>(v);
  return wall.mesh.points[i] + heights[layer] * (shares[i] * wanted_mm[i]) * directions[i];
}

PrismCorners Columns::prism(std::size_t triangle, std::size_t layer) const {
  const geometry::Triangle& t = wall.mesh.triangles[triangle];
  return {at(t[0], layer + 1), at(t[1], layer + 1), at(t[2], layer + 1),
          at(t[0], layer),     at(t[1], layer),     at(t[2], layer)};
}

double Columns::quality(std::size_t triangle) const {
  double least = 2.0;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const PrismCorners p = prism(triangle, k);
    const std::array<double, 9> coefficients = prism_jacobian_coefficients(p);
    if (!(*std::min_element(coefficients.begin(), coefficients.end()) > 0.0)) return -1.0;
    least = std::min(least, prism_scaled_jacobian(p));
  }
  return least;
}

double Columns::required(std::size_t triangle) const {
  double thin = 2.0;
  for (const std::int32_t v : wall.mesh.triangles[triangle])
    thin = std::min(thin, visibility[static_cast<std::size_t>(v)]);
  return std::min(options.min_scaled_jacobian, thin_limit_kept * thin);
}

double Columns::inner_angle_deg(std::size_t triangle) const {
  const geometry::Triangle& t = wall.mesh.triangles[triangle];
  const std::size_t last = heights.size() - 1;
  return min_angle_deg(at(t[0], last), at(t[1], last), at(t[2], last));
}

double Columns::required_angle_deg(std::size_t triangle) const {
  const geometry::Triangle& t = wall.mesh.triangles[triangle];
  return std::min(options.min_angle_deg,
                  thin_limit_kept * min_angle_deg(wall.point(t[0]), wall.point(t[1]), wall.point(t[2])));
}

geometry::FacedSurface Columns::inner() const {
  geometry::FacedSurface surface;
  const auto n = static_cast<std::int32_t>(wall.mesh.points.size());
  for (std::int32_t v = 0; v < n; ++v) surface.mesh.points.push_back(at(v, heights.size() - 1));
  surface.mesh.triangles = wall.mesh.triangles;
  surface.face_ids = wall.face_ids;
  for (const WallRing& ring : wall.rings) fill_cap(surface, ring.loop, 1.0, ring.cap);
  return surface;
}

int make_valid(Columns& columns, const core::TaskContext& task) {
  for (int round = 0; round < columns.options.max_rounds; ++round) {
    task.throw_if_cancelled();
    task.set_progress(1.0 - std::pow(0.95, round));
    const std::vector<std::int32_t> suspects = points_of(columns, local_faults(columns));
    if (!suspects.empty()) {
      for (const std::int32_t v : suspects) turn(columns, v);
      thin(columns, points_of(columns, local_faults(columns)));
      continue;
    }
    const std::vector<std::int32_t> crossing = global_faults(columns);
    if (crossing.empty()) return round;
    thin(columns, crossing);
  }
  throw GeometryError("boundary layers did not become valid in " +
                      std::to_string(columns.options.max_rounds) +
                      " rounds; take a smaller thickness, or remesh the surface");
}

}  // namespace ostia::meshing
