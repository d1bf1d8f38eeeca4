#include "ostia/pipeline/model.h"

#include "builtin_model.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

Source surface_source(TriMesh mesh) {
  Source source;
  source.kind = SourceKind::surface;
  source.surface = std::move(mesh);
  source.sha256 = std::string(64, '0');
  source.pseudonym = "image-00000000";
  return source;
}

void expect_error(Source source, const ModelOptions& options, ExitCode code, const std::string& part) {
  try {
    build_model(std::move(source), options);
    ADD_FAILURE() << "accepted; expected " << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), code) << error.what();
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Model, BuiltinCaseBecomesAValidMesh) {
  const Model& model = builtin_model();
  EXPECT_TRUE(model.meshed.verdict.ok()) << model.meshed.verdict.summary();
  EXPECT_EQ(model.meshed.centerlines.tree.vessels.size(), 2u);
  EXPECT_EQ(model.meshed.surface_quality.open_edges, 0u);
  EXPECT_EQ(model.meshed.surface_quality.self_intersections, 0u);
  EXPECT_GE(model.meshed.surface_quality.min_angle_deg, 20.0);
  EXPECT_EQ(model.meshed.volume_quality.inverted, 0u);
  ASSERT_EQ(model.meshed.mesh.faces.size(), 4u);
  EXPECT_EQ(model.meshed.mesh.faces[0].name, "wall");
  int inlets = 0, outlets = 0;
  for (const auto& face : model.meshed.mesh.faces) {
    inlets += face.kind == geometry::FaceKind::inlet;
    outlets += face.kind == geometry::FaceKind::outlet;
  }
  EXPECT_EQ(inlets, 1);
  EXPECT_EQ(outlets, 2);
}

TEST(Model, VolumeIsThatOfItsSurface) {
  const Model& model = builtin_model();
  EXPECT_NEAR(geometry::volume(model.meshed.mesh), geometry::volume(model.meshed.surface.mesh),
              1e-6 * geometry::volume(model.meshed.mesh));
}

TEST(Model, OpenTubeGoesFromItsEndToItsEnd) {
  ModelOptions options;
  options.sizing.edge_ratio = 0.25;  // chords of a quarter of the radius take 1 % from a circle's area
  const Model model = build_model(
      surface_source(geometry::surface_of(geometry::straight_tube(20.0, 2.0), 0.4, true)), options);
  EXPECT_TRUE(model.meshed.verdict.ok()) << model.meshed.verdict.summary();
  EXPECT_NEAR(geometry::volume(model.meshed.mesh), std::numbers::pi * 4.0 * 20.0,
              0.02 * std::numbers::pi * 80.0);
}

TEST(Model, ClosedSurfaceNeedsItsEnds) {
  const TriMesh closed = geometry::surface_of(geometry::straight_tube(20.0, 2.0), 0.4, false);
  ModelOptions options;
  EXPECT_THROW(build_model(surface_source(closed), options), Error);
  options.source = Vec3(0, 0, 0);
  options.targets = {Vec3(0, 0, 20)};
  EXPECT_TRUE(build_model(surface_source(closed), options).meshed.verdict.ok());
}

TEST(Model, IsTheSameForAnyNumberOfThreads) {
  const Source source = surface_source(geometry::surface_of(geometry::straight_tube(15.0, 2.0), 0.4, true));
  core::set_max_threads(1);
  const Model one = build_model(source, {});
  core::set_max_threads(3);
  const Model three = build_model(source, {});
  core::set_max_threads(0);
  EXPECT_EQ(one.meshed.mesh.points, three.meshed.mesh.points);
  EXPECT_EQ(one.meshed.mesh.tetrahedra, three.meshed.mesh.tetrahedra);
}

TEST(Model, RefusesAnImageWithoutBranches) {
  expect_error(source_of(builtin_case()), {}, ExitCode::bad_input, "--branch");
}

TEST(Model, RefusesSeedsOutsideTheImage) {
  ModelOptions options = builtin_options();
  options.branches[0].from = Vec3(9999, 0, 0);
  expect_error(source_of(builtin_case()), options, ExitCode::bad_input, "outside");
}

TEST(Model, RefusesSeedsBesideTheVessel) {
  ModelOptions options = builtin_options();
  options.branches[0].from = builtin_case().image.geometry.origin + Vec3(1, 1, 1);
  expect_error(source_of(builtin_case()), options, ExitCode::bad_input, "HU");
}

TEST(Model, RefusesARangeThatExcludesTheSeed) {
  ModelOptions options = builtin_options();
  options.segment.fronts.lower_hu = 900.0;
  expect_error(source_of(builtin_case()), options, ExitCode::bad_input, "900");
}

TEST(Model, RefusesFrontsThatNeverMeet) {
  phantom::BuiltinCase cut = builtin_case();
  // A gap of fat across the main vessel, beyond the bifurcation.
  const auto& axis = cut.truth.tubes[0].axis;
  const Vec3 middle = axis.points[axis.size() * 4 / 5];
  for (std::int64_t k = 0; k < cut.image.geometry.size[2]; ++k) {
    for (std::int64_t j = 0; j < cut.image.geometry.size[1]; ++j) {
      for (std::int64_t i = 0; i < cut.image.geometry.size[0]; ++i) {
        const Vec3 p = cut.image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if ((p - middle).norm() < 5.0) cut.image(i, j, k) = -80;
      }
    }
  }
  ModelOptions options;
  options.branches = {branches_of(cut)[0]};
  options.segment.fronts.lower_hu = 150.0;
  expect_error(source_of(cut), options, ExitCode::bad_input, "meet");
}

TEST(Model, RefusesSurfacesWithSeveralPartsOrSelfIntersections) {
  const TriMesh tube = geometry::surface_of(geometry::straight_tube(10.0, 2.0), 0.5, true);
  TriMesh moved = tube;
  for (Vec3& p : moved.points) p += Vec3(20, 0, 0);
  expect_error(surface_source(geometry::merged(tube, moved)), {}, ExitCode::bad_input, "2 separate parts");
  TriMesh folded = tube;
  Vec3& pushed = folded.points[folded.points.size() / 2];  // through the wall across
  pushed = Vec3(-3.0 * pushed.x(), -3.0 * pushed.y(), pushed.z());
  expect_error(surface_source(folded), {}, ExitCode::bad_input, "intersect");
}

TEST(Model, CanBeCancelledInEveryStage) {
  for (const double at : {0.0, 0.1, 0.22, 0.29, 0.35, 0.5, 0.7, 0.9}) {
    const core::TaskContext task;
    std::atomic<bool> finished{false};
    std::thread watcher([&] {
      while (task.progress() < at && !finished) std::this_thread::yield();
      task.cancel();
    });
    bool cancelled = false;
    try {
      build_model(source_of(builtin_case()), builtin_options(), task);
    } catch (const Cancelled&) {
      cancelled = true;
    }
    finished = true;
    watcher.join();
    EXPECT_TRUE(cancelled) << at;
  }
}

}  // namespace
}  // namespace ostia::pipeline
