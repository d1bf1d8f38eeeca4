// Pulsating and shifted spheres and tubes whose motion is known.

#include "ostia/evaluation/surface_motion.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::evaluation {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

using std::numbers::pi;
constexpr double r0 = 5.0, amplitude_mm = 1.0;
constexpr int phase_count = 10;

TriMesh beating_ball(double radius_mm) {
  const auto f = [=](const Vec3& p) { return p.norm() - radius_mm; };
  const Vec3 far = Vec3::Constant(radius_mm + 0.5);
  TriMesh mesh = geometry::isosurface(f, geometry::Box3(-far, far), 0.3);
  for (Vec3& p : mesh.points) p *= radius_mm / p.norm();
  return mesh;
}

double radius_at(int phase) {
  return r0 - amplitude_mm * 0.5 * (1.0 - std::cos(2.0 * pi * phase / phase_count));
}

/// The same triangles in every phase, radius r(t) + offset.
SurfaceMotion pulsating(double offset_mm = 0.0) {
  const TriMesh unit = beating_ball(1.0 * r0);
  SurfaceMotion motion;
  for (int k = 0; k < phase_count; ++k) {
    motion.names.push_back("phase" + std::to_string(k));
    motion.phases.push_back(unit);
    for (Vec3& p : motion.phases.back().points) p *= (radius_at(k) + offset_mm) / r0;
  }
  return motion;
}

TEST(SurfaceMotion, APulsatingBallAgainstItself) {
  const SurfaceMotionError e = compare_surface_motion(pulsating(), pulsating());
  ASSERT_EQ(e.phases.size(), 10u);
  EXPECT_TRUE(e.corresponding);
  EXPECT_NEAR(e.msd_mm, 0.0, 1e-9);
  EXPECT_NEAR(e.dice, 1.0, 1e-9);
  EXPECT_NEAR(e.displacement_mm, 0.0, 1e-12);
  EXPECT_NEAR(e.reference.path_mm, 2.0 * amplitude_mm, 1e-9) << "in and out again";
  EXPECT_NEAR(e.reference.amplitude_mm, amplitude_mm, 1e-9);
  const double closing = 0.5 * (1.0 - std::cos(2.0 * pi / phase_count));
  const double largest = 0.5 * (std::cos(2.0 * pi * 2 / phase_count) - std::cos(2.0 * pi * 3 / phase_count));
  EXPECT_NEAR(e.reference.closing_ratio, closing / largest, 1e-9);
}

TEST(SurfaceMotion, AResultThatIsTooWide) {
  const double d = 0.25;
  const SurfaceMotionError e = compare_surface_motion(pulsating(), pulsating(d));
  EXPECT_NEAR(e.msd_mm, d, 0.01 * d) << "triangles of 0.3 mm";
  EXPECT_NEAR(e.displacement_mm, d, 1e-9);
  EXPECT_NEAR(e.path_difference_mm, 0.0, 1e-9);
  for (int k = 0; k < phase_count; ++k) {
    const auto& phase = e.phases[static_cast<std::size_t>(k)];
    const double a = std::pow(radius_at(k), 3), b = std::pow(radius_at(k) + d, 3);
    EXPECT_NEAR(phase.dice, 2.0 * a / (a + b), 2e-3) << k;
    EXPECT_NEAR(phase.max_displacement_mm, d, 1e-9);
  }
}

TEST(SurfaceMotion, OtherTrianglesAreComparedByClosestPoints) {
  SurfaceMotion remeshed = pulsating();
  for (int k = 0; k < phase_count; ++k)
    remeshed.phases[static_cast<std::size_t>(k)] = beating_ball(radius_at(k) + 0.25);
  const SurfaceMotionError e = compare_surface_motion(pulsating(), remeshed);
  EXPECT_FALSE(e.corresponding);
  EXPECT_NEAR(e.msd_mm, 0.25, 0.0075) << "two triangulations of 0.3 mm";
  EXPECT_GT(e.dice, 0.9);
  EXPECT_TRUE(std::isnan(e.displacement_mm));
  EXPECT_TRUE(std::isnan(e.result.path_mm));
  EXPECT_NEAR(e.reference.path_mm, 2.0, 1e-9);
}

/// Points that slide along their surface: no distance between the surfaces, but the points are off.
TEST(SurfaceMotion, PointsThatSlideAreSeenByTheirDisplacement) {
  SurfaceMotion open;
  const TriMesh tube =
      geometry::structured_surface(geometry::straight_tube(20.0, 1.5).tubes.front(), 64, 0.5);
  for (const char* name : {"a", "b"}) {
    open.names.push_back(name);
    open.phases.push_back(tube);
  }
  SurfaceMotion turned = open;
  const double step = 2.0 * pi / 64;
  for (Vec3& p : turned.phases[1].points)
    p = Vec3(std::cos(step) * p.x() - std::sin(step) * p.y(), std::sin(step) * p.x() + std::cos(step) * p.y(),
             p.z());
  const SurfaceMotionError e = compare_surface_motion(open, turned);
  EXPECT_NEAR(e.phases[1].msd_mm, 0.0, 2e-3);
  EXPECT_NEAR(e.phases[1].displacement_mm, 2.0 * 1.5 * std::sin(0.5 * step), 1e-9);
  EXPECT_TRUE(std::isnan(e.dice)) << "open at its ends";
}

TEST(SurfaceMotion, ACycleThatIsCutDoesNotClose) {
  SurfaceMotion cut = pulsating();
  cut.names.resize(5);
  cut.phases.resize(5);
  const SurfaceMotionError e = compare_surface_motion(cut, cut);
  EXPECT_GT(e.reference.closing_ratio, 2.5);
}

TEST(SurfaceMotion, AMissingPhaseIsNamed) {
  SurfaceMotion lacking = pulsating();
  lacking.names.erase(lacking.names.begin() + 4);
  lacking.phases.erase(lacking.phases.begin() + 4);
  try {
    compare_surface_motion(pulsating(), lacking);
    ADD_FAILURE() << "taken";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("phase4"), std::string::npos) << error.what();
  }
  EXPECT_THROW(compare_surface_motion(lacking, pulsating()), InvalidInput) << "too many";
  SurfaceMotion empty = pulsating();
  empty.phases[3] = {};
  EXPECT_THROW(compare_surface_motion(pulsating(), empty), InvalidInput);
  SurfaceMotion single = pulsating();
  single.names.resize(1);
  single.phases.resize(1);
  EXPECT_THROW(compare_surface_motion(single, single), InvalidInput);
}

TEST(SurfaceMotion, NamesAreSortedAsPeopleCount) {
  EXPECT_TRUE(natural_less("phase2", "phase10"));
  EXPECT_FALSE(natural_less("phase10", "phase2"));
  EXPECT_TRUE(natural_less("phase_09", "phase_10"));
  EXPECT_TRUE(natural_less("a", "a1"));
  EXPECT_FALSE(natural_less("a1", "a1"));
}

}  // namespace
}  // namespace ostia::evaluation
