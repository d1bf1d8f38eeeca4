// What real scans show, asked for and measured back.

#include "ostia/phantom/scan_realism.h"

#include "simple_scene.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/evaluation/image_quality.h"
#include "ostia/phantom/scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Vec3;
using testing::ball_scene;
using testing::flat_scene;
using testing::FunctionScene;
using testing::quiet_scan;

constexpr double water_attenuation_per_mm = 0.0195;

imaging::MaskVolume mask_of(const Scan& scan, Label label) {
  imaging::MaskVolume mask{scan.labels.geometry, {}};
  for (const std::uint8_t v : scan.labels.voxels)
    mask.voxels.push_back(v == static_cast<std::uint8_t>(label));
  return mask;
}

/// Half of space, 1000 HU for x > 0, 0 HU elsewhere; turned a little, so that voxels oversample the edge.
FunctionScene plane_scene(const Vec3& normal) {
  return FunctionScene([=](const Vec3& p) {
    return normal.dot(p) > 0.0 ? Material{Label::aorta, 1000.0f} : Material{Label::fat, 0.0f};
  });
}

TEST(ScanRealism, ASharpKernelUndershootsAsAskedAndKeepsItsWidth) {
  const Vec3 normal(std::cos(0.12), std::sin(0.12), 0.0);
  for (const double undershoot : {0.02, 0.06, 0.12}) {
    ScanOptions options = quiet_scan({70, 70, 8}, {0.35, 0.35, 0.5});
    options.psf_fwhm_mm = 0.9;
    options.realism.undershoot = undershoot;
    const Scan scan = acquire(plane_scene(normal), options);
    const auto distance = [&](const Vec3& p) { return normal.dot(p); };
    EXPECT_NEAR(evaluation::edge_width(scan.image, distance).line_spread_fwhm_mm, 0.9, 0.045) << undershoot;
    evaluation::EdgeOptions edges;
    edges.half_length_mm = 4.0;
    const auto profile = evaluation::edge_profile(scan.image, mask_of(scan, Label::aorta), edges, 400);
    ASSERT_GT(profile.edges, 50u);
    EXPECT_NEAR(profile.undershoot, undershoot, 0.1 * undershoot + 0.003);
    EXPECT_NEAR(profile.overshoot, undershoot, 0.1 * undershoot + 0.003);
  }
}

TEST(ScanRealism, TailsHoldTheShareThatWasAskedFor) {
  ScanOptions options = quiet_scan({96, 24, 8}, {0.35, 0.35, 0.5});
  options.realism.tail = 0.2;
  options.realism.tail_fwhm_mm = 4.0;
  const Scan scan = acquire(plane_scene(Vec3::UnitX()), options);
  const double sigma = 4.0 / std::sqrt(8.0 * std::numbers::ln2);
  for (const double away : {1.5, 2.0, 3.0, 4.0}) {
    // So far from the plane the core is 0.
    const auto i = static_cast<std::int64_t>(std::lround((-away - options.grid.origin.x()) / 0.35));
    const double x = options.grid.origin.x() + 0.35 * static_cast<double>(i);
    const double expected = 0.2 * 500.0 * std::erfc(-x / (sigma * std::numbers::sqrt2));
    EXPECT_NEAR(scan.image(i, 12, 4), expected, 2.0) << away;
  }
  const auto distance = [](const Vec3& p) { return p.x(); };
  EXPECT_LT(evaluation::edge_width(scan.image, distance).residual_hu, 60.0);
}

TEST(ScanRealism, IterativeReconstructionKeepsTheDeviationWhereItIsFlatAndMoreAtEdges) {
  const double radius = 12.0;
  const FunctionScene scene([=](const Vec3& p) {
    return p.head<2>().norm() < radius ? Material{Label::aorta, 400.0f} : Material{Label::fat, -100.0f};
  });
  ScanOptions options = quiet_scan({128, 128, 24}, {0.4, 0.4, 0.5});
  const Scan still = acquire(scene, options);
  options.noise_hu = 30.0;
  const auto measured = [&](double iterative) {
    options.realism.iterative = iterative;
    const Scan scan = acquire(scene, options);
    double flat = 0.0, edge = 0.0, flats = 0.0, edges = 0.0;
    for (std::int64_t k = 0; k < 24; ++k) {
      for (std::int64_t j = 8; j < 120; ++j) {
        for (std::int64_t i = 8; i < 120; ++i) {
          const Vec3 p = options.grid.world(
              Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
          const double away = std::abs(p.head<2>().norm() - radius);
          const double noise = scan.image(i, j, k) - still.image(i, j, k);
          if (away > 4.0) {
            flat += noise * noise;
            flats += 1.0;
          } else if (away < 0.3) {
            edge += noise * noise;
            edges += 1.0;
          }
        }
      }
    }
    const auto power =
        evaluation::noise_power(scan.image, {{48, 48, 2}, {48, 48, 8}, {48, 48, 14}, {48, 48, 20}}, 32);
    return std::array<double, 3>{std::sqrt(flat / flats), std::sqrt(edge / edges), power.mean_per_mm};
  };
  const auto without = measured(0.0), with = measured(0.8);
  EXPECT_NEAR(without[0], 30.0, 0.6);
  EXPECT_NEAR(without[1], 30.0, 2.0);
  EXPECT_NEAR(with[0], 30.0, 0.05 * 30.0);
  EXPECT_GT(with[1], 1.4 * with[0]);      // the noise that the edges keep
  EXPECT_LT(with[2], 0.85 * without[2]);  // blotches
}

/// An ellipse of water in air, along z without end.
struct WaterEllipse {
  double wide = 160.0, high = 100.0;  // semi-axes along x and y, mm
  FunctionScene scene() const {
    return FunctionScene([*this](const Vec3& p) {
      return std::hypot(p.x() / wide, p.y() / high) < 1.0 ? Material{Label::muscle, 0.0f}
                                                          : Material{Label::outside_air, -1000.0f};
    });
  }
  /// Of the ray through a place whose normal has this angle from x.
  double chord(const Vec3& p, double angle) const {
    const double t = p.x() * std::cos(angle) + p.y() * std::sin(angle);
    const double reach2 = std::pow(wide * std::cos(angle), 2) + std::pow(high * std::sin(angle), 2);
    return t * t < reach2 ? 2.0 * wide * high * std::sqrt(reach2 - t * t) / reach2 : 0.0;
  }
  /// Variance at a place, and its second harmonic over the waves' direction.
  std::pair<double, std::complex<double>> variance(const Vec3& p, double strength) const {
    double sum = 0.0;
    std::complex<double> harmonic = 0.0;
    constexpr int angles = 360;
    for (int n = 0; n < angles; ++n) {
      const double angle = std::numbers::pi * n / angles;
      const double ray = std::exp(strength * water_attenuation_per_mm * chord(p, angle)) / angles;
      sum += ray;
      harmonic += std::polar(ray, 2.0 * angle);
    }
    return {sum, harmonic};
  }
};

TEST(ScanRealism, NoiseFollowsTheRaysThroughTheBodyInStrengthAndDirection) {
  const WaterEllipse body;
  const double strength = 0.5;
  for (const bool fine : {false, true}) {
    ScanOptions options =
        fine ? quiet_scan({160, 160, 24}, {0.4, 0.4, 1.0}) : quiet_scan({220, 160, 24}, {1.0, 1.0, 1.0});
    options.noise_hu = 30.0;
    options.noise_peak_per_mm = fine ? 0.2 : 0.12;
    options.psf_fwhm_mm = 1.0;
    options.noise_fwhm_z_mm = 0.0;
    options.realism.noise_structure = strength;
    const Scan scan = acquire(body.scene(), options);
    const double centre = body.variance(Vec3::Zero(), strength).first;
    const std::vector<Vec3> places =
        fine ? std::vector<Vec3>{Vec3::Zero()} : std::vector<Vec3>{Vec3::Zero(), {0, -60, 0}, {80, 0, 0}};
    const int side = fine ? 64 : 32;
    for (const Vec3& at : places) {
      const Vec3 index = options.grid.index(at);
      std::vector<evaluation::NoiseRegion> squares;
      for (std::int64_t k = 0; k < 24; ++k)
        squares.push_back({std::lround(index.x()) - side / 2, std::lround(index.y()) - side / 2, k});
      const auto power = evaluation::noise_power(scan.image, squares, side);
      const auto [variance, harmonic] = body.variance(at, strength);
      const double expected = 30.0 * std::sqrt(variance / centre);
      // The squares' trends take some of the lowest frequencies away.
      EXPECT_NEAR(power.deviation_hu, expected, 0.07 * expected) << fine << " " << at.transpose();
      EXPECT_NEAR(power.anisotropy, std::abs(harmonic) / variance, 0.07) << fine << " " << at.transpose();
      EXPECT_LT(std::min(power.streaks_deg, 180.0 - power.streaks_deg), 12.0) << at.transpose();
      EXPECT_NEAR(power.peak_per_mm, options.noise_peak_per_mm, 0.15 * options.noise_peak_per_mm);
    }
  }
}

TEST(ScanRealism, StreaksLeaveDenseThingsAloneAndGrowWithTheirStrength) {
  const auto disc = [](float hu) {
    return FunctionScene([=](const Vec3& p) {
      return (p.head<2>() - geometry::Vec2(-20, 0)).norm() < 9.0 ? Material{Label::vein, hu}
                                                                 : Material{Label::fat, -100.0f};
    });
  };
  ScanOptions options = quiet_scan({100, 100, 1}, {0.8, 0.8, 0.8});
  options.psf_fwhm_mm = 0.8;
  const auto beside = [&](const FunctionScene& scene, double strength) {
    options.realism.streaks = 0.0;
    const Scan none = acquire(scene, options);
    options.realism.streaks = strength;
    const Scan some = acquire(scene, options);
    double sum = 0.0, count = 0.0;
    for (std::int64_t j = 0; j < 100; ++j) {
      for (std::int64_t i = 0; i < 100; ++i) {
        const Vec3 p = options.grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), 0.0));
        const double away = (p.head<2>() - geometry::Vec2(-20, 0)).norm();
        if (away < 11.0 || away > 25.0) continue;
        sum += std::pow(some.image(i, j, 0) - none.image(i, j, 0), 2);
        count += 1.0;
      }
    }
    return std::sqrt(sum / count);
  };
  EXPECT_EQ(beside(disc(300.0f), 1.0), 0.0);  // well mixed blood leaves none
  const double one = beside(disc(1200.0f), 1.0), two = beside(disc(1200.0f), 2.0);
  EXPECT_GT(one, 4.0);
  EXPECT_LT(one, 60.0);
  EXPECT_NEAR(two, 2.0 * one, 0.05 * two);
}

TEST(ScanRealism, HalfScanMotionMovesEdgesWithinItsPathAndKeepsTheWhole) {
  const FunctionScene scene([](const Vec3& p) {
    return p.head<2>().norm() < 3.0 ? Material{Label::coronary_lumen, 450.0f} : Material{Label::fat, 50.0f};
  });
  ScanOptions options = quiet_scan({120, 120, 1}, {0.4, 0.4, 0.5});
  const Scan still = acquire(scene, options);
  options.realism.half_scan_motion_mm = 4.0;
  const Scan moved = acquire(scene, options);
  double before = 0.0, after = 0.0, near = 0.0, far = 0.0;
  for (std::int64_t j = 0; j < 120; ++j) {
    for (std::int64_t i = 0; i < 120; ++i) {
      const Vec3 p = options.grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), 0.0));
      const double change = std::abs(moved.image(i, j, 0) - still.image(i, j, 0));
      before += still.image(i, j, 0) - 50.0;
      after += moved.image(i, j, 0) - 50.0;
      double& largest = p.head<2>().norm() < 3.0 + 2.0 + 3.0 ? near : far;
      largest = std::max(largest, change);
    }
  }
  EXPECT_NEAR(after, before, 0.05 * before);
  EXPECT_GT(near, 100.0);      // edges are elsewhere
  EXPECT_LT(far, 0.3 * near);  // what is farther away has streaks alone
  EXPECT_EQ(moved.labels.voxels, still.labels.voxels);
  // What moves lies in a ball; far from it nothing changes.
  options.moving_centre = {0, 0, 300};
  options.moving_radius_mm = 50.0;
  EXPECT_EQ(acquire(scene, options).image.voxels, still.image.voxels);
}

TEST(ScanRealism, AHalfScanOfALongPathShowsAnEdgeTwice) {
  // Where the views that see an edge are the exposure's first and last, it is shown at both ends of the path.
  const FunctionScene scene([](const Vec3& p) {
    return p.head<2>().norm() < 2.0 ? Material{Label::coronary_lumen, 1050.0f} : Material{Label::fat, 50.0f};
  });
  ScanOptions options = quiet_scan({120, 120, 1}, {0.4, 0.4, 0.5});
  options.realism.half_scan_motion_mm = 9.0;
  bool twice = false;
  for (options.seed = 1; options.seed <= 6 && !twice; ++options.seed) {
    const Scan scan = acquire(scene, options);
    // Two places brighter than a third, farther apart than the disc is wide.
    double widest = 0.0;
    std::vector<Vec3> bright;
    for (std::int64_t j = 0; j < 120; ++j)
      for (std::int64_t i = 0; i < 120; ++i)
        if (scan.image(i, j, 0) > 350)
          bright.push_back(options.grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), 0.0)));
    for (const Vec3& a : bright)
      for (const Vec3& b : bright) widest = std::max(widest, (a - b).norm());
    twice = widest > 6.0;
    EXPECT_LT(widest, 4.0 + 9.0 + 1.0);
  }
  EXPECT_TRUE(twice);
}

TEST(ScanRealism, IsTheSameForAnyThreads) {
  ScanOptions options = quiet_scan({60, 56, 20}, {0.5, 0.5, 0.5});
  options.noise_hu = 20.0;
  options.realism.noise_structure = 0.5;
  options.realism.iterative = 0.5;
  options.realism.undershoot = 0.05;
  options.realism.tail = 0.1;
  options.realism.streaks = 1.0;
  options.realism.half_scan_motion_mm = 2.0;
  const FunctionScene scene = ball_scene({1, 0, 0}, 5.0);
  core::set_max_threads(1);
  const Scan one = acquire(scene, options);
  core::set_max_threads(3);
  const Scan three = acquire(scene, options);
  core::set_max_threads(0);
  EXPECT_EQ(one.image.voxels, three.image.voxels);
  ScanOptions plain = quiet_scan({60, 56, 20}, {0.5, 0.5, 0.5});
  EXPECT_EQ(one.labels.voxels, acquire(scene, plain).labels.voxels);
}

TEST(ScanRealism, RefusesByName) {
  const auto refused = [](const char* word, const std::function<void(ScanOptions&)>& spoil) {
    ScanOptions options = quiet_scan({8, 8, 8}, {0.5, 0.5, 0.5});
    options.noise_hu = 20.0;
    spoil(options);
    try {
      validate(options);
      ADD_FAILURE() << word << " was accepted";
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  for (const RealismMember& member : realism_members()) {
    for (const double value : {member.least - 1.0, member.most + 1.0, std::nan("")}) {
      ScanRealism realism;
      EXPECT_THROW(set_value(realism, member.name, value), InvalidInput) << member.name;
      EXPECT_EQ(realism, ScanRealism{});
    }
    ScanRealism realism;
    set_value(realism, member.name, member.most);
    EXPECT_EQ(value_of(realism, member.name), member.most);
    EXPECT_NO_THROW(validate(realism));
  }
  ScanRealism realism;
  EXPECT_THROW(set_value(realism, "clips", 2.5), InvalidInput);
  EXPECT_THROW(set_value(realism, "snow", 1.0), InvalidInput);
  refused("noise_structure", [](ScanOptions& o) { o.realism.noise_structure = 1.1; });
  refused("sternal_wires", [](ScanOptions& o) { o.realism.sternal_wires = 9; });
  refused("cava_hu", [](ScanOptions& o) { o.realism.cava_hu = 50.0; });
  refused("noise_peak_per_mm", [](ScanOptions& o) {
    o.realism.noise_structure = 0.5;
    o.noise_peak_per_mm = 0.0;
  });
  refused("tail_fwhm_mm", [](ScanOptions& o) {
    o.realism.tail = 0.1;
    o.psf_fwhm_mm = 2.5;
  });
  refused("psf_fwhm_mm", [](ScanOptions& o) {
    o.realism.undershoot = 0.1;
    o.psf_fwhm_mm = 0.0;
  });
  refused("half a voxel", [](ScanOptions& o) {
    o.realism.tail = 0.4;
    o.realism.tail_fwhm_mm = 1.5;
    o.psf_fwhm_mm = 0.26;
  });
}

}  // namespace
}  // namespace ostia::phantom
