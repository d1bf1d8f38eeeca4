// Plaques of which each feature is known beforehand.

#include "ostia/analysis/high_risk_plaque.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace ostia::analysis {
namespace {

using std::numbers::pi;

constexpr double hrp_length_mm = 30.0, hrp_lumen_mm = 1.4;

/// What a plaque of 10 mm about the middle of a straight vessel is made of.
struct MadePlaque {
  double outer_mm = 2.6;  ///< radius of its outer wall; 1.8 beside it
  std::function<double(const Vec3&)> hu = [](const Vec3&) { return 90.0; };
};

struct PlaqueOfVessel {
  PlaqueProfile profile;
  std::vector<PlaqueMap> maps;
};

PlaqueOfVessel made_of(const MadePlaque& made) {
  geometry::Centerline line;
  for (double z = 0.0; z <= hrp_length_mm + 1e-9; z += 0.5) line.points.emplace_back(0.0, 0.0, z);
  geometry::complete(line, Vec3::UnitX());
  const geometry::AxisCurve axis(line);
  WallRadii walls;
  walls.to_mm = hrp_length_mm;
  walls.lumen_mm = [](double, double) { return hrp_lumen_mm; };
  walls.outer_mm = [&](double s, double) { return s >= 10.0 && s <= 20.0 ? made.outer_mm : 1.8; };
  walls.calibre_mm = [](double) { return 2.0 * hrp_lumen_mm; };
  PlaqueOptions options;
  options.blur_sigma_mm = 0.0;
  PlaqueOfVessel out{plaque_profile(axis, walls, made.hu, options), {}};
  for (const PlaqueSlab& slab : out.profile.slabs)
    out.maps.push_back(plaque_map(axis, walls, slab.s_mm, made.hu, options));
  return out;
}

Stenosis made_lesion() {
  Stenosis lesion;
  lesion.from_mm = 10.0, lesion.to_mm = 20.0, lesion.throat_mm = 15.0;
  lesion.proximal_mm = 5.0, lesion.distal_mm = 25.0;
  return lesion;
}

PlaqueFeatureFinding found(const MadePlaque& made, PlaqueFeature feature,
                           const Stenosis& lesion = made_lesion()) {
  const PlaqueOfVessel plaque = made_of(made);
  return plaque_features_of(plaque.profile, plaque.maps, lesion)[static_cast<std::size_t>(feature)];
}

double rho(const Vec3& p) {
  return std::hypot(p.x(), p.y());
}

/// A ball of `hu` in tissue of 90 HU, in the middle of the wall.
MadePlaque with_ball(double radius_mm, double hu) {
  MadePlaque made;
  const Vec3 centre(0.5 * (hrp_lumen_mm + made.outer_mm), 0.0, 15.0);
  made.hu = [=](const Vec3& p) { return (p - centre).norm() < radius_mm ? hu : 90.0; };
  return made;
}

TEST(HighRiskPlaque, AHomogeneousPlaqueHasOnlyItsSize) {
  const PlaqueOfVessel plaque = made_of({});
  const auto all = plaque_features_of(plaque.profile, plaque.maps, made_lesion());
  ASSERT_EQ(all.size(), plaque_features.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].feature, plaque_features[i]);
    EXPECT_TRUE(all[i].known);
    EXPECT_EQ(all[i].present, all[i].feature == PlaqueFeature::positive_remodelling);
  }
  EXPECT_EQ(all[0].value, 0.0);
  EXPECT_EQ(all[2].value, 0.0);
  EXPECT_EQ(all[3].value, 0.0);
}

TEST(HighRiskPlaque, RemodellingIsTheRatioOfOuterDiameters) {
  for (const double outer : {1.8, 1.95, 2.02, 2.6}) {
    const PlaqueFeatureFinding one = found({outer}, PlaqueFeature::positive_remodelling);
    EXPECT_NEAR(one.value, outer / 1.8, 0.01) << outer;
    EXPECT_EQ(one.present, outer > 1.98) << outer;
    EXPECT_EQ(one.s_mm, 15.0);
  }
  EXPECT_EQ(found({2.6}, PlaqueFeature::positive_remodelling).confidence, FeatureConfidence::high);
  EXPECT_EQ(found({2.02}, PlaqueFeature::positive_remodelling).confidence, FeatureConfidence::moderate);
}

TEST(HighRiskPlaque, LowAttenuationIsTheVolumeOfTheLargestPiece) {
  // A ball of 0.55 mm has 0.70 mm3; one of 0.59 mm lies within the wall, too, and two of them do not add up.
  const PlaqueFeatureFinding small = found(with_ball(0.55, 0.0), PlaqueFeature::low_attenuation);
  EXPECT_NEAR(small.value, 4.0 / 3.0 * pi * std::pow(0.55, 3), 0.1);
  EXPECT_FALSE(small.present);
  EXPECT_NEAR(small.s_mm.value(), 15.0, 0.2);
  MadePlaque two = with_ball(0.55, 0.0);
  two.hu = [one = two.hu](const Vec3& p) { return std::min(one(p), one(Vec3(-p.x(), p.y(), p.z()))); };
  EXPECT_FALSE(found(two, PlaqueFeature::low_attenuation).present);
  MadePlaque quarter;
  quarter.hu = [](const Vec3& p) {
    return p.x() > 0.0 && p.y() > 0.0 && p.z() > 14.0 && p.z() < 16.0 ? 10.0 : 90.0;
  };
  const PlaqueFeatureFinding large = found(quarter, PlaqueFeature::low_attenuation);
  EXPECT_TRUE(large.present);
  EXPECT_NEAR(large.value, 2.0 * 0.25 * pi * (2.6 * 2.6 - hrp_lumen_mm * hrp_lumen_mm), 0.4);
  EXPECT_NEAR(large.theta_deg.value(), 315.0, 5.0);  // counter-clockwise for one who looks distally
  EXPECT_EQ(large.confidence, FeatureConfidence::high);
}

TEST(HighRiskPlaque, AtExactlyThirtyHuNothingIsOfLowAttenuation) {
  MadePlaque made;
  made.hu = [](const Vec3&) { return 30.0; };
  EXPECT_FALSE(found(made, PlaqueFeature::low_attenuation).present);
  made.hu = [](const Vec3&) { return 29.9; };
  EXPECT_TRUE(found(made, PlaqueFeature::low_attenuation).present);
}

TEST(HighRiskPlaque, CalciumIsSpottyBelowThreeMillimetresInEveryDirection) {
  const PlaqueFeatureFinding spot = found(with_ball(0.55, 800.0), PlaqueFeature::spotty_calcium);
  EXPECT_TRUE(spot.present);
  EXPECT_NEAR(spot.value, 1.1, 0.3);
  EXPECT_NEAR(spot.s_mm.value(), 15.0, 0.2);
  // A rod along the vessel, and a shell around it, are longer than 3 mm in one direction alone.
  MadePlaque rod;
  rod.hu = [](const Vec3& p) {
    return p.x() > 0.0 && std::abs(p.y()) < 0.3 && std::abs(p.z() - 15.0) < 2.0 ? 800.0 : 90.0;
  };
  EXPECT_FALSE(found(rod, PlaqueFeature::spotty_calcium).present);
  EXPECT_NEAR(found(rod, PlaqueFeature::spotty_calcium).value, 4.0, 0.4);
  MadePlaque shell;
  shell.hu = [](const Vec3& p) {
    return p.x() > 0.0 && rho(p) > 2.2 && std::abs(p.z() - 15.0) < 0.5 ? 800.0 : 90.0;
  };
  EXPECT_FALSE(found(shell, PlaqueFeature::spotty_calcium).present);
  // One that goes on beyond the lesion is as long as it is.
  MadePlaque over_the_end;
  over_the_end.hu = [](const Vec3& p) {
    return p.x() > 0.0 && std::abs(p.y()) < 0.3 && p.z() > 14.0 && p.z() < 18.0 ? 800.0 : 90.0;
  };
  Stenosis ends_within = made_lesion();
  ends_within.to_mm = 16.5;
  EXPECT_FALSE(found(over_the_end, PlaqueFeature::spotty_calcium, ends_within).present);
  // A speck is none.
  EXPECT_FALSE(found(with_ball(0.25, 800.0), PlaqueFeature::spotty_calcium).present);
}

/// Low attenuation at the lumen within a brighter rim, over `deg` of the circumference and `long_mm`.
MadePlaque with_ring(double deg, double long_mm, double core_hu, double rim_hu) {
  MadePlaque made;
  made.hu = [=](const Vec3& p) {
    const double angle = std::abs(std::atan2(p.y(), p.x())) * 180.0 / pi;
    if (angle > 0.5 * deg || std::abs(p.z() - 15.0) > 0.5 * long_mm) return 90.0;
    return rho(p) < 2.2 ? core_hu : rim_hu;
  };
  return made;
}

TEST(HighRiskPlaque, ANapkinRingIsACoreAtTheLumenWithinARim) {
  const PlaqueFeatureFinding ring = found(with_ring(120.0, 3.0, 10.0, 100.0), PlaqueFeature::napkin_ring);
  EXPECT_TRUE(ring.present);
  EXPECT_NEAR(ring.value, 120.0, 8.0);
  EXPECT_NEAR(ring.s_mm.value(), 15.0, 1.6);
  EXPECT_EQ(ring.confidence, FeatureConfidence::moderate);
  EXPECT_TRUE(found(with_ring(360.0, 3.0, 10.0, 100.0), PlaqueFeature::napkin_ring).present);
  const std::pair<const char*, MadePlaque> others[] = {
      {"an arc that is too short", with_ring(40.0, 3.0, 10.0, 100.0)},
      {"a stretch that is too short", with_ring(120.0, 0.5, 10.0, 100.0)},
      {"a core that is not dark", with_ring(120.0, 3.0, 60.0, 100.0)},
      {"no rim", with_ring(120.0, 3.0, 10.0, 10.0)},
      {"a rim of calcium", with_ring(120.0, 3.0, 10.0, 500.0)}};
  for (const auto& [what, made] : others)
    EXPECT_FALSE(found(made, PlaqueFeature::napkin_ring).present) << what;
}

TEST(HighRiskPlaque, WhatIsNotThereIsNotKnown) {
  const PlaqueOfVessel plaque = made_of({});
  for (const PlaqueFeatureFinding& one : plaque_features_of(plaque.profile, {}, made_lesion()))
    EXPECT_EQ(one.known, one.feature == PlaqueFeature::positive_remodelling);
  Stenosis beyond = made_lesion();
  beyond.from_mm = 40.0, beyond.to_mm = 45.0, beyond.throat_mm = 42.0;
  for (const PlaqueFeatureFinding& one : plaque_features_of(plaque.profile, plaque.maps, beyond))
    EXPECT_FALSE(one.known || one.present);
  std::vector<PlaqueMap> fewer = plaque.maps;
  fewer.pop_back();
  EXPECT_THROW(plaque_features_of(plaque.profile, fewer, made_lesion()), InvalidInput);
  for (const auto& change : std::vector<void (*)(HighRiskOptions&)>{
           [](HighRiskOptions& o) { o.least_low_mm3 = 0.0; }, [](HighRiskOptions& o) { o.spot_mm = 20.0; },
           [](HighRiskOptions& o) { o.least_remodelling = std::nan(""); },
           [](HighRiskOptions& o) { o.ring_deg = 361.0; }, [](HighRiskOptions& o) { o.ring_mm = 0.0; }}) {
    HighRiskOptions options;
    change(options);
    EXPECT_THROW(validate(options), InvalidInput);
  }
  for (const PlaqueFeature one : plaque_features) EXPECT_EQ(plaque_feature(to_string(one)), one);
  EXPECT_THROW(plaque_feature("thin cap"), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
