// Layers and tetrahedra as one mesh.
#include "boundary_layer_shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/boundary_layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

namespace ostia::meshing {
namespace {

/// How often each face is used, by its sorted points.
struct FaceUse {
  int prisms = 0, tetrahedra = 0, boundary = 0;
};
using Faces = std::map<std::vector<std::int32_t>, FaceUse>;

std::vector<std::int32_t> sorted(std::vector<std::int32_t> face) {
  std::sort(face.begin(), face.end());
  return face;
}

Faces faces_of(const geometry::MixedMesh& mesh) {
  Faces faces;
  for (const geometry::Prism& p : mesh.prisms)
    for (const auto& face :
         {sorted({p[0], p[1], p[2]}), sorted({p[3], p[4], p[5]}), sorted({p[0], p[1], p[4], p[3]}),
          sorted({p[1], p[2], p[5], p[4]}), sorted({p[2], p[0], p[3], p[5]})})
      ++faces[face].prisms;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra)
    for (const auto& face : {sorted({t[0], t[1], t[2]}), sorted({t[0], t[1], t[3]}),
                             sorted({t[0], t[2], t[3]}), sorted({t[1], t[2], t[3]})})
      ++faces[face].tetrahedra;
  for (const geometry::Triangle& t : mesh.triangles) ++faces[sorted({t[0], t[1], t[2]})].boundary;
  for (const geometry::Quad& q : mesh.quads) ++faces[sorted({q[0], q[1], q[2], q[3]})].boundary;
  return faces;
}

/// The boundary with each quadrilateral as two triangles.
geometry::TriMesh boundary_of(const geometry::MixedMesh& mesh) {
  geometry::TriMesh boundary{mesh.points, mesh.triangles};
  for (const geometry::Quad& q : mesh.quads) {
    boundary.triangles.push_back({q[0], q[1], q[2]});
    boundary.triangles.push_back({q[0], q[2], q[3]});
  }
  return boundary;
}

double volume_of(const geometry::MixedMesh& mesh) {
  double volume = 0.0;
  for (const geometry::Prism& prism : mesh.prisms) {
    PrismCorners p;
    for (std::size_t i = 0; i < 6; ++i) p[i] = mesh.points[static_cast<std::size_t>(prism[i])];
    volume += prism_volume(p);
  }
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    const auto at = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
    volume += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6.0;
  }
  return volume;
}

void expect_conforming(const geometry::FacedSurface& surface, const FilledWithLayers& filled) {
  const geometry::MixedMesh& mesh = filled.mesh;
  std::size_t between = 0, wrong = 0;
  for (const auto& [face, use] : faces_of(mesh)) {
    wrong += use.prisms + use.tetrahedra + use.boundary == 2 && use.boundary < 2 ? 0 : 1;
    between += use.prisms == 1 && use.tetrahedra == 1 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0u);
  std::size_t wall = 0;
  for (const std::int32_t id : surface.face_ids) wall += id == 1 ? 1 : 0;
  EXPECT_EQ(between, wall);  // every inner triangle lies between a prism and a tetrahedron
  const geometry::SurfaceFaults faults = geometry::find_faults(boundary_of(mesh), true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.self_intersections, 0u);
  const double whole = geometry::volume(surface.mesh);
  EXPECT_NEAR(volume_of(mesh), whole, 1e-9 * whole);
  EXPECT_NEAR(geometry::volume(boundary_of(mesh)), whole, 1e-9 * whole);
}

double area_of(const geometry::TriMesh& mesh, const std::vector<std::int32_t>& ids, std::int32_t id) {
  geometry::TriMesh part{mesh.points, {}};
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (ids[i] == id) part.triangles.push_back(mesh.triangles[i]);
  return geometry::area(part);
}

TEST(FillWithLayers, MakesOneConformingMeshOfAFork) {
  const geometry::FacedSurface surface = remeshed(geometry::y_junction(8.0, 8.0, 2.0, 1.5, 60.0), 0.35);
  BoundaryLayerOptions options;
  options.layers = 3;
  options.thickness = 1.0;
  const FilledWithLayers filled = fill_with_layers(surface, options);
  expect_conforming(surface, filled);
  EXPECT_GE(filled.layers.min_scaled_jacobian, 0.1);
  EXPECT_EQ(filled.tetrahedra.quality.inverted, 0u);
  EXPECT_GT(filled.tetrahedra.quality.min_dihedral_deg, 15.0);  // thick layers squeeze the inner triangles
  EXPECT_EQ(filled.tetrahedra.below_12_deg, 0u);
  EXPECT_TRUE(std::equal(filled.mesh.triangles.begin(), filled.mesh.triangles.begin() + 100,
                         surface.mesh.triangles.begin()));
  // Each face keeps its id and its area: the wall's triangles, the caps' triangles and quadrilaterals.
  std::vector<std::int32_t> ids = filled.mesh.triangle_face_ids;
  for (const std::int32_t id : filled.mesh.quad_face_ids) ids.insert(ids.end(), 2, id);
  ASSERT_EQ(filled.mesh.faces.size(), 4u);
  for (const geometry::Face& face : filled.mesh.faces) {
    const double area = area_of(surface.mesh, surface.face_ids, face.id);
    EXPECT_GT(area, 0.0);
    EXPECT_NEAR(area_of(boundary_of(filled.mesh), ids, face.id), area, 1e-9 * area) << face.name;
  }
}

TEST(FillWithLayers, MakesOneConformingMeshOfATightStenosis) {
  const geometry::FacedSurface surface = remeshed(geometry::stenosed_tube(20.0, 1.6, 0.85, 10.0, 5.0), 0.15);
  BoundaryLayerOptions options;
  options.layers = 5;
  options.thickness = 0.6;
  expect_conforming(surface, fill_with_layers(surface, options));
}

TEST(FillWithLayers, TellsTheWayOutWhereTheInsideCannotBeFilled) {
  const geometry::FacedSurface surface = structured_tube(12, 1.0, 0.5, 6);
  TetrahedralizeOptions inside;
  inside.mesher = Mesher::mesh3;
  EXPECT_THROW(fill_with_layers(surface, {}, inside), InvalidInput);
#if !defined(__SANITIZE_ADDRESS__)
  inside.mesher = Mesher::automatic;
  inside.limits.memory_bytes = 12ULL << 20;
  try {
    fill_with_layers(surface, {}, inside);
    FAIL() << "TetGen cannot have run";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("fewer or thinner layers"), std::string::npos) << error.what();
  }
#endif
}

}  // namespace
}  // namespace ostia::meshing
