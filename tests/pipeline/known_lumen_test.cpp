// What is found out about a surface while it is taken in, and used again for its axes.

#include "ostia/core/parallel.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/lumen_axes.h"
#include "ostia/pipeline/surface_intake.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

TriMesh sound_y() {
  return geometry::surface_of(geometry::y_junction(20.0, 20.0, 2.0, 1.5, 60.0), 0.4, true);
}

TakenSurface taken_for_axes(TriMesh mesh) {
  IntakeOptions options;
  options.for_axes = true;
  return take_surface({std::move(mesh), {}, {}}, "y", options);
}

LumenAxes axes_of(const TakenSurface& taken, bool with_what_is_known) {
  AxesRequest request;
  request.ends = taken.ends;
  if (with_what_is_known) request.known = taken.known;
  return lumen_axes(taken.lumen, request);
}

void expect_same(const LumenAxes& a, const LumenAxes& b) {
  EXPECT_EQ(a.told, b.told);
  EXPECT_EQ(a.diagnostics.warnings, b.diagnostics.warnings);
  EXPECT_EQ(a.diagnostics.surface_points, b.diagnostics.surface_points);
  EXPECT_EQ(a.diagnostics.delaunay_cells, b.diagnostics.delaunay_cells);
  EXPECT_EQ(a.diagnostics.doubtful_cells, b.diagnostics.doubtful_cells);
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (std::size_t i = 0; i < a.lines.size(); ++i) {
    EXPECT_EQ(a.lines[i].points, b.lines[i].points);
    EXPECT_EQ(a.lines[i].radius, b.lines[i].radius);
  }
}

TEST(KnownLumen, GivesTheSameAxesForAnyNumberOfThreads) {
  const LumenAxes plain = axes_of(take_surface({sound_y(), {}, {}}, "y"), false);
  ASSERT_EQ(plain.lines.size(), 2u);
  for (const int threads : {1, 2, 3}) {
    core::set_max_threads(threads);
    const TakenSurface taken = taken_for_axes(sound_y());
    ASSERT_TRUE(taken.known);
    EXPECT_EQ(taken.known->loops.size(), 3u);
    EXPECT_EQ(taken.known->tetrahedra != nullptr, threads > 1);
    SCOPED_TRACE(threads);
    expect_same(plain, axes_of(taken, true));
    expect_same(plain, axes_of(taken, true));  // the tetrahedra are gone by now
  }
  core::set_max_threads(0);
}

TEST(KnownLumen, OfASurfaceInCentimetresIsOfItsMillimetres) {
  TriMesh centimetres = sound_y();
  for (Vec3& p : centimetres.points) p *= 0.1;
  core::set_max_threads(2);
  IntakeOptions options;
  options.unit_mm = 10.0;
  options.for_axes = true;
  const TakenSurface taken = take_surface({centimetres, {}, {}}, "y", options);
  ASSERT_TRUE(taken.known);
  EXPECT_TRUE(centerline::is_of(*taken.known, taken.lumen));
  EXPECT_TRUE(taken.known->tetrahedra->take(taken.lumen.points));
  core::set_max_threads(0);
}

TEST(KnownLumen, OfASurfaceThatFacedInwardIsThatOfTheOutwardOne) {
  const TriMesh outward = sound_y();
  TriMesh inward = outward;
  for (geometry::Triangle& t : inward.triangles) std::swap(t[1], t[2]);
  core::set_max_threads(2);
  const TakenSurface taken = taken_for_axes(inward);
  EXPECT_EQ(taken.lumen.triangles, outward.triangles);
  ASSERT_FALSE(taken.told.empty());
  EXPECT_NE(taken.told.front().find("turned"), std::string::npos);
  ASSERT_TRUE(taken.known);
  expect_same(axes_of(taken_for_axes(outward), true), axes_of(taken, true));
  core::set_max_threads(0);
}

TEST(KnownLumen, IsNothingWhereTheSurfaceWasChanged) {
  const TriMesh capped = geometry::fill_holes(sound_y()).mesh;
  const TakenSurface opened = taken_for_axes(capped);
  EXPECT_EQ(opened.ends.size(), 3u);
  EXPECT_FALSE(opened.known);

  const TriMesh whole = sound_y();
  std::vector<bool> keep(whole.triangles.size(), true);
  for (std::size_t i = 0; i < keep.size(); ++i) {  // a small hole in the wall
    const Vec3& p = whole.points[static_cast<std::size_t>(whole.triangles[i][0])];
    if ((p - Vec3(2.0, 0.0, -10.0)).norm() < 0.8) keep[i] = false;
  }
  const TakenSurface holed = taken_for_axes(geometry::subset(whole, keep));
  EXPECT_FALSE(holed.told.empty());
  EXPECT_FALSE(holed.known);
}

TEST(KnownLumen, OfAnotherSurfaceIsPassedOver) {
  const TakenSurface taken = taken_for_axes(sound_y());
  TriMesh other = sound_y();
  for (Vec3& p : other.points) p *= 1.2;
  AxesRequest request;
  const LumenAxes plain = lumen_axes(other, request);
  request.known = taken.known;
  expect_same(plain, lumen_axes(other, request));
}

}  // namespace
}  // namespace ostia::pipeline
