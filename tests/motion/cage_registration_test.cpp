#include "ostia/motion/cage_registration.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/analytic_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::motion {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

/// As the heart's wall moves: shorter, thinner, turned about its long axis more towards the apex, shifted.
/// `amount` 1 is about 12 mm at the farthest.
Vec3 beat(const Vec3& p, double amount) {
  const Vec3 centre(20.0, 10.0, 30.0);
  Vec3 q = p - centre;
  const double turn = amount * 0.2 * (1.0 + q.z() / 40.0);
  q = Eigen::AngleAxisd(turn, Vec3::UnitZ()) * q;
  q.x() *= 1.0 - 0.12 * amount;
  q.y() *= 1.0 - 0.12 * amount;
  q.z() *= 1.0 - 0.15 * amount;
  return centre + q + amount * Vec3(2.0 * std::sin(q.z() / 25.0), 3.0, 4.0);
}

TriMesh moved(TriMesh mesh, double amount) {
  for (Vec3& p : mesh.points) p = beat(p, amount);
  return mesh;
}

TriMesh noisy(TriMesh mesh, double mm) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, mm);
  for (Vec3& p : mesh.points) p += Vec3(noise(random), noise(random), noise(random));
  return mesh;
}

struct Error {
  double mean = 0.0, worst = 0.0;
};
Error vertex_error(const TriMesh& template_mesh, const TriMesh& result, double amount) {
  Error e;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const double off = (result.points[i] - beat(template_mesh.points[i], amount)).norm();
    e.mean += off / static_cast<double>(result.points.size());
    e.worst = std::max(e.worst, off);
  }
  return e;
}

/// Mean distance from the target to the result, as in [Yi] 5.1.
double target_distance(const TriMesh& target, const TriMesh& result) {
  const geometry::AabbTree tree(result);
  double sum = 0.0;
  for (const Vec3& p : target.points) sum += tree.closest(p).distance;
  return sum / static_cast<double>(target.points.size());
}

/// Without the triangles of a place: a segmentation that lost a branch there.
TriMesh without(const TriMesh& mesh, const geometry::Box3& place) {
  TriMesh out{mesh.points, {}};
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  out.points.clear();
  for (const geometry::Triangle& t : mesh.triangles) {
    if (place.contains(mesh.points[static_cast<std::size_t>(t[0])])) continue;
    geometry::Triangle kept{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::int32_t& n = number[static_cast<std::size_t>(t[i])];
      if (n < 0) {
        n = static_cast<std::int32_t>(out.points.size());
        out.points.push_back(mesh.points[static_cast<std::size_t>(t[i])]);
      }
      kept[i] = n;
    }
    out.triangles.push_back(kept);
  }
  return out;
}

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

}  // namespace
}  // namespace ostia::motion
