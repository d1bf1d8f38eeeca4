#include "ostia/figure/cut_open.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
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

/// A face of a tetrahedron: its corners sorted, to be found again from the other side, and outward.
struct TetraFace {
  geometry::Triangle key, outward;
  bool kept = false;
};

std::vector<TetraFace> sorted_faces(const geometry::VolumeMesh& mesh, const std::vector<bool>& kept) {
  static constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  std::vector<TetraFace> faces;
  faces.reserve(4 * mesh.tetrahedra.size());
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    for (const auto& corners : kFaces) {
      TetraFace face;
      for (std::size_t k = 0; k < 3; ++k) face.outward[k] = mesh.tetrahedra[i][corners[k]];
      face.key = face.outward;
      std::sort(face.key.begin(), face.key.end());
      face.kept = kept[i];
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end(), [](const TetraFace& a, const TetraFace& b) {
    return a.key != b.key ? a.key < b.key : a.outward < b.outward;
  });
  return faces;
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

CutMesh cut_open(const geometry::VolumeMesh& mesh, const CutPlane& plane) {
  const Vec3 normal = unit_normal(plane);
  if (mesh.tetrahedra.empty()) throw InvalidInput("a mesh without tetrahedra cannot be cut open");
  std::vector<bool> kept(mesh.tetrahedra.size());
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    check_corners(mesh.tetrahedra[i].data(), 4, mesh.points.size(), "a tetrahedron");
    Vec3 centroid = Vec3::Zero();
    for (const std::int32_t corner : mesh.tetrahedra[i])
      centroid += 0.25 * mesh.points[static_cast<std::size_t>(corner)];
    kept[i] = (centroid - plane.point).dot(normal) <= 0.0;
  }
  const std::vector<TetraFace> faces = sorted_faces(mesh, kept);
  std::vector<geometry::Triangle> boundary;
  std::vector<geometry::Triangle> interior;
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t last = first + 1;
    while (last < faces.size() && faces[last].key == faces[first].key) ++last;
    if (last - first == 1) {
      if (faces[first].kept) boundary.push_back(faces[first].outward);
    } else if (faces[first].kept != faces[first + 1].kept) {
      interior.push_back((faces[first].kept ? faces[first] : faces[first + 1]).outward);
    }
    first = last;
  }
  return {compacted(mesh.points, std::move(boundary)), compacted(mesh.points, std::move(interior))};
}

std::vector<MeshActor> cut_actors(const geometry::VolumeMesh& mesh, const CutPlane& plane,
                                  const Color& boundary, const Color& interior) {
  CutMesh cut = cut_open(mesh, plane);
  std::vector<MeshActor> actors;
  const auto add = [&](geometry::TriMesh& part, const Color& color, const char* label) {
    if (part.triangles.empty()) return;
    MeshActor actor;
    actor.mesh = std::move(part);
    actor.color = color;
    actor.shading = Shading::flat;
    actor.edges = true;
    actor.label = label;
    actors.push_back(std::move(actor));
  };
  add(cut.boundary, boundary, "boundary");
  add(cut.interior, interior, "cut");
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
