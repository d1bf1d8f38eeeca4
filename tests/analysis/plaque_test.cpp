#include "ostia/analysis/plaque.h"

#include "ostia/core/error.h"
#include "ostia/geometry/axis_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace ostia::analysis {
namespace {

using geometry::Vec2;

using std::numbers::pi;

/// Along +z from the origin; theta = 0 is +x.
geometry::AxisCurve straight(double length_mm) {
  geometry::Centerline line;
  for (double z = 0.0; z <= length_mm + 1e-9; z += 0.5) line.points.emplace_back(0.0, 0.0, z);
  geometry::complete(line, Vec3::UnitX());
  return geometry::AxisCurve(line);
}

WallRadii round_walls(double length_mm, double lumen, double outer) {
  WallRadii walls;
  walls.to_mm = length_mm;
  walls.lumen_mm = [lumen](double, double) { return lumen; };
  walls.outer_mm = [outer](double, double) { return outer; };
  return walls;
}

PlaqueOptions sharp() {
  PlaqueOptions options;
  options.blur_sigma_mm = 0.0;
  return options;
}

double within_percent(double value, double truth) {
  return 100.0 * std::abs(value - truth) / truth;
}

TEST(Plaque, VolumesOfAStraightTubeAreExact) {
  const geometry::AxisCurve axis = straight(20.0);
  const auto tissue = [](const Vec3& p) {
    return p.z() < 5.0 ? 10.0 : p.z() < 10.0 ? 90.0 : p.z() < 15.0 ? 200.0 : 800.0;
  };
  const PlaqueProfile profile = plaque_profile(axis, round_walls(20.0, 1.0, 2.0), tissue, sharp());
  const PlaqueVolumes all = plaque_between(profile, 0.0, 20.0);
  EXPECT_NEAR(all.length_mm, 20.0, 1e-9);
  EXPECT_LT(within_percent(all.lumen_mm3, pi * 20.0), 1e-6);
  EXPECT_LT(within_percent(all.vessel_mm3, 4.0 * pi * 20.0), 1e-6);
  EXPECT_LT(within_percent(all.plaque_mm3(), 3.0 * pi * 20.0), 1e-6);
  EXPECT_NEAR(all.burden_percent(), 75.0, 1e-6);
  for (std::size_t n = 0; n < plaque_classes; ++n)
    EXPECT_LT(within_percent(all.class_mm3[n], 3.0 * pi * 5.0), 1e-6) << n;
  EXPECT_EQ(all.thin_wall_mm3, 0.0);
  EXPECT_NEAR(profile.slabs[3].area_burden_percent(), 75.0, 1e-6);
}

TEST(Plaque, ClassesFollowTheirBounds) {
  const geometry::AxisCurve axis = straight(2.0);
  const auto class_at = [&](double hu, const PlaqueOptions& options) {
    const PlaqueVolumes all =
        plaque_between(plaque_profile(
                           axis, round_walls(2.0, 1.0, 2.0), [hu](const Vec3&) { return hu; }, options),
                       0.0, 2.0);
    for (std::size_t n = 0; n < plaque_classes; ++n)
      if (all.class_mm3[n] > 0.0) return static_cast<PlaqueClass>(n);
    throw InvalidInput("no plaque");
  };
  EXPECT_EQ(class_at(29.9, sharp()), PlaqueClass::low_attenuation);
  EXPECT_EQ(class_at(30.0, sharp()), PlaqueClass::fibrofatty);
  EXPECT_EQ(class_at(130.0, sharp()), PlaqueClass::fibrofatty);
  EXPECT_EQ(class_at(131.0, sharp()), PlaqueClass::fibrous);
  EXPECT_EQ(class_at(350.0, sharp()), PlaqueClass::fibrous);
  EXPECT_EQ(class_at(351.0, sharp()), PlaqueClass::calcified);
  PlaqueOptions other = sharp();
  other.low_attenuation_hu = 60.0;
  EXPECT_EQ(class_at(45.0, other), PlaqueClass::low_attenuation);
}

/// A round lumen beside the middle of a round vessel, with a body of calcium: a disc across all the length.
TEST(Plaque, EccentricPlaqueWithinOnePercent) {
  const double length = 10.0, lumen = 0.9, outer = 2.0, off = 0.7, body = 0.3;
  const Vec2 body_at(1.9, 0.4);
  const geometry::AxisCurve axis = straight(length);
  WallRadii walls = round_walls(length, lumen, outer);
  walls.outer_mm = [=](double, double theta) {
    const double across = off * std::sin(theta);
    return off * std::cos(theta) + std::sqrt(outer * outer - across * across);
  };
  const auto tissue = [=](const Vec3& p) { return (p.head<2>() - body_at).norm() < body ? 900.0 : 60.0; };
  PlaqueOptions options = sharp();
  options.thin_wall_mm = 0.0;
  const double calcium = pi * body * body * length, all = pi * (outer * outer - lumen * lumen) * length;
  const auto measured = [&] {
    return plaque_between(plaque_profile(axis, walls, tissue, options), 0.0, length);
  };
  PlaqueVolumes found = measured();
  EXPECT_LT(within_percent(found.vessel_mm3, pi * outer * outer * length), 0.01);
  EXPECT_LT(within_percent(found.plaque_mm3(), all), 0.01);
  EXPECT_LT(within_percent(found.of(PlaqueClass::fibrofatty), all - calcium), 1.0);
  EXPECT_LT(within_percent(found.of(PlaqueClass::calcified), calcium), 5.0);
  // Finer pieces: the body of 0.3 mm, too.
  options.around = 384;
  options.deep = 64;
  found = measured();
  EXPECT_LT(within_percent(found.of(PlaqueClass::calcified), calcium), 1.0);
}

TEST(Plaque, BentVesselsCountTheirTrueVolume) {
  // A quarter of a torus: Pappus' theorem for an off-centre tube.
  const double bend = 8.0, lumen = 1.0, outer = 2.0;
  geometry::Centerline line;
  for (int n = 0; n <= 60; ++n) {
    const double t = 0.5 * pi * n / 60.0;
    line.points.emplace_back(bend * std::cos(t), bend * std::sin(t), 0.0);
  }
  geometry::complete(line, Vec3::UnitZ());
  const geometry::AxisCurve axis(line);
  WallRadii walls = round_walls(axis.length(), lumen, outer);
  const auto inside = [&](const Vec3& p) { return p.head<2>().norm() < bend ? 90.0 : 10.0; };
  const PlaqueVolumes all = plaque_between(plaque_profile(axis, walls, inside, sharp()), 0.0, axis.length());
  EXPECT_LT(within_percent(all.lumen_mm3, pi * lumen * lumen * 0.5 * pi * bend), 0.3);
  EXPECT_LT(within_percent(all.vessel_mm3, pi * outer * outer * 0.5 * pi * bend), 0.3);
  // The inner half of a disc of radius R has its centroid 4 R / (3 pi) nearer to the bend's centre.
  const auto half = [&](double r) { return 0.5 * pi * r * r * 0.5 * pi * (bend - 4.0 * r / (3.0 * pi)); };
  EXPECT_LT(within_percent(all.of(PlaqueClass::fibrofatty), half(outer) - half(lumen)), 1.0);
}

TEST(Plaque, ThinWallsAreInNoClass) {
  const geometry::AxisCurve axis = straight(10.0);
  WallRadii walls = round_walls(10.0, 1.0, 1.5);
  walls.outer_mm = [](double, double theta) { return std::cos(theta) > 0.0 ? 2.0 : 1.5; };
  const PlaqueVolumes all = plaque_between(plaque_profile(
                                               axis, walls, [](const Vec3&) { return 50.0; }, sharp()),
                                           0.0, 10.0);
  EXPECT_LT(within_percent(all.plaque_mm3(), 0.5 * pi * 3.0 * 10.0), 1e-6);
  EXPECT_LT(within_percent(all.thin_wall_mm3, 0.5 * pi * 1.25 * 10.0), 1e-6);
  EXPECT_NEAR(all.wall_mm3(), all.plaque_mm3() + all.thin_wall_mm3, 1e-9);
}

TEST(Plaque, AMapShowsWhereWhichClassIs) {
  const geometry::AxisCurve axis = straight(10.0);
  WallRadii walls = round_walls(10.0, 1.0, 2.0);
  walls.outer_mm = [](double, double theta) { return std::cos(theta) > 0.0 ? 2.0 : 1.5; };
  const auto tissue = [](const Vec3& p) { return p.head<2>().norm() < 1.5 ? 50.0 : 500.0; };
  const PlaqueMap map = plaque_map(axis, walls, 5.0, tissue, sharp());
  EXPECT_EQ(map.at(0.0, 1.2), PlaqueClass::fibrofatty);
  EXPECT_EQ(map.at(-0.7, 1.9), PlaqueClass::calcified);
  EXPECT_EQ(map.at(2.0 * pi + 0.7, 1.9), PlaqueClass::calcified);
  EXPECT_FALSE(map.at(0.0, 0.9) || map.at(0.0, 2.1));  // lumen, fat
  EXPECT_FALSE(map.at(pi, 1.2));                       // thin
}

TEST(Plaque, StretchesAddUp) {
  const geometry::AxisCurve axis = straight(10.0);
  WallRadii walls = round_walls(10.0, 1.0, 2.0);
  walls.outer_mm = [](double s, double) { return 1.8 + 0.02 * s; };
  const PlaqueProfile profile = plaque_profile(
      axis, walls, [](const Vec3&) { return 50.0; }, sharp());
  const double all = plaque_between(profile, 0.0, 10.0).plaque_mm3();
  const double parts = plaque_between(profile, -3.0, 3.37).plaque_mm3() +
                       plaque_between(profile, 3.37, 3.41).plaque_mm3() +
                       plaque_between(profile, 3.41, 30.0).plaque_mm3();
  EXPECT_NEAR(parts, all, 1e-9);
  EXPECT_EQ(plaque_between(profile, 11.0, 12.0).length_mm, 0.0);
  EXPECT_EQ(plaque_between(profile, 11.0, 12.0).burden_percent(), 0.0);
}

TEST(Plaque, AHealthyWallIsNoneWhateverItsCalibre) {
  const geometry::AxisCurve axis = straight(10.0);
  const auto burden = [&](double diameter, double wall) {
    WallRadii walls = round_walls(10.0, 0.5 * diameter, 0.5 * diameter + wall);
    walls.calibre_mm = [diameter](double) { return diameter; };
    return plaque_between(plaque_profile(
                              axis, walls, [](const Vec3&) { return 50.0; }, sharp()),
                          0.0, 10.0)
        .burden_percent();
  };
  for (const double diameter : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
    const double healthy = healthy_wall_mm(diameter);
    EXPECT_EQ(burden(diameter, healthy), 0.0) << diameter;
    EXPECT_EQ(burden(diameter, healthy + 0.15), 0.0) << diameter;
    const double ill = healthy + 0.6, outer = 0.5 * diameter + ill;
    EXPECT_NEAR(burden(diameter, ill), 100.0 * (1.0 - std::pow(0.5 * diameter / outer, 2)), 1e-6) << diameter;
  }
  // A wall of 0.8 mm: a healthy left main's, and a diseased small branch's.
  EXPECT_EQ(burden(5.0, 0.8), 0.0);
  EXPECT_GT(burden(2.0, 0.8), 50.0);
}

TEST(Plaque, HalfAWallCountsHalf) {
  const geometry::AxisCurve axis = straight(10.0);
  WallRadii walls = round_walls(10.0, 1.5, 1.9);
  walls.outer_mm = [](double, double theta) { return theta < pi ? 2.9 : 1.9; };
  walls.calibre_mm = [](double) { return 3.0; };
  const PlaqueVolumes all = plaque_between(plaque_profile(
                                               axis, walls, [](const Vec3&) { return 50.0; }, sharp()),
                                           0.0, 10.0);
  const double plaque = 0.5 * (2.9 * 2.9 - 2.25), vessel = 0.5 * (2.9 * 2.9 + 1.9 * 1.9);
  EXPECT_NEAR(all.burden_percent(), 100.0 * plaque / vessel, 1e-6);
  EXPECT_NEAR(all.wall_percent(), 100.0 * (1.0 - 2.25 / vessel), 1e-6);
  EXPECT_NEAR(all.thin_wall_mm3, 10.0 * pi * 0.5 * (1.9 * 1.9 - 2.25), 1e-6);
}

TEST(Plaque, TheHealthyWallFollowsWhatWasMeasuredInHealthyHearts) {
  // The ends of Podesser's line: 0.08 mm at 0.1 mm of outer radius, 0.8 mm at 3 mm.
  EXPECT_NEAR(healthy_wall_mm(2.0 * (0.1 - 0.08)), 0.08, 1e-9);
  EXPECT_NEAR(healthy_wall_mm(2.0 * (3.0 - 0.8)), 0.8, 1e-9);
  EXPECT_THROW(healthy_wall_mm(-1.0), InvalidInput);
  EXPECT_THROW(healthy_wall_mm(INFINITY), InvalidInput);
}

TEST(Plaque, TypesAreByTheShareOfCalcium) {
  const auto type = [](double calcium, double soft) {
    PlaqueVolumes volumes;
    volumes.class_mm3[static_cast<std::size_t>(PlaqueClass::calcified)] = calcium;
    volumes.class_mm3[static_cast<std::size_t>(PlaqueClass::fibrofatty)] = soft;
    return to_string(plaque_type(volumes));
  };
  EXPECT_EQ(type(0.0, 0.0), "none");
  EXPECT_EQ(type(0.0, 10.0), "non-calcified");
  EXPECT_EQ(type(0.4, 9.6), "non-calcified");
  EXPECT_EQ(type(0.5, 9.5), "mixed");
  EXPECT_EQ(type(4.9, 5.1), "mixed");
  EXPECT_EQ(type(5.0, 5.0), "calcified");
  EXPECT_EQ(type(10.0, 0.0), "calcified");
}

TEST(Plaque, RemodellingAgainstTheReferencePlaces) {
  const geometry::AxisCurve axis = straight(30.0);
  WallRadii walls = round_walls(30.0, 1.0, 2.0);
  walls.outer_mm = [](double s, double) { return s < 10.0 ? 2.0 : s < 20.0 ? 2.2 : 1.8; };
  const PlaqueProfile profile = plaque_profile(
      axis, walls, [](const Vec3&) { return 50.0; }, sharp());
  Stenosis stenosis;
  stenosis.throat_mm = 15.0;
  stenosis.proximal_mm = 5.0;
  stenosis.distal_mm = 25.0;
  ASSERT_TRUE(remodelling_index(profile, stenosis));
  EXPECT_NEAR(*remodelling_index(profile, stenosis), 2.0 * 4.84 / (4.0 + 3.24), 1e-9);
  stenosis.distal_mm = 31.0;
  EXPECT_FALSE(remodelling_index(profile, stenosis));
}

/// What a scanner shows of concentric layers: wide vessels, so that layers are nearly flat.
TEST(Plaque, WhatTheBlurMixesInIsTakenAway) {
  const double sigma = 0.3, lumen = 1.5, outer = 2.7, tissue_hu = 70.0, blood = 400.0, fat = -90.0;
  const geometry::AxisCurve axis = straight(10.0);
  WallRadii walls = round_walls(10.0, lumen, outer);
  walls.lumen_hu = [=](double) { return blood; };
  walls.fat_hu = [=](double) { return fat; };
  // The blurred picture, integrated over the point spread.
  std::vector<double> seen;
  const double h = 0.02;
  for (double rho = 0.0; rho < 4.0; rho += h) {
    double sum = 0.0, weight = 0.0;
    for (double x = -4.0 * sigma; x <= 4.0 * sigma; x += 0.03)
      for (double y = -4.0 * sigma; y <= 4.0 * sigma; y += 0.03) {
        const double w = std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)), r = std::hypot(rho + x, y);
        sum += w * (r < lumen ? blood : r < outer ? tissue_hu : fat);
        weight += w;
      }
    seen.push_back(sum / weight);
  }
  const auto scanned = [&](const Vec3& p) { return seen[static_cast<std::size_t>(p.head<2>().norm() / h)]; };
  const double truth = pi * (outer * outer - lumen * lumen) * 10.0;
  PlaqueOptions options;
  PlaqueVolumes found = plaque_between(plaque_profile(axis, walls, scanned, options), 0.0, 10.0);
  EXPECT_LT(within_percent(found.of(PlaqueClass::fibrofatty), truth), 2.0);
  // As they stand, CT numbers show fibrous tissue beside the lumen and low attenuation beside the fat.
  found = plaque_between(plaque_profile(axis, walls, scanned, sharp()), 0.0, 10.0);
  EXPECT_GT(found.of(PlaqueClass::fibrous), 0.1 * truth);
  EXPECT_GT(found.of(PlaqueClass::low_attenuation), 0.1 * truth);
}

TEST(Plaque, RefusesWhatMakesNoSense) {
  const geometry::AxisCurve axis = straight(10.0);
  const auto tissue = [](const Vec3&) { return 50.0; };
  EXPECT_THROW(plaque_profile(axis, round_walls(11.0, 1.0, 2.0), tissue, sharp()), InvalidInput);
  EXPECT_THROW(plaque_profile(axis, round_walls(10.0, std::nan(""), 2.0), tissue, sharp()), InvalidInput);
  EXPECT_THROW(plaque_profile(axis, round_walls(10.0, 1.0, 2.0), tissue), InvalidInput);  // how bright is it?
  PlaqueOptions options = sharp();
  options.fibrofatty_hu = 10.0;
  EXPECT_THROW(plaque_profile(axis, round_walls(10.0, 1.0, 2.0), tissue, options), InvalidInput);
  // An outer wall within the lumen is no negative volume.
  const PlaqueVolumes none =
      plaque_between(plaque_profile(axis, round_walls(10.0, 2.0, 1.0), tissue, sharp()), 0.0, 10.0);
  EXPECT_EQ(none.wall_mm3(), 0.0);
}

}  // namespace
}  // namespace ostia::analysis
