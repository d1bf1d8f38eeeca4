#include "ostia/motion/cage_registration.h"

#include "moved_tree.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/isosurface.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::motion {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

using testing::beat;
using testing::Error;
using testing::moved;
using testing::noisy;
using testing::target_distance;
using testing::vertex_error;
using testing::without;

class CageRegistration : public ::testing::Test {
 protected:
  static const TriMesh& source() {
    static const TriMesh mesh = geometry::surface_of(geometry::coronary_like_tree(), 0.6, false);
    return mesh;
  }
  /// The same tree in other triangles.
  static const TriMesh& other() {
    static const TriMesh mesh = geometry::surface_of(geometry::coronary_like_tree(), 0.65, false);
    return mesh;
  }
};

// Known motion of up to 12 mm, in vessels of 0.8 to 2 mm radius: most closest points are wrong at first.
TEST_F(CageRegistration, FollowsATreeThroughABeat) {
  for (const double amount : {0.4, 1.0}) {
    const TriMesh target = noisy(moved(other(), amount), 0.05);
    ASSERT_GT(target_distance(target, source()), 2.0 * amount);
    const Registration r = register_cage(source(), target);
    const Error e = vertex_error(source(), r.surface, amount);
    EXPECT_LE(target_distance(target, r.surface), 0.06);  // 0.04 is the noise along normals
    EXPECT_LE(e.mean, 0.25);
    EXPECT_LE(e.worst, 1.5);
    EXPECT_GT(r.report.least_jacobian, 0.0);
    EXPECT_GT(r.report.paired_share, 0.8);
    EXPECT_EQ(r.report.self_intersections, 0U);
    EXPECT_EQ(r.control_points.size(), 4913U);
  }
}

TEST_F(CageRegistration, DenseSurfacesAreCarriedWholeByCoarserCopies) {
  const TriMesh target = noisy(moved(other(), 0.6), 0.05);
  RegistrationOptions options;
  options.depth = 3;
  options.most_points = static_cast<int>(source().points.size() / 2);
  const Registration r = register_cage(source(), target, options);
  ASSERT_EQ(r.surface.points.size(), source().points.size());
  EXPECT_EQ(r.surface.triangles, source().triangles);
  EXPECT_LE(vertex_error(source(), r.surface, 0.6).mean, 0.25);
  EXPECT_EQ(r.report.self_intersections, 0U);
  options.most_points = 99;
  EXPECT_THROW(register_cage(source(), target, options), InvalidInput);
}

TEST_F(CageRegistration, OfASurfaceOntoItselfIsRest) {
  RegistrationOptions options;
  options.depth = 3;
  const Registration r = register_cage(source(), source(), options);
  for (std::size_t i = 0; i < source().points.size(); ++i)
    ASSERT_NEAR((r.surface.points[i] - source().points[i]).norm(), 0.0, 1e-6);
  EXPECT_NEAR(r.report.least_jacobian, 1.0, 1e-6);
}

TEST_F(CageRegistration, ABranchThatOneSurfaceLacksDisturbsNothingElse) {
  geometry::Box3 all;
  for (const Vec3& p : source().points) all.extend(p);
  const geometry::Box3 end(all.max() - Vec3(0.25 * all.sizes().x(), 1e3, 1e3),
                           all.max() + Vec3::Constant(1.0));
  constexpr double amount = 0.4;
  const auto error_elsewhere = [&](const TriMesh& template_mesh, const Registration& r) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < template_mesh.points.size(); ++i) {
      const Vec3& p = template_mesh.points[i];
      if (p.x() > end.min().x() - 3.0) continue;
      sum += (r.surface.points[i] - beat(p, amount)).norm();
      ++count;
    }
    return sum / static_cast<double>(count);
  };
  const TriMesh cut_target = moved(without(other(), end), amount);
  const Registration lost = register_cage(source(), cut_target);
  EXPECT_LT(lost.report.paired_share, 0.95);
  EXPECT_LE(error_elsewhere(source(), lost), 0.25);
  EXPECT_GT(lost.report.least_jacobian, 0.0);
  const TriMesh cut_source = without(source(), end);
  EXPECT_LE(error_elsewhere(cut_source, register_cage(cut_source, moved(other(), amount))), 0.25);
}

// 40 mm at the farthest, and a branch of a seventh of the surface is lost: at first its points are paired
// with the branches beside, and cells are pressed flat there. Done once, all the tree ends 8 mm off.
TEST_F(CageRegistration, IsRepeatedWithMoreCareWhereItIsStuck) {
  geometry::Box3 lost;
  for (const Vec3& p : source().points) lost.extend(p);
  lost.min().y() = lost.max().y() - 0.3 * lost.sizes().y();
  constexpr double amount = 3.0;
  const Registration r = register_cage(source(), moved(without(other(), lost), amount));
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < source().points.size(); ++i) {
    if (lost.contains(source().points[i])) continue;
    sum += (r.surface.points[i] - beat(source().points[i], amount)).norm();
    count += 1.0;
  }
  EXPECT_LE(sum / count, 2.5);
  EXPECT_LE(r.report.mean_distance_mm, 0.3);
  EXPECT_GE(r.report.paired_share, 0.6);
  EXPECT_GT(r.report.least_jacobian, 0.0);
  EXPECT_LE(r.report.self_intersections, r.report.source_self_intersections);
}

TEST_F(CageRegistration, GoesOnFromANeighbouringPhase) {
  const Registration before = register_cage(source(), moved(other(), 0.4));
  RegistrationOptions options;
  options.start = before.control_points;
  const Registration r = register_cage(source(), moved(other(), 0.5), options);
  EXPECT_LE(vertex_error(source(), r.surface, 0.5).mean, 0.2);
  EXPECT_LE(r.report.rounds, register_cage(source(), moved(other(), 0.5)).report.rounds);
}

TEST_F(CageRegistration, DoesNotDependOnThreads) {
  RegistrationOptions options;
  options.depth = 3;
  const TriMesh target = moved(other(), 0.3);
  core::set_max_threads(1);
  const Registration one = register_cage(source(), target, options);
  core::set_max_threads(0);
  const Registration all = register_cage(source(), target, options);
  EXPECT_EQ(one.control_points, all.control_points);
}

// Triangles longer than cells: pairs of the target lie in cells without a point of the source.
TEST_F(CageRegistration, TakesTrianglesOfAnyLength) {
  const geometry::AnalyticShape tube = geometry::straight_tube(60.0, 3.0);
  const TriMesh coarse = geometry::structured_surface(tube.tubes[0], 6, 60.0);
  const TriMesh fine = geometry::structured_surface(tube.tubes[0], 24, 1.0);
  RegistrationOptions options;
  options.depth = 5;
  options.max_angle_deg = 60.0;
  const Registration r = register_cage(coarse, fine, options);
  EXPECT_GT(r.report.least_jacobian, 0.0);
  EXPECT_GT(r.report.paired_share, 0.5);
}

TEST_F(CageRegistration, RefusesAndCancels) {
  RegistrationOptions options;
  options.depth = 6;
  EXPECT_THROW(register_cage(source(), source(), options), InvalidInput);
  options = {};
  options.max_angle_deg = 0.0;
  EXPECT_THROW(register_cage(source(), source(), options), InvalidInput);
  options = {};
  options.energy.length = 0.0;
  EXPECT_THROW(register_cage(source(), source(), options), InvalidInput);
  options = {};
  options.start.resize(8);
  EXPECT_THROW(register_cage(source(), source(), options), InvalidInput);
  EXPECT_THROW(register_cage({}, source()), InvalidInput);
  EXPECT_THROW(register_cage(source(), {}), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(register_cage(source(), source(), {}, task), Cancelled);
}

/// A box of twelve triangles, 20 x 20 x 2 mm below z = 0, and a ball of 2 mm radius `gap` above it.
TriMesh ball_over_box(double gap) {
  TriMesh box;
  for (int c = 0; c < 8; ++c)
    box.points.emplace_back(c & 1 ? 10.0 : -10.0, c & 2 ? 10.0 : -10.0, c & 4 ? 0.0 : -2.0);
  box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const Vec3 centre(1.0, 0.5, 2.0 + gap);
  const geometry::Box3 about(centre - Vec3::Constant(2.5), centre + Vec3::Constant(2.5));
  return geometry::merged(
      box, geometry::isosurface([&](const Vec3& p) { return (p - centre).norm() - 2.0; }, about, 0.4));
}

// Cells that keep their sense keep smooth surfaces apart, but the box has corners alone: it does not give way
// to the ball, whose target lies in it. What is reported is of the surface that was taken back.
TEST_F(CageRegistration, TellsOfTheSurfaceThatItTookBackFromCrossing) {
  const TriMesh start = ball_over_box(0.5), target = ball_over_box(-0.7);
  ASSERT_TRUE(geometry::self_intersections(start).empty());
  ASSERT_FALSE(geometry::self_intersections(target).empty());
  const Registration r = register_cage(start, target);
  EXPECT_TRUE(geometry::self_intersections(r.surface).empty());
  EXPECT_EQ(r.report.self_intersections, 0U);
  double lowest = 10.0;
  for (std::size_t i = 8; i < r.surface.points.size(); ++i)
    lowest = std::min(lowest, r.surface.points[i].z());
  EXPECT_GT(lowest, 0.0);
  EXPECT_LT(lowest, 0.4);  // and it went as far as it could
  const geometry::AabbTree tree(target);
  double sum = 0.0, all = 0.0;
  for (const geometry::Triangle& t : r.surface.triangles) {
    const Vec3 a = r.surface.points[static_cast<std::size_t>(t[0])],
               b = r.surface.points[static_cast<std::size_t>(t[1])],
               c = r.surface.points[static_cast<std::size_t>(t[2])];
    const double area = 0.5 * (b - a).cross(c - a).norm();
    sum += area * (tree.closest(a).distance + tree.closest(b).distance + tree.closest(c).distance) / 3.0;
    all += area;
  }
  EXPECT_NEAR(r.report.mean_distance_mm, sum / all, 0.2 * sum / all);
}

}  // namespace
}  // namespace ostia::motion
