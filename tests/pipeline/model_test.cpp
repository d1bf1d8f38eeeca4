#include "ostia/pipeline/model.h"

#include "builtin_model.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  EXPECT_TRUE(model.meshed.quality.verdict.ok()) << model.meshed.quality.verdict.summary();
  EXPECT_EQ(model.meshed.centerlines.tree.vessels.size(), 2u);
  EXPECT_EQ(model.meshed.quality.surface.open_edges, 0u);
  EXPECT_EQ(model.meshed.quality.surface.self_intersections, 0u);
  EXPECT_GE(model.meshed.quality.surface.min_angle_deg, 20.0);
  EXPECT_EQ(model.meshed.quality.volume.inverted(), 0u);
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
  EXPECT_NEAR(model.meshed.quality.volume.volume_mm3(), geometry::volume(model.meshed.surface.mesh),
              1e-6 * model.meshed.quality.volume.volume_mm3());
}

TEST(Model, OpenTubeGoesFromItsEndToItsEnd) {
  ModelOptions options;
  options.sizing.edge_ratio = 0.25;  // chords of a quarter of the radius take 1 % from a circle's area
  options.inset_radii = 2.0;         // flat open ends stay where they are, which is told
  const Model model = build_model(
      surface_source(geometry::surface_of(geometry::straight_tube(20.0, 2.0), 0.4, true)), options);
  EXPECT_TRUE(model.meshed.quality.verdict.ok()) << model.meshed.quality.verdict.summary();
  EXPECT_NEAR(model.meshed.quality.volume.volume_mm3(), std::numbers::pi * 4.0 * 20.0,
              0.02 * std::numbers::pi * 80.0);
  EXPECT_EQ(std::ranges::count_if(model.warnings,
                                  [](const std::string& line) {
                                    return line.find("does nothing at 2 of 2 ends") != std::string::npos;
                                  }),
            1);
}

/// A tube of 20 mm, radius 2 mm, with layers as given.
Model tube_with(const VolumeOptions& volume) {
  ModelOptions options;
  options.volume = volume;
  return build_model(surface_source(geometry::surface_of(geometry::straight_tube(20.0, 2.0), 0.4, true)),
                     options);
}

TEST(Model, LayersArePrismsOnTheWall) {
  VolumeOptions volume;
  volume.layers.emplace();
  volume.layers->layers = 3;
  volume.layers->thickness = 0.5;
  const Model model = tube_with(volume);
  const MeshQuality& quality = model.meshed.quality;
  EXPECT_TRUE(quality.verdict.ok()) << quality.verdict.summary();
  const std::size_t wall = wall_of(model.meshed.surface).triangles.size();
  EXPECT_EQ(model.meshed.mesh.prisms.size(), 3 * wall);
  ASSERT_TRUE(quality.layers);
  EXPECT_NEAR(quality.layers->full_share, 1.0, 1e-9);
  EXPECT_EQ(quality.volume.inverted(), 0u);
  EXPECT_NEAR(quality.volume.volume_mm3(), geometry::volume(model.meshed.surface.mesh),
              1e-3 * quality.volume.volume_mm3());
  ASSERT_EQ(quality.volume.faces.size(), 3u);
  for (std::size_t cap : {1u, 2u}) {  // 16 chords around take 2.6 % from a circle
    EXPECT_NEAR(quality.volume.faces[cap].area_mm2, 4.0 * std::numbers::pi, 0.04 * 4.0 * std::numbers::pi);
    EXPECT_GT(quality.volume.faces[cap].quads, 0u);
  }
  volume.split_prisms = true;
  const Model split = tube_with(volume);
  EXPECT_TRUE(split.meshed.mesh.prisms.empty());
  EXPECT_TRUE(split.meshed.quality.verdict.ok()) << split.meshed.quality.verdict.summary();
  EXPECT_EQ(std::ranges::count(split.meshed.in_layers, true), 9 * static_cast<std::ptrdiff_t>(wall));
  EXPECT_EQ(split.meshed.mesh.tetrahedra.size(), model.meshed.mesh.tetrahedra.size() + 9 * wall);
  EXPECT_NEAR(split.meshed.quality.volume.volume_mm3(), quality.volume.volume_mm3(), 1e-2);
}

TEST(Model, WhatCannotBeMeshedIsToldBeforeAnything) {
  const auto refused = [](const VolumeOptions& volume, const std::string& part) {
    ModelOptions options;
    options.volume = volume;
    Source nothing;  // would be refused as well, but later
    nothing.kind = SourceKind::surface;
    expect_error(nothing, options, ExitCode::bad_input, part);
  };
  VolumeOptions volume;
  volume.order = 3;
  refused(volume, "1 or 2");
  volume.order = 2;
  volume.formats = {io::MeshFormat::openfoam};
  refused(volume, "--order 1");
  volume = {};
  volume.split_prisms = true;
  refused(volume, "no prisms");
  volume = {};
  volume.layers.emplace();
  volume.formats = {io::MeshFormat::mesh_complete};
  refused(volume, "--split-prisms");
  volume.formats.clear();
  volume.solver_case = solver::SvmultiphysicsCaseOptions();
  refused(volume, "--split-prisms");
  volume.order = 2;
  volume.solver_case = solver::OpenfoamCaseOptions();
  refused(volume, "--order 1");
  volume.order = 1;
  solver::OpenfoamCaseOptions wrong;
  wrong.processes = 0;
  volume.solver_case = wrong;
  refused(volume, "processes");
  volume.solver_case.reset();
  volume.layers->thickness = 4.0;
  refused(volume, "thickness");
  volume.layers->thickness = 0.5;
  volume.layers->layers = 21;
  refused(volume, "layers");
}

TEST(Model, AClosedSurfacesEndsAreFoundOrGiven) {
  const TriMesh closed = geometry::surface_of(geometry::straight_tube(20.0, 2.0), 0.4, false);
  ModelOptions options;
  const Model found = build_model(surface_source(closed), options);
  EXPECT_TRUE(found.meshed.quality.verdict.ok()) << found.meshed.quality.verdict.summary();
  EXPECT_EQ(found.meshed.surface.faces.size(), 3u);
  options.source = Vec3(0, 0, 0);
  options.targets = {Vec3(0, 0, 20)};
  EXPECT_TRUE(build_model(surface_source(closed), options).meshed.quality.verdict.ok());
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

TEST(Model, MeshesSeveralPartsAndRefusesSelfIntersections) {
  const TriMesh tube = geometry::surface_of(geometry::straight_tube(10.0, 2.0), 0.5, true);
  TriMesh moved = tube;
  for (Vec3& p : moved.points) p += Vec3(20, 0, 0);
  const Model two = build_model(surface_source(geometry::merged(tube, moved)), {});
  EXPECT_TRUE(two.meshed.quality.verdict.ok()) << two.meshed.quality.verdict.summary();
  EXPECT_EQ(two.meshed.surface.faces.size(), 5u) << "a wall, two inlets, two outlets";
  EXPECT_NEAR(two.meshed.quality.volume.volume_mm3(), 2.0 * geometry::volume(geometry::fill_holes(tube).mesh),
              0.01 * two.meshed.quality.volume.volume_mm3());
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
