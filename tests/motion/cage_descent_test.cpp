#include "ostia/motion/cage_descent.h"

#include "moved_tree.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::motion {
namespace {

using geometry::TriMesh;
using geometry::Vec3;
using testing::moved;
using testing::target_distance;
using testing::vertex_error;

class CageDescent : public ::testing::Test {
 protected:
  static const TriMesh& source() {
    static const TriMesh mesh = geometry::surface_of(geometry::coronary_like_tree(), 0.8, false);
    return mesh;
  }
  /// The same tree in other triangles.
  static const TriMesh& other() {
    static const TriMesh mesh = geometry::surface_of(geometry::coronary_like_tree(), 0.85, false);
    return mesh;
  }
};

TEST_F(CageDescent, FollowsATreeThroughABeat) {
  constexpr double amount = 0.4;
  const TriMesh target = moved(other(), amount);
  const Registration r = register_cage_by_descent(source(), target);
  EXPECT_GT(target_distance(target, source()), 5.0 * target_distance(target, r.surface));
  EXPECT_LE(vertex_error(source(), r.surface, amount).mean, 0.5);
  EXPECT_GT(r.report.least_jacobian, 0.0);
  EXPECT_GT(r.report.paired_share, 0.8);
  EXPECT_EQ(r.report.rounds, 300);
  EXPECT_EQ(r.control_points.size(), 4913U);
}

TEST_F(CageDescent, OfASurfaceOntoItselfIsRest) {
  const Registration r = register_cage_by_descent(source(), source());
  for (std::size_t i = 0; i < source().points.size(); ++i)
    ASSERT_NEAR((r.surface.points[i] - source().points[i]).norm(), 0.0, 1e-9);
  EXPECT_NEAR(r.report.least_jacobian, 1.0, 1e-9);
}

// [Yi] figure 10: the target has lost a branch. With the energy the template keeps its shape better.
TEST_F(CageDescent, ItsEnergyHoldsABranchThatTheTargetLacks) {
  geometry::Box3 all;
  for (const Vec3& p : source().points) all.extend(p);
  const geometry::Box3 end(all.max() - Vec3(0.25 * all.sizes().x(), 1e3, 1e3),
                           all.max() + Vec3::Constant(1.0));
  constexpr double amount = 0.3;
  const TriMesh target = moved(testing::without(other(), end), amount);
  DescentOptions options;
  const Registration with = register_cage_by_descent(source(), target, options);
  options.with_energy = false;
  const Registration without = register_cage_by_descent(source(), target, options);
  EXPECT_GT(with.report.least_jacobian, 2.0 * without.report.least_jacobian);
  EXPECT_LT(vertex_error(source(), with.surface, amount).mean,
            0.9 * vertex_error(source(), without.surface, amount).mean);
}

// A target that has shrunk to a tenth: all would be pressed flat.
TEST_F(CageDescent, NoCellIsInvertedWithTheEnergyAndWithoutItIsTold) {
  TriMesh target = source();
  geometry::Box3 all;
  for (const Vec3& p : source().points) all.extend(p);
  for (Vec3& p : target.points) p = all.center() + 0.1 * (p - all.center());
  DescentOptions options;
  options.max_angle_deg = 180.0;
  options.depth = 3;
  options.iterations = 90;
  EXPECT_GE(register_cage_by_descent(source(), target, options).report.least_jacobian, 0.02);
  options.with_energy = false;
  EXPECT_LT(register_cage_by_descent(source(), target, options).report.least_jacobian, 0.0);
}

TEST_F(CageDescent, SharesItsIterationsAmongTheDepths) {
  DescentOptions options;
  options.depth = 3;
  options.iterations = 20;
  const Registration r = register_cage_by_descent(source(), moved(other(), 0.2), options);
  EXPECT_EQ(r.report.rounds, 18);
  EXPECT_EQ(r.grid.cells, 8);
}

TEST_F(CageDescent, DoesNotDependOnThreads) {
  DescentOptions options;
  options.iterations = 40;
  const TriMesh target = moved(other(), 0.3);
  core::set_max_threads(1);
  const Registration one = register_cage_by_descent(source(), target, options);
  core::set_max_threads(2);
  const Registration two = register_cage_by_descent(source(), target, options);
  core::set_max_threads(0);
  EXPECT_EQ(one.control_points, two.control_points);
}

TEST_F(CageDescent, RefusesAndCancels) {
  const auto refused = [](auto change) {
    DescentOptions options;
    change(options);
    EXPECT_THROW(register_cage_by_descent(source(), source(), options), InvalidInput);
  };
  refused([](DescentOptions& o) { o.depth = 6; });
  refused([](DescentOptions& o) { o.margin = 0.0; });
  refused([](DescentOptions& o) { o.max_angle_deg = 0.0; });
  refused([](DescentOptions& o) { o.energy.length = 0.0; });
  refused([](DescentOptions& o) { o.energy.volume = std::nan(""); });
  refused([](DescentOptions& o) { o.iterations = 3; });
  EXPECT_THROW(register_cage_by_descent({}, source()), InvalidInput);
  EXPECT_THROW(register_cage_by_descent(source(), {}), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(register_cage_by_descent(source(), source(), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::motion
