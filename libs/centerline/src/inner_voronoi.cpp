#include "ostia/centerline/inner_voronoi.h"

#include "ostia/centerline/delaunay.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/parallel_invoke.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

enum class Side : std::uint8_t { outside, inside, doubtful, flat };

// Beyond this cosine between a corner's normal and the direction to the circumcentre its vote is clear.
constexpr double clear_cosine = 0.25;
// Six volumes over the longest edge cubed: below this the circumcentre has fewer than about five digits left.
constexpr double flat_limit = 1e-9;

struct Sphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

struct Sites {
  std::vector<std::size_t> numbers;  // of their points in the surface
  std::vector<Vec3> points, normals;
  std::vector<bool> on_border;
};

// Their normals come later: the tetrahedra do not need them.
Sites collect_sites(const geometry::TriMesh& capped, const std::vector<bool>& on_border,
                    const std::vector<bool>& skip) {
  std::vector<bool> used(capped.points.size(), false);
  for (const geometry::Triangle& t : capped.triangles)
    for (std::int32_t v : t) used[static_cast<std::size_t>(v)] = true;
  Sites sites;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i] || (!skip.empty() && skip[i])) continue;
    sites.numbers.push_back(i);
    sites.points.push_back(capped.points[i]);
    sites.on_border.push_back(!on_border.empty() && on_border[i]);
  }
  return sites;
}

void add_normals(const geometry::TriMesh& capped, Sites& sites) {
  const std::vector<Vec3> normals = geometry::vertex_normals(capped);
  sites.normals.reserve(sites.numbers.size());
  for (const std::size_t i : sites.numbers) sites.normals.push_back(normals[i]);
}

// False where the cell is too flat for its circumcentre.
bool circumsphere(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, Sphere& sphere) {
  const Vec3 a = p1 - p0, b = p2 - p0, c = p3 - p0;
  const double longest2 =
      std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm(), (p2 - p1).squaredNorm(),
                (p3 - p1).squaredNorm(), (p3 - p2).squaredNorm()});
  const Vec3 bc = b.cross(c);
  const double volume6 = a.dot(bc);
  if (!(std::abs(volume6) > flat_limit * longest2 * std::sqrt(longest2))) return false;
  const Vec3 to_centre =
      (a.squaredNorm() * bc + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) / (2.0 * volume6);
  sphere.centre = p0 + to_centre;
  sphere.radius = to_centre.norm();
  return std::isfinite(sphere.radius);
}

Side vote(const Sites& sites, const std::array<std::int32_t, 4>& cell, const Sphere& sphere) {
  int inside = 0, outside = 0;
  for (std::int32_t corner : cell) {
    const auto v = static_cast<std::size_t>(corner);
    if (sites.on_border[v]) return Side::doubtful;
    const double cosine = (sphere.centre - sites.points[v]).dot(sites.normals[v]) / sphere.radius;
    inside += cosine < -clear_cosine;
    outside += cosine > clear_cosine;
  }
  if (inside == 4) return Side::inside;
  return outside == 4 ? Side::outside : Side::doubtful;
}

struct Classified {
  std::vector<Sphere> spheres;
  std::vector<Side> sides;
  std::size_t doubtful = 0;
};

Classified classify(const Sites& sites, const Delaunay& cells, const geometry::TriMesh& capped,
                    const geometry::AabbTree& tree, const core::TaskContext& task) {
  const std::size_t count = cells.cells.size();
  Classified result{std::vector<Sphere>(count), std::vector<Side>(count, Side::flat), 0};
  core::parallel_for(count, 8192, [&](std::size_t i) {
    const auto& cell = cells.cells[i];
    const auto at = [&](std::size_t k) -> const Vec3& {
      return sites.points[static_cast<std::size_t>(cell[k])];
    };
    if (circumsphere(at(0), at(1), at(2), at(3), result.spheres[i]))
      result.sides[i] = vote(sites, cell, result.spheres[i]);
  });
  std::vector<std::size_t> doubtful;
  for (std::size_t i = 0; i < count; ++i)
    if (result.sides[i] == Side::doubtful) doubtful.push_back(i);
  result.doubtful = doubtful.size();
  if (doubtful.empty()) return result;
  task.throw_if_cancelled();
  const geometry::Box3 box = geometry::bounds(capped.points);
  core::parallel_chunks(doubtful.size(), 512, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = doubtful[k];
      const Vec3& centre = result.spheres[i].centre;
      result.sides[i] = box.contains(centre) && tree.inside(centre) ? Side::inside : Side::outside;
    }
  });
  return result;
}

// The sphere about `centre` through the cell's corners, if they lie on one.
bool sphere_about(const Vec3& centre, const Sites& sites, const std::array<std::int32_t, 4>& cell,
                  Sphere& sphere) {
  constexpr double tolerance = 1e-4;  // of the radius
  double nearest = 0.0, farthest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double distance = (sites.points[static_cast<std::size_t>(cell[k])] - centre).norm();
    nearest = k == 0 ? distance : std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  sphere = {centre, nearest};
  return farthest - nearest <= tolerance * farthest;
}

// A flat cell whose corners lie on a circle may take any centre on the circle's axis between those of its
// neighbours: it takes that of the inner neighbour with the largest sphere. Neighbours may be flat
// themselves, hence the rounds.
void settle_flat_cells(const Sites& sites, const Delaunay& cells, Classified& classified) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < classified.sides.size(); ++i)
    if (classified.sides[i] == Side::flat) open.push_back(i);
  while (!open.empty()) {
    std::vector<std::size_t> still_open;
    std::vector<std::pair<std::size_t, Sphere>> settled;
    for (std::size_t i : open) {
      Sphere best;
      for (std::int32_t n : cells.neighbours[i]) {
        if (n < 0 || classified.sides[static_cast<std::size_t>(n)] != Side::inside) continue;
        const Vec3& centre = classified.spheres[static_cast<std::size_t>(n)].centre;
        Sphere sphere;
        if (sphere_about(centre, sites, cells.cells[i], sphere) && sphere.radius > best.radius) best = sphere;
      }
      if (best.radius > 0.0)
        settled.emplace_back(i, best);
      else
        still_open.push_back(i);
    }
    for (const auto& [cell, sphere] : settled) {
      classified.spheres[cell] = sphere;
      classified.sides[cell] = Side::inside;
    }
    if (settled.empty()) break;
    open.swap(still_open);
  }
  for (std::size_t i : open) classified.sides[i] = Side::outside;
}

std::size_t corner_of(const std::array<std::int32_t, 4>& cell, std::int32_t vertex) {
  std::size_t i = 0;
  while (cell[i] != vertex) ++i;
  return i;
}

// The cells around the edge of corners i and j of `start`, in order, when all are inside and `start` is the
// lowest of them.
bool ring_around(const Delaunay& cells, const std::vector<std::int32_t>& inner, std::size_t start,
                 std::size_t i, std::size_t j, std::vector<std::int32_t>& ring) {
  ring.clear();
  const std::int32_t a = cells.cells[start][i], b = cells.cells[start][j];
  std::size_t leave = 0;
  while (leave == i || leave == j) ++leave;
  std::size_t current = start;
  do {
    ring.push_back(inner[current]);
    const std::size_t stay =
        6 - leave - corner_of(cells.cells[current], a) - corner_of(cells.cells[current], b);
    const std::int32_t pivot = cells.cells[current][stay];
    const std::int32_t next = cells.neighbours[current][leave];
    if (next < static_cast<std::int32_t>(start) || inner[static_cast<std::size_t>(next)] < 0) return false;
    current = static_cast<std::size_t>(next);
    leave = corner_of(cells.cells[current], pivot);
  } while (current != start);
  return true;
}

void add_polygons(const Delaunay& cells, const std::vector<std::int32_t>& inner, InnerVoronoi& diagram,
                  const core::TaskContext& task) {
  struct Part {
    std::vector<std::int32_t> sizes, corners;
  };
  constexpr std::size_t grain = 16384;
  std::vector<Part> parts((cells.cells.size() + grain - 1) / grain);
  core::parallel_chunks(cells.cells.size(), grain, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    Part& part = parts[first / grain];
    std::vector<std::int32_t> ring;
    for (std::size_t cell = first; cell < last; ++cell) {
      if (inner[cell] < 0) continue;
      std::array<bool, 4> on{};  // whether a ring that begins here may go on through the face
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t next = cells.neighbours[cell][k];
        on[k] = next > static_cast<std::int32_t>(cell) && inner[static_cast<std::size_t>(next)] >= 0;
      }
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) {
          const std::size_t k = i > 0 ? 0 : j > 1 ? 1 : 2, l = 6 - i - j - k;
          if (!on[k] || !on[l]) continue;
          if (!ring_around(cells, inner, cell, i, j, ring)) continue;
          part.sizes.push_back(static_cast<std::int32_t>(ring.size()));
          part.corners.insert(part.corners.end(), ring.begin(), ring.end());
        }
    }
  });
  diagram.polygon_first.push_back(0);
  for (const Part& part : parts) {
    for (std::int32_t size : part.sizes) diagram.polygon_first.push_back(diagram.polygon_first.back() + size);
    diagram.corners.insert(diagram.corners.end(), part.corners.begin(), part.corners.end());
  }
}

void add_incidence(InnerVoronoi& diagram) {
  diagram.incidence_first.assign(diagram.points.size() + 1, 0);
  for (std::int32_t corner : diagram.corners) ++diagram.incidence_first[static_cast<std::size_t>(corner) + 1];
  for (std::size_t i = 1; i < diagram.incidence_first.size(); ++i)
    diagram.incidence_first[i] += diagram.incidence_first[i - 1];
  diagram.incidence.resize(diagram.corners.size());
  std::vector<std::int32_t> next(diagram.incidence_first.begin(), diagram.incidence_first.end() - 1);
  for (std::size_t p = 0; p < diagram.polygon_count(); ++p)
    for (std::int32_t k = diagram.polygon_first[p]; k < diagram.polygon_first[p + 1]; ++k) {
      std::int32_t& slot = next[static_cast<std::size_t>(diagram.corners[static_cast<std::size_t>(k)])];
      diagram.incidence[static_cast<std::size_t>(slot++)] = static_cast<std::int32_t>(p);
    }
}

Delaunay tetrahedra_of(const std::vector<Vec3>& points, const KnownSurface* known,
                       const core::TaskContext& task) {
  if (known != nullptr && known->tetrahedra)
    if (std::optional<Delaunay> ahead = known->tetrahedra->take(points, task)) return std::move(*ahead);
  return delaunay(points, task);
}

std::shared_ptr<const geometry::AabbTree> tree_of(const geometry::TriMesh& capped,
                                                  const KnownSurface* known) {
  const bool the_same = known != nullptr && known->tree && known->closed.triangles == capped.triangles &&
                        known->closed.points == capped.points;
  return the_same ? known->tree : std::make_shared<const geometry::AabbTree>(capped);
}

}  // namespace

InnerVoronoi inner_voronoi(const geometry::TriMesh& capped, const std::vector<bool>& on_border,
                           const std::vector<bool>& skip, const core::TaskContext& task,
                           const KnownSurface* known) {
  Sites sites = collect_sites(capped, on_border, skip);
  if (sites.points.empty()) throw GeometryError("the surface has no points: it encloses no lumen");
  Delaunay cells;
  std::shared_ptr<const geometry::AabbTree> tree;
  // What waits for tetrahedra that were begun elsewhere comes last, where no thread is free for both.
  core::parallel_invoke(
      [&] {
        core::parallel_invoke(
            [&] {
              tree = tree_of(capped, known);
              tree->inside(sites.points.front());  // what such questions need is made at the first
            },
            [&] { add_normals(capped, sites); });
      },
      [&] { cells = tetrahedra_of(sites.points, known, task.sub(0.0, 0.6)); });
  Classified classified = classify(sites, cells, capped, *tree, task);
  settle_flat_cells(sites, cells, classified);
  task.set_progress(0.8);
  task.throw_if_cancelled();

  InnerVoronoi diagram;
  diagram.delaunay_cells = cells.cells.size();
  diagram.doubtful_cells = classified.doubtful;
  diagram.dropped_points = cells.dropped_points;
  std::vector<std::int32_t> inner(cells.cells.size(), -1);
  const auto count = static_cast<std::size_t>(std::ranges::count(classified.sides, Side::inside));
  diagram.points.reserve(count);
  diagram.radius.reserve(count);
  diagram.links.reserve(count);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (classified.sides[i] != Side::inside) continue;
    inner[i] = static_cast<std::int32_t>(diagram.points.size());
    diagram.points.push_back(classified.spheres[i].centre);
    diagram.radius.push_back(classified.spheres[i].radius);
  }
  if (diagram.points.empty())
    throw GeometryError("no part of the Voronoi diagram lies inside the surface: it encloses no lumen");
  task.throw_if_cancelled();
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (inner[i] < 0) continue;
    std::array<std::int32_t, 4> links{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t n = cells.neighbours[i][k];
      links[k] = n < 0 ? -1 : inner[static_cast<std::size_t>(n)];
    }
    diagram.links.push_back(links);
  }
  add_polygons(cells, inner, diagram, task);
  task.throw_if_cancelled();
  add_incidence(diagram);
  task.set_progress(1.0);
  return diagram;
}

}  // namespace ostia::centerline
