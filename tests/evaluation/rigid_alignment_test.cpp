#include "ostia/evaluation/rigid_alignment.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

geometry::TriMesh rigid_alignment_fork() {
  return geometry::surface_of(geometry::y_junction(15.0, 15.0, 2.0, 1.5, 70.0), 0.5, false);
}

geometry::RigidFit small_motion() {
  geometry::RigidFit motion;
  motion.rotation =
      (Eigen::AngleAxisd(0.05, Vec3::UnitX()) * Eigen::AngleAxisd(-0.04, Vec3::UnitZ())).toRotationMatrix();
  motion.shift = Vec3(0.6, -0.4, 0.5);
  return motion;
}

TEST(RigidAlignment, FindsTheMotionBack) {
  const geometry::TriMesh mesh = rigid_alignment_fork();
  const geometry::RigidFit moved = small_motion();
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.points) points.push_back(moved(p));
  const RigidAlignment found = align_to(geometry::AabbTree(mesh), points);
  EXPECT_TRUE(found.converged);
  EXPECT_GT(found.rms_before_mm, 0.2);
  EXPECT_LT(found.rms_mm, 1e-6);
  for (std::size_t i = 0; i < points.size(); i += 50)
    EXPECT_LT((found.motion(points[i]) - mesh.points[i]).norm(), 1e-5);
  EXPECT_NEAR(angle_deg(found.motion), angle_deg(moved), 1e-4);
}

TEST(RigidAlignment, LeavesWhatNoMotionMends) {
  const geometry::TriMesh mesh = rigid_alignment_fork();
  const RigidAlignment still = align_to(geometry::AabbTree(mesh), mesh.points);
  EXPECT_TRUE(still.converged);
  EXPECT_LT(angle_deg(still.motion), 1e-6);
  EXPECT_LT(still.motion.shift.norm(), 1e-9);
}

TEST(RigidAlignment, NeverMakesTheDistanceLarger) {
  const geometry::TriMesh mesh = rigid_alignment_fork();
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.points) points.push_back(1.3 * p + Vec3(4.0, 2.0, -3.0));
  const RigidAlignment found = align_to(geometry::AabbTree(mesh), points);
  EXPECT_LT(found.rms_mm, found.rms_before_mm);
  EXPECT_NEAR(found.motion.rotation.determinant(), 1.0, 1e-9);
}

TEST(RigidAlignment, RefusesWhatHasNoMotion) {
  const geometry::AabbTree surface(rigid_alignment_fork());
  EXPECT_THROW(align_to(surface, std::vector<Vec3>(5, Vec3::Zero())), InvalidInput);
  EXPECT_THROW(align_to(surface, std::vector<Vec3>(9, Vec3::Constant(NAN))), InvalidInput);
  AlignmentOptions options;
  options.iterations_max = 0;
  EXPECT_THROW(align_to(surface, std::vector<Vec3>(9, Vec3::Zero()), options), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
