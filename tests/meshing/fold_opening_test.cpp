#include "ostia/meshing/fold_opening.h"

#include "boundary_layer_shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/quality.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

/// Layers at the setting that the pipeline asks for.
BoundaryLayer three_layers(const geometry::FacedSurface& surface) {
  BoundaryLayerOptions options;
  options.layers = 3;
  return boundary_layer(surface, options);
}

void expect_the_rest_stays(const geometry::FacedSurface& before, const geometry::FacedSurface& after,
                           const Vec3& place, double reach_mm) {
  EXPECT_EQ(before.mesh.triangles, after.mesh.triangles);
  EXPECT_EQ(before.face_ids, after.face_ids);
  ASSERT_EQ(before.mesh.points.size(), after.mesh.points.size());
  for (std::size_t i = 0; i < before.mesh.points.size(); ++i) {
    if ((before.mesh.points[i] - place).norm() > reach_mm) {
      EXPECT_EQ(before.mesh.points[i], after.mesh.points[i]);
    }
  }
}

TEST(FoldOpening, AWallWithoutFoldsStaysBitForBit) {
  const geometry::FacedSurface tube = structured_tube(20, 1.5, 0.4, 24);
  geometry::FacedSurface same = tube;
  const OpenedFolds none = open_folds(same);
  EXPECT_EQ(none.folds, 0U);
  EXPECT_EQ(none.moved, 0U);
  EXPECT_TRUE(none.warnings.empty());
  EXPECT_EQ(same.mesh.points, tube.mesh.points);
}

TEST(FoldOpening, AThornGetsAsBluntAsLayersNeed) {
  geometry::FacedSurface thorny = structured_tube(20, 1.5, 0.4, 24);
  thorny.mesh.points[20 * 12].x() = 0.0;
  const geometry::FacedSurface before = thorny;
  ASSERT_LT(three_layers(thorny).report.min_scaled_jacobian, 0.1);
  const OpenedFolds opened = open_folds(thorny, {.most_moved = 2.0});
  EXPECT_GT(opened.folds, 0U);
  EXPECT_EQ(opened.closed, 0U);
  EXPECT_GT(opened.most_moved_mm, 0.0);
  ASSERT_EQ(opened.warnings.size(), 1U);
  EXPECT_NE(opened.warnings[0].find("rounded off"), std::string::npos);
  expect_the_rest_stays(before, thorny, {1.0, 0.0, 4.8}, 2.5);
  EXPECT_GE(three_layers(thorny).report.min_scaled_jacobian, 0.1);
}

TEST(FoldOpening, TheCrotchOfAnAcuteForkTakesLayers) {
  const geometry::AnalyticShape fork = geometry::y_junction(8.0, 20.0, 2.0, 1.4, 15.0);
  geometry::FacedSurface surface = remeshed(fork, 0.3, 0.8);
  const double volume = geometry::volume(surface.mesh);
  const geometry::FacedSurface before = surface;
  const OpenedFolds opened = open_folds(surface, {.open_below = 0.3});
  EXPECT_GT(opened.folds, 0U);
  EXPECT_NEAR(geometry::volume(surface.mesh) / volume, 1.0, 0.01);
  EXPECT_GE(surface_quality(surface.mesh).min_angle_deg, 19.9);
  const BoundaryLayer sharp = three_layers(before), blunt = three_layers(surface);
  EXPECT_EQ(blunt.report.inverted, 0U);
  EXPECT_GE(blunt.report.min_scaled_jacobian, sharp.report.min_scaled_jacobian - 0.01);
}

TEST(FoldOpening, RefusesBadInputAndObeysCancel) {
  geometry::FacedSurface tube = structured_tube(12, 1.5, 0.7, 8);
  EXPECT_THROW(open_folds(tube, {.open_below = 0.0}), InvalidInput);
  EXPECT_THROW(open_folds(tube, {.open_below = 0.6}), InvalidInput);
  EXPECT_THROW(open_folds(tube, {.most_moved = 0.0}), InvalidInput);
  EXPECT_THROW(open_folds(tube, {.max_rounds = 0}), InvalidInput);
  geometry::FacedSurface empty;
  EXPECT_THROW(open_folds(empty), InvalidInput);
  geometry::FacedSurface open = tube;
  open.mesh.triangles.pop_back();
  open.face_ids.pop_back();
  EXPECT_THROW(open_folds(open), GeometryError);
  tube.mesh.points[12 * 4].x() = -0.5;
  const core::TaskContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(open_folds(tube, {}, cancelled), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
