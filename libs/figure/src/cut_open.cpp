#include "ostia/figure/cut_open.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mixed_mesh_sides.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace ostia::figure {
namespace {

Vec3 unit_normal(const CutPlane& plane) {
  if (!plane.point.allFinite() || !plane.normal.allFinite() || !(plane.normal.norm() > 0.0)) {
    throw InvalidInput("a cutting plane needs a finite point and a normal that is not zero");
  }
  return plane.normal.normalized();
}

void check_corners(const std::int32_t* corners, std::size_t count, std::size_t points, const char* what) {
  for (std::size_t k = 0; k < count; ++k) {
    if (corners[k] < 0 || static_cast<std::size_t>(corners[k]) >= points) {
      throw InvalidInput(std::string(what) + " names point " + std::to_string(corners[k]) + " of " +
                         std::to_string(points));
    }
  }
}

/// Which elements lie behind the plane; tetrahedra first, then prisms.
template <class Element>
void add_kept(const std::vector<Element>& elements, const std::vector<Vec3>& points, const CutPlane& plane,
              const Vec3& normal, const char* what, std::vector<bool>& kept) {
  for (const Element& element : elements) {
    check_corners(element.data(), element.size(), points.size(), what);
    Vec3 centroid = Vec3::Zero();
    for (const std::int32_t corner : element)
      centroid += points[static_cast<std::size_t>(corner)] / static_cast<double>(element.size());
    kept.push_back((centroid - plane.point).dot(normal) <= 0.0);
  }
}

void add_side(const geometry::MeshSide& side, CutPart& part) {
  const auto& p = side.outward;
  part.mesh.triangles.push_back({p[0], p[1], p[2]});
  if (!side.triangle()) part.mesh.triangles.push_back({p[2], p[3], p[0]});
  part.half_of_quad.resize(part.mesh.triangles.size(), !side.triangle());
}

/// The triangles with only the points that they use.
geometry::TriMesh compacted(const std::vector<Vec3>& points, std::vector<geometry::Triangle> triangles) {
  geometry::TriMesh result;
  std::vector<std::int32_t> new_index(points.size(), -1);
  for (geometry::Triangle& triangle : triangles) {
    for (std::int32_t& corner : triangle) {
      std::int32_t& index = new_index[static_cast<std::size_t>(corner)];
      if (index < 0) {
        index = static_cast<std::int32_t>(result.points.size());
        result.points.push_back(points[static_cast<std::size_t>(corner)]);
      }
      corner = index;
    }
  }
  result.triangles = std::move(triangles);
  return result;
}

}  // namespace

CutMesh cut_open(const geometry::MixedMesh& mesh, const CutPlane& plane) {
  const Vec3 normal = unit_normal(plane);
  if (mesh.tetrahedra.empty() && mesh.prisms.empty())
    throw InvalidInput("a mesh without elements cannot be cut open");
  std::vector<bool> kept;
  add_kept(mesh.tetrahedra, mesh.points, plane, normal, "a tetrahedron", kept);
  add_kept(mesh.prisms, mesh.points, plane, normal, "a prism", kept);
  const auto is_kept = [&](const geometry::MeshSide& side) {
    return kept[static_cast<std::size_t>(side.element)];
  };
  const auto tetrahedra = static_cast<std::int32_t>(mesh.tetrahedra.size());
  const std::vector<geometry::MeshSide> sides = geometry::sorted_sides(mesh);
  CutMesh cut;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].key == sides[first].key) ++last;
    if (last - first == 1) {
      if (is_kept(sides[first])) add_side(sides[first], cut.boundary);
    } else if (is_kept(sides[first]) != is_kept(sides[first + 1])) {
      const geometry::MeshSide& open = is_kept(sides[first]) ? sides[first] : sides[first + 1];
      add_side(open, open.element < tetrahedra ? cut.interior : cut.layers);
    }
  }
  for (CutPart* part : {&cut.boundary, &cut.interior, &cut.layers})
    part->mesh = compacted(mesh.points, std::move(part->mesh.triangles));
  return cut;
}

std::vector<MeshActor> cut_actors(const geometry::MixedMesh& mesh, const CutPlane& plane,
                                  const Color& boundary, const Color& interior, const Color& layers) {
  CutMesh cut = cut_open(mesh, plane);
  std::vector<MeshActor> actors;
  const auto add = [&](CutPart& part, const Color& color, const char* label) {
    if (part.mesh.triangles.empty()) return;
    MeshActor actor;
    actor.mesh = std::move(part.mesh);
    actor.half_of_quad = std::move(part.half_of_quad);
    actor.color = color;
    actor.shading = Shading::flat;
    actor.edges = true;
    actor.label = label;
    actors.push_back(std::move(actor));
  };
  add(cut.boundary, boundary, "boundary");
  add(cut.interior, interior, mesh.prisms.empty() ? "cut" : "tetrahedra");
  add(cut.layers, layers, "layers of prisms");
  return actors;
}

geometry::TriMesh clipped(const geometry::TriMesh& surface, const CutPlane& plane) {
  const Vec3 normal = unit_normal(plane);
  geometry::TriMesh result;
  result.points = surface.points;
  std::vector<double> height;
  for (const Vec3& p : surface.points) height.push_back((p - plane.point).dot(normal));
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> crossings;
  const auto crossing = [&](std::int32_t a, std::int32_t b) {
    const auto key = std::minmax(a, b);
    const auto [it, fresh] =
        crossings.try_emplace({key.first, key.second}, static_cast<std::int32_t>(result.points.size()));
    if (fresh) {
      const auto i = static_cast<std::size_t>(key.first);
      const auto j = static_cast<std::size_t>(key.second);
      const double t = height[i] / (height[i] - height[j]);
      result.points.push_back(surface.points[i] + t * (surface.points[j] - surface.points[i]));
    }
    return it->second;
  };
  std::vector<geometry::Triangle> triangles;
  for (const geometry::Triangle& triangle : surface.triangles) {
    check_corners(triangle.data(), 3, surface.points.size(), "a triangle");
    std::vector<std::int32_t> kept;  // the triangle's part behind the plane: none, three or four corners
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = triangle[k];
      const std::int32_t b = triangle[(k + 1) % 3];
      const bool a_kept = height[static_cast<std::size_t>(a)] <= 0.0;
      const bool b_kept = height[static_cast<std::size_t>(b)] <= 0.0;
      if (a_kept) kept.push_back(a);
      if (a_kept != b_kept) kept.push_back(crossing(a, b));
    }
    for (std::size_t k = 2; k < kept.size(); ++k) triangles.push_back({kept[0], kept[k - 1], kept[k]});
  }
  return compacted(result.points, std::move(triangles));
}

}  // namespace ostia::figure
