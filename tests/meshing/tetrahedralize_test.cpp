#include "ostia/meshing/tetrahedralize.h"

#include "test_surfaces.h"
#include "tetrahedra_samples.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/worker_program.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/mixed_quality.h"
#include "ostia/meshing/remesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace ostia::meshing {
namespace {

geometry::FacedSurface remeshed_y() {
  const auto shape = geometry::y_junction(8.0, 8.0, 2.0, 1.5, 70.0);
  const auto input = capped(shape, 0.35, false);
  return remesh(input, target_edge_lengths(input.mesh, TubeFunction(tree_of(shape)))).surface;
}

TEST(Tetrahedralize, FillsAYAndKeepsItsBoundaryBitForBit) {
  const auto surface = remeshed_y();
  const auto result = tetrahedralize(surface);
  const geometry::VolumeMesh& mesh = result.mesh;
  EXPECT_EQ(mesh.boundary, surface.mesh.triangles);
  EXPECT_EQ(mesh.boundary_face_ids, surface.face_ids);
  EXPECT_EQ(mesh.faces.size(), 4u);
  EXPECT_TRUE(std::equal(surface.mesh.points.begin(), surface.mesh.points.end(), mesh.points.begin()));
  EXPECT_GT(mesh.points.size(), surface.mesh.points.size());
  const VolumeQuality quality = volume_quality(mesh);
  EXPECT_EQ(quality.inverted, 0u);
  EXPECT_EQ(quality.boundary_mismatches, 0u);
  const QualityVerdict gate = check(mixed_quality(geometry::mixed(mesh)));
  EXPECT_TRUE(gate.ok()) << gate.summary();
  EXPECT_GE(quality.min_dihedral_deg, result.report.min_dihedral_before_mending_deg);
  EXPECT_NEAR(geometry::volume(mesh), geometry::volume(surface.mesh), 1e-9 * geometry::volume(mesh));
  EXPECT_NEAR(quality.mean_edge_mm, surface_quality(surface.mesh, false).mean_edge_mm,
              0.15 * quality.mean_edge_mm);
}

TEST(Tetrahedralize, ALargerSizeMakesFewerTetrahedra) {
  const auto surface = remeshed_y();
  TetrahedralizeOptions coarse;
  coarse.size_factor = 2.0;
  EXPECT_LT(tetrahedralize(surface, coarse).mesh.tetrahedra.size(),
            tetrahedralize(surface).mesh.tetrahedra.size());
}

/// A tube bent into itself: two capped tubes that cross, as one surface.
geometry::FacedSurface crossing_tubes() {
  auto surface = capped_tube();
  auto other = surface.mesh;
  for (auto& p : other.points) p = geometry::Vec3(p.z() - 6.0, p.y() + 0.3, p.x() + 6.1);
  for (auto& t : other.triangles) std::swap(t[0], t[1]);
  surface.mesh = geometry::merged(surface.mesh, other);
  surface.face_ids.resize(surface.mesh.triangles.size(), 1);
  return surface;
}

TEST(Tetrahedralize, NamesSelfIntersectionsBeforeAndInTheChild) {
  const auto surface = crossing_tubes();
  auto message = [&](bool check_input) -> std::string {
    TetrahedralizeOptions options;
    options.check_input = check_input;
    try {
      tetrahedralize(surface, options);
    } catch (const GeometryError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(true).find("self-intersection"), std::string::npos) << message(true);
  EXPECT_NE(message(false).find("TetGen stopped"), std::string::npos) << message(false);
}

TEST(Tetrahedralize, ReportsAChildThatDiesOrRunsOut) {
  const auto surface = remeshed_y();
  TetrahedralizeOptions starved;
  starved.mesher = Mesher::tetgen;
  starved.limits.memory_bytes = 12ULL << 20;
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_THROW(tetrahedralize(surface, starved), Error);
  starved.mesher = Mesher::automatic;
  starved.mesh3_limits.memory_bytes = 12ULL << 20;
  EXPECT_THROW(tetrahedralize(surface, starved), Error);
#endif
  ASSERT_EQ(setenv("OSTIA_WORKER", "/nowhere/ostia-worker", 1), 0);
  EXPECT_THROW(tetrahedralize(surface), IoError);
  unsetenv("OSTIA_WORKER");
}

/// Area of each face.
std::map<std::int32_t, double> areas_of(const std::vector<geometry::Vec3>& points,
                                        const std::vector<geometry::Triangle>& triangles,
                                        const std::vector<std::int32_t>& ids) {
  std::map<std::int32_t, double> areas;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    areas[ids[i]] += geometry::area(geometry::TriMesh{points, {triangles[i]}});
  return areas;
}

void expect_meshed_anew(const TetrahedralizedVolume& result, const geometry::FacedSurface& surface,
                        double deviation_mm) {
  const geometry::VolumeMesh& mesh = result.mesh;
  EXPECT_EQ(result.report.made_by, Mesher::mesh3);
  EXPECT_TRUE(result.report.surface_meshed_anew);
  EXPECT_GT(result.report.surface_deviation_mm, 0.0);
  EXPECT_LT(result.report.surface_deviation_mm, deviation_mm);
  ASSERT_FALSE(result.report.warnings.empty());
  EXPECT_NE(result.report.warnings.back().find("meshed anew"), std::string::npos);
  // A closed, outward surface whose points come first; every face is there with its area.
  const geometry::TriMesh boundary{mesh.points, mesh.boundary};
  EXPECT_TRUE(geometry::find_faults(boundary, true).closed_manifold());
  std::int32_t last = 0;
  for (const auto& t : mesh.boundary) last = std::max(last, *std::max_element(t.begin(), t.end()));
  std::set<std::int32_t> used;
  for (const auto& t : mesh.boundary) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), static_cast<std::size_t>(last) + 1);
  const double volume = geometry::volume(surface.mesh);
  EXPECT_NEAR(geometry::volume(boundary), volume, 0.02 * volume);
  EXPECT_NEAR(geometry::volume(mesh), geometry::volume(boundary), 1e-9 * volume);
  EXPECT_EQ(mesh.faces.size(), surface.faces.size());
  const auto areas = areas_of(mesh.points, mesh.boundary, mesh.boundary_face_ids);
  for (const auto& [id, area] : areas_of(surface.mesh.points, surface.mesh.triangles, surface.face_ids)) {
    ASSERT_TRUE(areas.contains(id)) << id;
    EXPECT_NEAR(areas.at(id), area, 0.02 * area) << id;
  }
  EXPECT_EQ(result.report.quality.inverted, 0u);
  EXPECT_EQ(result.report.quality.boundary_mismatches, 0u);
  EXPECT_EQ(result.report.below_10_deg, 0u);
  const QualityVerdict gate = check(mixed_quality(geometry::mixed(mesh)));
  EXPECT_TRUE(gate.ok()) << gate.summary();
}

TEST(Tetrahedralize, TheSecondMesherFillsATubeAndAY) {
  TetrahedralizeOptions options;
  options.mesher = Mesher::mesh3;
  const auto tube = capped_tube(6.0);
  expect_meshed_anew(tetrahedralize(tube, options), tube, 0.1);
  const auto y = remeshed_y();
  const auto result = tetrahedralize(y, options);
  expect_meshed_anew(result, y, 0.15);
  const auto again = tetrahedralize(y, options);
  EXPECT_EQ(again.mesh.points, result.mesh.points);
  EXPECT_EQ(again.mesh.tetrahedra, result.mesh.tetrahedra);
}

TEST(Tetrahedralize, TheSecondMesherKeepsTheEdgesAndCornersOfABox) {
  // Six faces that meet in edges and corners: all of it is flat, so the new surface is the old one.
  const geometry::VolumeMesh cubes = random_box(4, 1);
  geometry::FacedSurface box;
  box.mesh = geometry::subset({cubes.points, cubes.boundary}, std::vector<bool>(cubes.boundary.size(), true));
  for (const auto& t : box.mesh.triangles)
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {0.0, 4.0})
        if (std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
              return box.mesh.points[static_cast<std::size_t>(v)][axis] == side;
            }))
          box.face_ids.push_back(2 * axis + (side > 0.0 ? 2 : 1));
  for (std::int32_t id = 1; id <= 6; ++id) box.faces.push_back({id, "face", geometry::FaceKind::wall});
  TetrahedralizeOptions options;
  options.mesher = Mesher::mesh3;
  const auto result = tetrahedralize(box, options);
  EXPECT_TRUE(result.report.surface_meshed_anew);
  EXPECT_LT(result.report.surface_deviation_mm, 1e-9);
  EXPECT_NEAR(geometry::volume(result.mesh), 64.0, 1e-9);
  for (const auto& [id, area] :
       areas_of(result.mesh.points, result.mesh.boundary, result.mesh.boundary_face_ids))
    EXPECT_NEAR(area, 16.0, 1e-9) << id;
  for (const double x : {0.0, 4.0})
    for (const double y : {0.0, 4.0})
      for (const double z : {0.0, 4.0}) {
        const geometry::Vec3 corner(x, y, z);
        EXPECT_TRUE(std::any_of(result.mesh.points.begin(), result.mesh.points.end(),
                                [&](const geometry::Vec3& p) { return (p - corner).norm() < 1e-12; }));
      }
}

TEST(Tetrahedralize, TheSecondMesherTakesOverWhenTetgenFails) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "memory is not limited under AddressSanitizer";
#endif
  const auto surface = capped_tube(6.0);
  TetrahedralizeOptions starved;
  starved.limits.memory_bytes = 12ULL << 20;
  const auto result = tetrahedralize(surface, starved);
  expect_meshed_anew(result, surface, 0.1);
  EXPECT_NE(result.report.warnings.front().find("TetGen failed"), std::string::npos);
}

/// A worker in place of the real one that ends with a code for its first calls, and does its work after that.
class FailingWorker {
 public:
  FailingWorker(int calls, int exit_code)
      : script_(std::filesystem::path(::testing::TempDir()) / "failing-worker.sh"),
        count_(std::filesystem::path(::testing::TempDir()) / "failing-worker.count") {
    std::filesystem::remove(count_);
    core::write_file(script_, "#!/bin/sh\necho call >> " + count_.string() + "\nif [ $(wc -l < " +
                                  count_.string() + ") -le " + std::to_string(calls) +
                                  " ]; then echo made to fail >&2; exit " + std::to_string(exit_code) +
                                  "; fi\nexec " + core::worker_program().string() + " \"$@\"\n");
    std::filesystem::permissions(script_, std::filesystem::perms::owner_all);
    setenv("OSTIA_WORKER", script_.c_str(), 1);
  }
  ~FailingWorker() { unsetenv("OSTIA_WORKER"); }
  FailingWorker(const FailingWorker&) = delete;
  FailingWorker& operator=(const FailingWorker&) = delete;
  std::size_t calls() const {
    const std::string lines = core::read_file(count_);
    return static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n'));
  }

 private:
  std::filesystem::path script_, count_;
};

TEST(Tetrahedralize, AsksForLessWhereTetgenFailsOnceAndForTheSecondMesherWhereItFailsTwice) {
  const auto surface = remeshed_y();
  {
    const FailingWorker worker(1, 6);
    const auto result = tetrahedralize(surface);
    EXPECT_EQ(worker.calls(), 2u);
    EXPECT_EQ(result.report.made_by, Mesher::tetgen);
    EXPECT_EQ(result.mesh.boundary, surface.mesh.triangles);
    EXPECT_EQ(result.report.below_10_deg, 0u);
    ASSERT_EQ(result.report.warnings.size(), 1u);
    EXPECT_NE(result.report.warnings[0].find("made to fail"), std::string::npos);
    EXPECT_NE(result.report.warnings[0].find("a larger size"), std::string::npos);
  }
  {
    const FailingWorker worker(2, 6);
    const auto result = tetrahedralize(surface);
    EXPECT_EQ(worker.calls(), 3u);
    expect_meshed_anew(result, surface, 0.15);
  }
  {
    const FailingWorker worker(1, 3);  // a surface that TetGen refuses: asking for less is of no use
    const auto result = tetrahedralize(surface);
    EXPECT_EQ(worker.calls(), 2u);
    expect_meshed_anew(result, surface, 0.15);
  }
  {
    const FailingWorker worker(9, 6);
    try {
      tetrahedralize(surface);
      FAIL() << "no mesher ran";
    } catch (const GeometryError& error) {
      EXPECT_NE(std::string(error.what()).find("before that"), std::string::npos) << error.what();
    }
    EXPECT_EQ(worker.calls(), 3u);
  }
}

TEST(Tetrahedralize, MendingLeavesNoBadTetrahedronAndIsRepeatable) {
  const auto surface = remeshed_y();
  const auto result = tetrahedralize(surface), again = tetrahedralize(surface);
  EXPECT_LT(result.report.min_dihedral_before_mending_deg, 15.0);
  EXPECT_GT(result.report.quality.min_dihedral_deg, 18.0);
  EXPECT_EQ(result.report.below_12_deg, 0u);
  EXPECT_EQ(result.report.made_by, Mesher::tetgen);
  EXPECT_FALSE(result.report.surface_meshed_anew);
  EXPECT_EQ(result.mesh.points, again.mesh.points);
  EXPECT_EQ(result.mesh.tetrahedra, again.mesh.tetrahedra);
  TetrahedralizeOptions none;
  none.mending_rounds = 0;
  const auto raw = tetrahedralize(surface, none);
  EXPECT_GT(raw.report.below_12_deg, 0u);
  EXPECT_EQ(raw.mesh.tetrahedra.size(), result.report.mending.tetrahedra_before);
}

TEST(Tetrahedralize, RefusesBadInputAndObeysCancel) {
  const auto surface = capped_tube();
  TetrahedralizeOptions bad;
  bad.size_factor = 0.0;
  EXPECT_THROW(tetrahedralize(surface, bad), InvalidInput);
  bad = {};
  bad.max_radius_edge_ratio = 0.5;
  EXPECT_THROW(tetrahedralize(surface, bad), InvalidInput);
  auto open = surface;
  open.mesh.triangles.pop_back();
  EXPECT_THROW(tetrahedralize(open), InvalidInput);  // ids no longer match
  open.face_ids.pop_back();
  EXPECT_THROW(tetrahedralize(open), GeometryError);
  auto inward = surface;
  for (auto& t : inward.mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_THROW(tetrahedralize(inward), GeometryError);
  EXPECT_THROW(tetrahedralize({}), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(tetrahedralize(surface, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
