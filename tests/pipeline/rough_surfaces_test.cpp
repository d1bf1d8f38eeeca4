// Walls as rough as noise makes them, and walls of some thickness: what comes of them is a lumen.

#include "intake/intake_units.h"
#include "motion/unfolding.h"
#include "thick_walls.h"

#include "ostia/core/task_context.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/surface_intake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

namespace ostia::pipeline {
namespace {

using geometry::FacedSurface;
using geometry::TriMesh;
using geometry::Vec3;

bool tells_of(const std::vector<std::string>& told, const std::string& words) {
  return std::ranges::any_of(told,
                             [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

TriMesh forked_lumen(bool open, double more_radius = 0.0) {
  return geometry::surface_of(geometry::y_junction(12.0, 12.0, 1.8 + more_radius, 1.3 + more_radius, 60.0),
                              0.35, open);
}

/// Each point moved by noise of so many mm along each axis.
TriMesh noisy(TriMesh mesh, double sigma_mm) {
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  for (Vec3& p : mesh.points) p += Vec3(noise(generator), noise(generator), noise(generator));
  return mesh;
}

/// Flat caps with labels 2, 3, 4; the wall has 1.
FacedSurface with_labelled_caps(const TriMesh& open) {
  const geometry::FilledHoles filled = geometry::fill_holes(open);
  FacedSurface surface{filled.mesh, {}, {}};
  for (const std::int32_t hole : filled.hole_of_triangle) surface.face_ids.push_back(hole < 0 ? 1 : 2 + hole);
  return surface;
}

/// Noise on the wall alone: caps stay flat.
TriMesh noisy_wall(const FacedSurface& capped, double sigma_mm) {
  TriMesh mesh = noisy(capped.mesh, sigma_mm);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (capped.face_ids[t] != 1)
      for (const std::int32_t v : mesh.triangles[t])
        mesh.points[static_cast<std::size_t>(v)] = capped.mesh.points[static_cast<std::size_t>(v)];
  return mesh;
}

/// One end covered but for two sectors, each of 0.42 of the circle.
TriMesh with_a_cover(TriMesh open) {
  const std::vector<std::int32_t> rim = geometry::boundary_loops(open).front();
  Vec3 centre = Vec3::Zero();
  for (const std::int32_t v : rim)
    centre += open.points[static_cast<std::size_t>(v)] / static_cast<double>(rim.size());
  const auto first = static_cast<std::int32_t>(open.points.size());
  for (const std::int32_t v : rim)
    open.points.push_back(centre + 0.4 * (open.points[static_cast<std::size_t>(v)] - centre));
  const auto middle = static_cast<std::int32_t>(open.points.size());
  open.points.push_back(centre);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::size_t next = (i + 1) % rim.size();
    const auto inner = first + static_cast<std::int32_t>(i),
               inner_next = first + static_cast<std::int32_t>(next);
    open.triangles.push_back({inner, inner_next, middle});
    const double at = static_cast<double>(i) / static_cast<double>(rim.size());
    if (at < 0.42 || (at >= 0.5 && at < 0.92)) continue;
    open.triangles.push_back({rim[i], rim[next], inner});
    open.triangles.push_back({inner, rim[next], inner_next});
  }
  return geometry::oriented(open);
}

double volume_when_filled(const TriMesh& mesh) {
  return geometry::volume(geometry::fill_holes(mesh).mesh);
}

void expect_whole_wall(const TriMesh& mesh) {
  geometry::SurfaceFaults faults = geometry::find_faults(mesh, true);
  faults.open_edges = 0;
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 1u);
}

TEST(RoughSurfaces, FoldsOfNoiseAreSmoothedAndNotCutOut) {
  for (const double sigma : {0.05, 0.1}) {
    const double truth = volume_when_filled(forked_lumen(true));
    const FacedSurface came{noisy(with_labelled_caps(forked_lumen(true)).mesh, sigma),
                            with_labelled_caps(forked_lumen(true)).face_ids,
                            {}};
    ASSERT_FALSE(geometry::self_intersections(came.mesh).empty());
    const TakenSurface taken = take_surface(came, "noise");
    SCOPED_TRACE(sigma);
    expect_whole_wall(taken.lumen);
    EXPECT_EQ(taken.ends.size(), 3u);
    EXPECT_TRUE(taken.lost.empty());
    EXPECT_EQ(geometry::boundary_loops(taken.lumen).size(), 3u);
    EXPECT_NEAR(volume_when_filled(taken.lumen), truth, 0.02 * truth);
    EXPECT_TRUE(tells_of(taken.told, "smoothed away"));
  }
}

TEST(RoughSurfaces, AClosedOneWithoutLabelsIsSoundToo) {
  const TriMesh round = forked_lumen(false);
  const TakenSurface taken = take_surface({noisy(round, 0.1), {}, {}}, "noise");
  expect_whole_wall(taken.lumen);
  EXPECT_TRUE(geometry::boundary_loops(taken.lumen).empty());
  EXPECT_NEAR(geometry::volume(taken.lumen), geometry::volume(round), 0.02 * geometry::volume(round));
}

TEST(RoughSurfaces, FlatCapsWithoutLabelsAreEndsToo) {
  const double truth = volume_when_filled(forked_lumen(true));
  const TriMesh came = noisy_wall(with_labelled_caps(forked_lumen(true)), 0.1);
  ASSERT_FALSE(geometry::self_intersections(came).empty());
  const TakenSurface taken = take_surface({came, {}, {}}, "noise");
  expect_whole_wall(taken.lumen);
  EXPECT_EQ(taken.ends.size(), 3u);
  EXPECT_TRUE(taken.lost.empty());
  EXPECT_EQ(geometry::boundary_loops(taken.lumen).size(), 3u);
  EXPECT_NEAR(volume_when_filled(taken.lumen), truth, 0.02 * truth);
}

TEST(RoughSurfaces, OfAnEndThatIsCoveredInPartTheLargestOpeningIsTheEnd) {
  const TriMesh whole = forked_lumen(true);
  const TriMesh came = with_a_cover(whole);
  ASSERT_EQ(geometry::boundary_loops(came).size(), 4u);
  const TakenSurface taken = take_surface({came, {}, {}}, "covered");
  expect_whole_wall(taken.lumen);
  EXPECT_EQ(geometry::boundary_loops(taken.lumen).size(), 3u);
  EXPECT_TRUE(tells_of(taken.told, "a second opening of one end closed"));
  EXPECT_NEAR(volume_when_filled(taken.lumen), volume_when_filled(whole), 0.01 * volume_when_filled(whole));
}

TEST(RoughSurfaces, EndsBesideEachOtherStayTwo) {
  // Both branches end some 2 mm from each other, and face nearly the same way.
  const TriMesh fork = geometry::surface_of(geometry::y_junction(12.0, 7.2, 1.8, 1.3, 40.0), 0.3, true);
  ASSERT_EQ(geometry::boundary_loops(fork).size(), 3u);
  const TakenSurface taken = take_surface({fork, {}, {}}, "fork");
  EXPECT_EQ(geometry::boundary_loops(taken.lumen).size(), 3u);
  EXPECT_TRUE(taken.told.empty());
}

TEST(RoughSurfaces, AreMeshedWithNoFurtherWord) {
  Source source;
  source.kind = SourceKind::surface;
  TakenSurface taken = take_surface({noisy(with_labelled_caps(forked_lumen(true)).mesh, 0.08),
                                     with_labelled_caps(forked_lumen(true)).face_ids,
                                     {}},
                                    "noise");
  source.surface = std::move(taken.lumen);
  source.ends = std::move(taken.ends);
  const Model model = build_model(std::move(source), {});
  EXPECT_TRUE(model.meshed.quality.verdict.ok()) << model.meshed.quality.verdict.summary();
  ASSERT_TRUE(model.meshed.quality.shape);
  EXPECT_LE(std::abs(model.meshed.quality.shape->volume_change()), 0.01);
}

TEST(RoughSurfaces, NoiseDoesNotMakeMillimetresCentimetres) {
  const TriMesh fine = geometry::surface_of(geometry::y_junction(12.0, 12.0, 1.8, 1.3, 60.0), 0.2, false);
  geometry::FacedSurface rough{noisy(fine, 0.2), {}, {}};
  const double extent = geometry::bounds(rough.mesh.points).sizes().norm();
  ASSERT_EQ(unit_by_calibre(calibre_of_closed(rough.mesh), extent), 10.0);
  TakenSurface taken;
  to_mm(rough, std::nullopt, {}, taken, "noise");
  EXPECT_EQ(taken.unit_mm, 1.0);
  EXPECT_TRUE(taken.told.empty());

  geometry::FacedSurface in_cm{noisy(fine, 0.1), {}, {}};
  for (Vec3& p : in_cm.mesh.points) p *= 0.1;
  to_mm(in_cm, std::nullopt, {}, taken, "noise");
  EXPECT_EQ(taken.unit_mm, 10.0);
}

TEST(RoughSurfaces, VesselsThatRunThroughEachOtherAreNoFold) {
  TriMesh one = geometry::surface_of(geometry::straight_tube(12.0, 1.5), 0.4, true), other = one;
  for (Vec3& p : other.points) p = Vec3(p.z() - 6.0, p.x() + 0.7, p.y() + 6.0);
  TriMesh both = geometry::merged(one, other);
  const TriMesh before = both;
  ASSERT_FALSE(geometry::self_intersections(both).empty());
  KnownCrossings crossings;
  EXPECT_EQ(unfold(both, crossings, core::no_task()).crossings, 0u);
  ASSERT_TRUE(crossings) << "nothing has moved";
  EXPECT_EQ(*crossings, geometry::self_intersections(both));
  EXPECT_EQ(both.points, before.points);
}

TEST(ThickWalls, TheLumenIsTakenAndToldWithWidths) {
  const TriMesh lumen = forked_lumen(true);
  const TakenSurface taken =
      take_surface({testing::thick_walled(lumen, forked_lumen(true, 0.6)), {}, {}}, "pipe");
  EXPECT_EQ(taken.ends.size(), 3u);
  EXPECT_EQ(taken.unit_mm, 1.0);
  EXPECT_NEAR(volume_when_filled(taken.lumen), volume_when_filled(lumen), 1e-6 * volume_when_filled(lumen));
  EXPECT_TRUE(tells_of(taken.told, "joined by 3 flat rings"));
}

TEST(ThickWalls, InCentimetresAndInwardToo) {
  TriMesh shell = testing::thick_walled(forked_lumen(true), forked_lumen(true, 0.3));
  for (Vec3& p : shell.points) p *= 0.1;
  for (geometry::Triangle& t : shell.triangles) std::swap(t[0], t[1]);
  const TakenSurface taken = take_surface({shell, {}, {}}, "pipe");
  EXPECT_EQ(taken.unit_mm, 10.0);
  ASSERT_EQ(taken.ends.size(), 3u);
  EXPECT_NEAR(volume_when_filled(taken.lumen), volume_when_filled(forked_lumen(true)),
              1e-6 * volume_when_filled(forked_lumen(true)));
  const bool at_inlet = std::ranges::any_of(taken.ends, [](const meshing::GivenEnd& end) {
    return (end.centre - Vec3(0.0, 0.0, -12.0)).norm() < 0.1 && std::abs(end.radius_mm - 1.8) < 0.05;
  });
  EXPECT_TRUE(at_inlet) << "ends are in mm";
}

TEST(ThickWalls, ALoopOfVesselsIsNone) {
  const TriMesh ring = geometry::surface_of(geometry::torus(10.0, 1.5), 0.4, false);
  const TakenSurface taken = take_surface({ring, {}, {}}, "ring");
  EXPECT_TRUE(taken.ends.empty());
  EXPECT_NEAR(geometry::volume(taken.lumen), geometry::volume(ring), 1e-9 * geometry::volume(ring));
}

}  // namespace
}  // namespace ostia::pipeline
