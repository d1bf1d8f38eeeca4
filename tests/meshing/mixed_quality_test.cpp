// Measures of meshes against known elements, against a fine reference, and against OpenFOAM's checkMesh.
#include "ostia/meshing/mixed_quality.h"

#include "../io/mesh_export_meshes.h"
#include "mixed_shapes.h"
#include "openfoam_case.h"
#include "shared_data.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/io/mesh_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numeric>

namespace ostia::meshing {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

constexpr double degrees = 180.0 / std::numbers::pi;

/// A regular tetrahedron of edge 2, its boundary one face.
MixedMesh one_tetrahedron() {
  geometry::TriMesh surface = tetrahedron_surface(2.0);
  geometry::Tetrahedron t{0, 1, 2, 3};
  const auto& p = surface.points;
  if ((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) < 0.0) std::swap(t[0], t[1]);
  MixedMesh mesh;
  mesh.points = surface.points;
  mesh.tetrahedra = {t};
  mesh.triangles = surface.triangles;
  mesh.triangle_face_ids.assign(4, 1);
  mesh.faces = {{1, "wall", geometry::FaceKind::wall}};
  return mesh;
}

/// A right prism of height 0.5 on an equilateral triangle of edge 1.
MixedMesh one_prism() {
  MixedMesh mesh;
  for (const double z : {0.0, 0.5})
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, std::sqrt(0.75), 0)})
      mesh.points.emplace_back(p.x(), p.y(), z);
  mesh.prisms = {{0, 1, 2, 3, 4, 5}};
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}};
  mesh.triangle_face_ids = {2, 3};
  mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  mesh.quad_face_ids = {1, 1, 1};
  mesh.faces = {{1, "wall", geometry::FaceKind::wall},
                {2, "inlet_a", geometry::FaceKind::inlet},
                {3, "outlet_a", geometry::FaceKind::outlet}};
  return mesh;
}

TEST(MixedQuality, OfARegularTetrahedron) {
  const MixedQuality q = mixed_quality(one_tetrahedron());
  EXPECT_EQ(q.tetrahedra.count, 1u);
  EXPECT_EQ(q.prisms.count, 0u);
  EXPECT_EQ(q.inverted(), 0u);
  EXPECT_NEAR(q.tetrahedra.min_scaled_jacobian, 1.0, 1e-12);
  EXPECT_NEAR(q.tetrahedra.min_dihedral_deg, std::acos(1.0 / 3.0) * degrees, 1e-10);
  EXPECT_EQ(q.tetrahedra.min_dihedral_histogram[14], 1u);  // 70.5 degrees
  EXPECT_NEAR(q.radius_edge.max, std::sqrt(0.375), 1e-12);
  EXPECT_EQ(q.radius_edge.histogram[0], 1u);
  EXPECT_NEAR(q.volume_mm3(), 8.0 / (6.0 * std::sqrt(2.0)), 1e-12);
  EXPECT_NEAR(q.mean_edge_mm, 2.0, 1e-12);
  EXPECT_EQ(q.boundary_mismatches, 0u);
  ASSERT_EQ(q.faces.size(), 1u);
  EXPECT_NEAR(q.faces[0].area_mm2, 4.0 * std::sqrt(3.0), 1e-12);
  EXPECT_LE(q.faces[0].mean_normal.norm(), 1e-12);  // a closed surface has none
  EXPECT_TRUE(check(q).ok()) << check(q).summary();
}

TEST(MixedQuality, OfARightPrism) {
  const MixedQuality q = mixed_quality(one_prism());
  EXPECT_EQ(q.prisms.count, 1u);
  EXPECT_NEAR(q.prisms.min_scaled_jacobian, 1.0, 1e-12);
  EXPECT_NEAR(q.prisms.min_dihedral_deg, 60.0, 1e-10);
  EXPECT_NEAR(q.prisms.max_dihedral_deg, 90.0, 1e-10);
  EXPECT_NEAR(q.volume_mm3(), 0.5 * std::sqrt(0.75) / 2.0, 1e-14);
  EXPECT_EQ(q.boundary_mismatches, 0u);
  EXPECT_NEAR(q.faces[0].area_mm2, 1.5, 1e-12);
  EXPECT_NEAR(q.faces[1].area_mm2, std::sqrt(0.75) / 2.0, 1e-12);
  EXPECT_LE((q.faces[1].mean_normal + Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LE((q.faces[2].centre - Vec3(0.5, std::sqrt(0.75) / 3.0, 0.5)).norm(), 1e-12);
  EXPECT_EQ(q.faces[0].quads, 3u);
}

TEST(MixedQuality, MeasuresTheFacesAndTheVolumeOfAColumn) {
  for (const bool second : {false, true}) {
    const MixedMesh mesh = second ? io::quadratic(io::column_with_prisms()) : io::column_with_prisms();
    const io::MeshMeasure truth = io::measure(mesh);
    const MixedQuality q = mixed_quality(mesh);
    EXPECT_EQ(q.quadratic, second);
    EXPECT_NEAR(q.volume_mm3(), truth.volume, 1e-10 * truth.volume);
    EXPECT_EQ(q.boundary_mismatches, 0u);
    ASSERT_EQ(q.faces.size(), truth.faces.size());
    for (const FaceQuality& face : q.faces) {
      const io::FaceMeasure& expected = truth.faces.at(face.name);
      EXPECT_EQ(face.id, expected.id);
      EXPECT_EQ(face.triangles, expected.triangles);
      EXPECT_EQ(face.quads, expected.quads);
      EXPECT_NEAR(face.area_mm2, expected.area, 1e-10 * expected.area);
      EXPECT_LE((face.mean_normal * face.area_mm2 - expected.vector_area).norm(), 1e-10 * expected.area);
    }
  }
  const MixedQuality straight = mixed_quality(io::column_with_prisms());
  const double hexagon = 1.5 * std::sqrt(3.0) * 9.0;
  EXPECT_NEAR(straight.volume_mm3(), 8.0 * hexagon, 1e-10);
  EXPECT_NEAR(straight.faces[1].area_mm2, hexagon, 1e-10);
  EXPECT_LE((straight.faces[1].mean_normal + Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LE((straight.faces[2].centre - Vec3(0, 0, 8)).norm(), 1e-10);
}

TEST(MixedQuality, FindsInvertedElements) {
  MixedMesh turned = io::column_with_prisms();
  std::swap(turned.tetrahedra[3][0], turned.tetrahedra[3][1]);
  turned.prisms[5] = {turned.prisms[5][3], turned.prisms[5][4], turned.prisms[5][5],
                      turned.prisms[5][0], turned.prisms[5][1], turned.prisms[5][2]};
  const MixedQuality q = mixed_quality(turned);
  EXPECT_EQ(q.tetrahedra.inverted, 1u);
  EXPECT_EQ(q.prisms.inverted, 1u);
  EXPECT_LT(q.tetrahedra.min_scaled_jacobian, 0.0);
  const QualityVerdict verdict = check(q);
  EXPECT_THAT(verdict.summary(), ::testing::HasSubstr("1 inverted tetrahedra"));
  EXPECT_THAT(verdict.summary(), ::testing::HasSubstr("1 inverted prisms"));
}

TEST(MixedQuality, FindsWhereTheBoundaryIsNotTheElements) {
  const MixedMesh whole = io::quadratic(io::column_with_prisms());
  const auto mismatches = [](const MixedMesh& mesh) { return mixed_quality(mesh).boundary_mismatches; };
  EXPECT_EQ(mismatches(whole), 0u);
  MixedMesh missing = whole;
  missing.triangles.pop_back();
  missing.triangle_face_ids.pop_back();
  missing.triangle_nodes.pop_back();
  EXPECT_EQ(mismatches(missing), 1u);
  MixedMesh turned = whole;
  std::swap(turned.quads[2][1], turned.quads[2][3]);
  std::swap(turned.quad_nodes[2][0], turned.quad_nodes[2][3]);
  std::swap(turned.quad_nodes[2][1], turned.quad_nodes[2][2]);
  EXPECT_EQ(mismatches(turned), 1u);
  MixedMesh twice = whole;
  twice.triangles.push_back(whole.triangles[0]);
  twice.triangle_face_ids.push_back(1);
  twice.triangle_nodes.push_back(whole.triangle_nodes[0]);
  EXPECT_EQ(mismatches(twice), 1u);
  MixedMesh other_node = whole;
  other_node.triangle_nodes[4][1] = whole.triangle_nodes[0][0];
  EXPECT_EQ(mismatches(other_node), 1u);
  MixedMesh other_middle = whole;
  other_middle.quad_nodes[1][4] = whole.quad_nodes[0][4];
  EXPECT_EQ(mismatches(other_middle), 1u);
  MixedMesh unnamed = whole;
  unnamed.triangle_face_ids[0] = 99;
  EXPECT_EQ(mixed_quality(unnamed).unnamed_facets, 1u);
  EXPECT_THAT(check(mixed_quality(unnamed)).summary(), ::testing::HasSubstr("whose id no face has"));
  EXPECT_THAT(check(mixed_quality(missing)).summary(), ::testing::HasSubstr("do not match, one near ("));
}

TEST(MixedQuality, TheGateNamesEachBoundAndItsPlace) {
  const MixedQuality q = mixed_quality(filled_tube(16, 3, 0.5));
  EXPECT_TRUE(check(q).ok()) << check(q).summary();
  MixedBounds bounds;
  bounds.min_dihedral_deg = 60.0;
  bounds.min_tetrahedron_scaled_jacobian = 0.99;
  bounds.min_prism_scaled_jacobian = 0.99;
  bounds.max_non_orthogonality_deg = 1.0;
  bounds.max_skewness = 0.01;
  bounds.max_aspect_ratio = 1.0;
  bounds.min_volume_ratio = 0.99;
  const QualityVerdict verdict = check(q, bounds);
  EXPECT_EQ(verdict.reasons.size(), 7u) << verdict.summary();
  for (const char* part : {"dihedral angle", "Jacobian of the tetrahedra", "Jacobian of the prisms",
                           "non-orthogonality", "skewness", "aspect ratio", "volumes of neighbouring cells"})
    EXPECT_THAT(verdict.summary(), ::testing::HasSubstr(part));
  EXPECT_THAT(verdict.reasons[3], ::testing::HasSubstr("is above 1, near ("));
  bounds.max_skewness = 0.0;
  EXPECT_THROW(check(q, bounds), InvalidInput);
  MixedMesh empty_face = one_prism();
  empty_face.faces.push_back({9, "outlet_b", geometry::FaceKind::outlet});
  EXPECT_THAT(check(mixed_quality(empty_face)).summary(), ::testing::HasSubstr("face outlet_b has no facet"));
  EXPECT_EQ(check(mixed_quality(MixedMesh{})).summary(), "no elements");
}

TEST(MixedQuality, DeviationOfATubeFromAWiderOne) {
  const MixedMesh mesh = filled_tube(24, 0, 0.0);
  const geometry::TriMesh wider = cylinder_reference(1.6, 3.0, 4000);
  const WallDeviation d = wall_deviation(mesh, wider);
  // Points lie 0.1 mm inside, triangle centres besides by up to what the chord cuts off.
  const double apothem = 1.5 * std::cos(std::numbers::pi / 24.0);
  EXPECT_GE(d.mean_mm, 0.1 - 1e-6);
  EXPECT_GT(d.max_mm, 0.1 + 0.5 * (1.5 - apothem));
  EXPECT_LE(d.max_mm, 1.6 - apothem);
  EXPECT_GE(d.max_mm, d.p95_mm);
  EXPECT_GE(d.p95_mm, d.mean_mm);
  EXPECT_NEAR(d.max_mm, 1.6 - std::hypot(d.worst_at.x(), d.worst_at.y()), 1e-5);
  std::size_t wall = 0;
  for (const std::int32_t id : mesh.triangle_face_ids) wall += id == 1 ? 1 : 0;
  EXPECT_EQ(d.samples, wall + wall / 2 + 24);  // centres; points of an open tube, by Euler's formula
  EXPECT_THROW(wall_deviation(mesh, geometry::TriMesh{}), InvalidInput);
}

TEST(MixedQuality, IsTheSameForAnyNumberOfThreads) {
  const MixedMesh mesh = filled_tube(24, 2, 0.25);
  std::vector<MixedQuality> all;
  for (const int threads : {1, 2, 5}) {
    core::set_max_threads(threads);
    all.push_back(mixed_quality(mesh));
  }
  core::set_max_threads(0);
  for (const MixedQuality& q : all) {
    EXPECT_EQ(q.volume_mm3(), all[0].volume_mm3());
    EXPECT_EQ(q.tetrahedra.mean_scaled_jacobian, all[0].tetrahedra.mean_scaled_jacobian);
    EXPECT_EQ(q.tetrahedra.min_dihedral_histogram, all[0].tetrahedra.min_dihedral_histogram);
    EXPECT_EQ(q.openfoam.mean_non_orthogonality_deg, all[0].openfoam.mean_non_orthogonality_deg);
    EXPECT_EQ(q.openfoam.most_skewed_at, all[0].openfoam.most_skewed_at);
    EXPECT_EQ(q.prisms.worst_at, all[0].prisms.worst_at);
  }
  const std::vector<double> each = element_scaled_jacobians(mesh);
  ASSERT_EQ(each.size(), mesh.tetrahedra.size() + mesh.prisms.size());
  const auto prisms = each.begin() + static_cast<std::ptrdiff_t>(mesh.tetrahedra.size());
  EXPECT_EQ(*std::min_element(each.begin(), prisms), all[0].tetrahedra.min_scaled_jacobian);
  EXPECT_EQ(*std::min_element(prisms, each.end()), all[0].prisms.min_scaled_jacobian);
}

TEST(MixedQuality, RefusesWhatCannotBeMeasured) {
  MixedMesh mesh = one_prism();
  mesh.prisms[0][2] = 6;
  EXPECT_THROW(mixed_quality(mesh), InvalidInput);
  mesh = one_prism();
  mesh.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(mixed_quality(mesh), InvalidInput);
  mesh = one_prism();
  mesh.quad_face_ids.pop_back();
  EXPECT_THROW(mixed_quality(mesh), InvalidInput);
  mesh = io::quadratic(one_prism());
  mesh.triangle_nodes.pop_back();
  EXPECT_THROW(mixed_quality(mesh), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(mixed_quality(io::column_with_prisms(), task), Cancelled);
}

/// What `checkMesh` prints of a mesh.
std::string check_mesh_output(const MixedMesh& mesh, const std::string& options) {
  const std::filesystem::path folder = testing::temporary_folder("check") / "case";
  io::export_mesh(mesh, io::MeshFormat::openfoam, folder);
  testing::add_control(folder);
  const std::filesystem::path log = folder / "log";
  core::run_child("/bin/sh", {"-c", "WM_PROJECT_DIR=/usr/share/openfoam checkMesh " + options + " -case '" +
                                        folder.string() + "' > '" + log.string() + "' 2>&1"});
  return core::read_file(log);
}

/// The number behind a text.
double printed(const std::string& output, const std::string& before) {
  const std::size_t at = output.find(before);
  if (at == std::string::npos) {
    ADD_FAILURE() << "no '" << before << "' in\n" << output;
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::strtod(output.c_str() + at + before.size(), nullptr);
}

TEST(MixedQualityReaders, MeasuresAreCheckMeshs) {
  if (!core::run_child("/bin/sh", {"-c", "command -v checkMesh > /dev/null"}).ok())
    GTEST_SKIP() << "openfoam is not installed";
  const std::vector<std::pair<std::string, MixedMesh>> cases{
      {"column", io::column_with_prisms()},
      {"tetrahedra", filled_tube(12, 0, 0.0)},
      {"layers", filled_tube(14, 3, 0.6)},
      {"fork", fill_with_layers(remeshed(geometry::y_junction(8.0, 8.0, 2.0, 1.5, 60.0), 0.35)).mesh}};
  for (const auto& [name, mesh] : cases) {
    SCOPED_TRACE(name);
    const std::string output = check_mesh_output(mesh, "-allGeometry");
    const OpenFoamQuality q = mixed_quality(mesh).openfoam;
    const auto expect_printed = [&](const char* before, double value) {
      EXPECT_NEAR(printed(output, before), value, 5.1e-6 * std::abs(value)) << before;  // six digits
    };
    expect_printed("Mesh non-orthogonality Max: ", q.max_non_orthogonality_deg);
    expect_printed(" average: ", q.mean_non_orthogonality_deg);
    expect_printed("Max skewness = ", q.max_skewness);
    expect_printed("Max aspect ratio = ", q.max_aspect_ratio);
    expect_printed("Min volume = ", 1e-9 * q.min_volume_mm3);
    expect_printed("Max volume = ", 1e-9 * q.max_volume_mm3);
    expect_printed("Total volume = ", 1e-9 * q.volume_mm3);
    expect_printed("Face volume ratio : minimum: ", q.min_volume_ratio);
    EXPECT_TRUE(check(mixed_quality(mesh)).ok()) << check(mixed_quality(mesh)).summary();
    EXPECT_THAT(check_mesh_output(mesh, "-allTopology"), ::testing::HasSubstr("Mesh OK."));
  }
}

}  // namespace
}  // namespace ostia::meshing
