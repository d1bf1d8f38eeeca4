#include "ostia/segmentation/outer_wall.h"

#include "scanned_scene.h"

#include "ostia/core/error.h"
#include "ostia/geometry/axis_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::segmentation {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using testing::scan;
using testing::Scene;
using testing::Shot;

using std::numbers::pi;
constexpr double outer_wall_lumen_hu = 380.0, outer_wall_wall_hu = 45.0, outer_wall_fat_hu = -90.0,
                 muscle_hu = 105.0;
constexpr double first_mm = 0.45;  // of the axis in the scene

using Radius = std::function<double(double s, double theta)>;

/// The exact lumen about the scene's axis.
LumenBoundary lumen_of(const geometry::AxisCurve& axis, const Radius& radius) {
  LumenBoundary out;
  const int rows = 1 + static_cast<int>(axis.length() / 0.5);
  out.step_mm = axis.length() / (rows - 1);
  out.around = 32;
  for (int r = 0; r < rows; ++r)
    for (int a = 0; a < out.around; ++a)
      out.radius_mm.push_back(radius(r * out.step_mm + first_mm, -2.0 * pi * a / out.around));
  out.confidence.assign(out.radius_mm.size(), 1.0F);
  return out;
}

OuterWall find(const Shot& shot, const Radius& lumen, const OuterWallOptions& options = {}) {
  const geometry::AxisCurve axis(shot.line);
  return outer_wall(shot.image, axis, lumen_of(axis, lumen), options);
}

struct OuterWallDeviation {
  double mean = 0.0, absolute = 0.0, largest = 0.0;
};
OuterWallDeviation deviation(
    const OuterWall& found, const Radius& radius,
    const std::function<bool(double theta)>& counts = [](double) { return true; }) {
  OuterWallDeviation out;
  int count = 0;
  const LumenBoundary& surface = found.surface;
  for (int row = 0; row < surface.rows(); ++row) {
    const double s = row * surface.step_mm;
    if (s < 1.5 || s > 13.5) continue;
    for (int a = 0; a < surface.around; ++a) {
      const double theta = std::remainder(-2.0 * pi * a / surface.around, 2.0 * pi);
      if (!counts(theta)) continue;
      const double off =
          surface.radius_mm[static_cast<std::size_t>(row) * surface.around + a] - radius(s + first_mm, theta);
      out.mean += off;
      out.absolute += std::abs(off);
      out.largest = std::max(out.largest, std::abs(off));
      ++count;
    }
  }
  out.mean /= count;
  out.absolute /= count;
  return out;
}

Radius constant(double mm) {
  return [mm](double, double) { return mm; };
}

/// A round lumen in a round wall of one tissue, fat beyond.
Scene tube(double radius, double outer, double tissue_hu = outer_wall_wall_hu) {
  return [=](const Vec3& p) {
    const double rho = p.head<2>().norm();
    return rho < radius ? outer_wall_lumen_hu : rho < outer ? tissue_hu : outer_wall_fat_hu;
  };
}

class HealthyWall : public ::testing::TestWithParam<double> {};

TEST_P(HealthyWall, IsFoundThinnerThanTheBlur) {
  const double thickness = GetParam(), radius = 1.4;
  const OuterWall found = find(scan(tube(radius, radius + thickness), 25.0), constant(radius));
  const OuterWallDeviation off = deviation(found, constant(radius + thickness));
  EXPECT_LT(std::abs(off.mean), 0.10);
  EXPECT_LT(off.absolute, 0.12);
  EXPECT_GT(found.seen_share, 0.95);
  EXPECT_TRUE(found.surface.warnings.empty());
  EXPECT_NEAR(found.fat_hu[found.fat_hu.size() / 2], outer_wall_fat_hu, 20.0);
  EXPECT_NEAR(found.lumen_hu[found.lumen_hu.size() / 2], outer_wall_lumen_hu, 20.0);
}
INSTANTIATE_TEST_SUITE_P(Thickness, HealthyWall, ::testing::Values(0.3, 0.5, 0.8));

struct Tissue {
  double hu = 0.0, thickness_mm = 0.0;
};
class ThickPlaque : public ::testing::TestWithParam<Tissue> {};

TEST_P(ThickPlaque, OuterBorderHasLittleBias) {
  const Tissue plaque = GetParam();
  const double radius = 1.1, outer = radius + plaque.thickness_mm;
  const OuterWall found = find(scan(tube(radius, outer, plaque.hu), 25.0), constant(radius));
  const OuterWallDeviation off = deviation(found, constant(outer));
  EXPECT_LT(std::abs(off.mean), 0.08);
  EXPECT_LT(off.absolute, 0.10);
}
INSTANTIATE_TEST_SUITE_P(Tissues, ThickPlaque,
                         ::testing::Values(Tissue{25.0, 1.0}, Tissue{50.0, 1.5}, Tissue{100.0, 1.2},
                                           Tissue{100.0, 2.0}));

TEST(OuterWall, EccentricPlaque) {
  // The lumen lies 0.6 mm beside the middle of a round vessel.
  const double radius = 1.0, outer = 1.9, off_mm = 0.6;
  const Scene scene = [=](const Vec3& p) {
    const double rho = p.head<2>().norm();
    return rho < radius                                       ? outer_wall_lumen_hu
           : (p.head<2>() - Vec2(off_mm, 0.0)).norm() < outer ? 70.0
                                                              : outer_wall_fat_hu;
  };
  const Radius truth = [=](double, double theta) {
    const double across = off_mm * std::sin(theta);
    return off_mm * std::cos(theta) + std::sqrt(outer * outer - across * across);
  };
  const OuterWallDeviation off = deviation(find(scan(scene, 25.0), constant(radius)), truth);
  EXPECT_LT(off.absolute, 0.12);
  EXPECT_LT(std::abs(off.mean), 0.08);
}

TEST(OuterWall, CalciumStaysInside) {
  // A crescent of calcium in the plaque, which outshines the lumen.
  const double radius = 1.2, outer = 2.2;
  const Scene scene = [=](const Vec3& p) {
    const double rho = p.head<2>().norm(), theta = std::atan2(p.y(), p.x());
    if (rho < radius) return outer_wall_lumen_hu;
    if (rho > outer) return outer_wall_fat_hu;
    return std::abs(theta) < 0.7 && rho > 1.5 && rho < 2.0 ? 900.0 : 70.0;
  };
  const OuterWallDeviation off = deviation(find(scan(scene, 25.0), constant(radius)), constant(outer));
  EXPECT_LT(off.absolute, 0.12);
  EXPECT_LT(off.largest, 0.45);
}

TEST(OuterWall, MuscleIsBridgedAndSaidToBe) {
  // Muscle touches the wall over 100 degrees.
  const double radius = 1.4, outer = 1.9;
  const auto in_muscle = [](double theta) { return std::abs(std::remainder(theta, 2.0 * pi)) < 0.87; };
  const Scene scene = [=](const Vec3& p) {
    const double rho = p.head<2>().norm();
    if (rho < radius) return outer_wall_lumen_hu;
    if (rho < outer) return outer_wall_wall_hu;
    return in_muscle(std::atan2(p.y(), p.x())) ? muscle_hu : outer_wall_fat_hu;
  };
  const OuterWall found = find(scan(scene, 25.0), constant(radius));
  EXPECT_LT(deviation(found, constant(outer), [&](double t) { return !in_muscle(t); }).absolute, 0.12);
  EXPECT_LT(deviation(found, constant(outer), in_muscle).absolute, 0.25);
  EXPECT_NEAR(found.seen_share, 1.0 - 0.87 / pi, 0.10);
  const LumenBoundary& surface = found.surface;
  const std::size_t ring = static_cast<std::size_t>(surface.rows() / 2) * surface.around;
  EXPECT_EQ(surface.confidence[ring], 0.0F);                       // theta = 0 looks into the muscle
  EXPECT_GT(surface.confidence[ring + surface.around / 2], 0.2F);  // and pi into the fat
}

TEST(OuterWall, NoFatAnywhereIsABridgeWithAWarning) {
  const double radius = 1.4;
  const Scene scene = [=](const Vec3& p) {
    return p.head<2>().norm() < radius ? outer_wall_lumen_hu : muscle_hu;
  };
  const OuterWall found = find(scan(scene, 25.0), constant(radius));
  EXPECT_LT(found.seen_share, 0.05);
  ASSERT_FALSE(found.surface.warnings.empty());
  EXPECT_NE(found.surface.warnings.front().find("bridge"), std::string::npos);
  const OuterWallDeviation off = deviation(found, constant(radius + 0.4));
  EXPECT_LT(off.largest, 0.5);  // it stays a wall
}

TEST(OuterWall, NeverWithinTheLumenWhateverIsAsked) {
  // A lumen that is given far too wide: the fat begins inside it.
  const OuterWall found = find(scan(tube(1.0, 1.3), 25.0), constant(1.8));
  for (const double radius : found.surface.radius_mm) EXPECT_GE(radius, 1.8 + 0.1 - 1e-9);
}

TEST(OuterWall, TheSameBitsTwice) {
  const Shot shot = scan(tube(1.2, 1.8), 25.0);
  EXPECT_EQ(find(shot, constant(1.2)).surface.radius_mm, find(shot, constant(1.2)).surface.radius_mm);
}

TEST(OuterWall, RefusesWhatMakesNoSense) {
  const Shot shot = scan(tube(1.2, 1.8));
  const geometry::AxisCurve axis(shot.line);
  const LumenBoundary lumen = lumen_of(axis, constant(1.2));
  EXPECT_THROW(outer_wall(imaging::ImageVolume{}, axis, lumen), InvalidInput);
  EXPECT_THROW(outer_wall(shot.image, axis, LumenBoundary{}), InvalidInput);
  LumenBoundary beyond = lumen;
  beyond.from_mm = 5.0;
  EXPECT_THROW(outer_wall(shot.image, axis, beyond), InvalidInput);
  LumenBoundary broken = lumen;
  broken.radius_mm[7] = std::nan("");
  EXPECT_THROW(outer_wall(shot.image, axis, broken), InvalidInput);
  OuterWallOptions options;
  options.largest_thickness_mm = 0.1;
  EXPECT_THROW(outer_wall(shot.image, axis, lumen, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::segmentation
