#include "ostia/analysis/fat_attenuation.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace ostia::analysis {
namespace {

using geometry::Vec3;
using imaging::ImageVolume;
using std::numbers::pi;

/// Along z through (15, 15), 60 mm long.
geometry::AxisCurve fat_axis() {
  geometry::Centerline line;
  for (double z = 0.0; z <= 60.0 + 1e-9; z += 0.5) line.points.emplace_back(15.0, 15.0, z);
  geometry::complete(line, Vec3::UnitX());
  return geometry::AxisCurve(line);
}

/// What a scanner with a Gaussian blur of 0.3 mm shows of rings about the axis: each value of `inside`
/// reaches to its radius, `beyond` from there on.
double blurred_rings(double rho, const std::vector<std::pair<double, double>>& inside, double beyond) {
  constexpr double sigma = 0.3;
  double hu = beyond;
  for (std::size_t i = inside.size(); i-- > 0;) {
    const double next = i + 1 < inside.size() ? inside[i + 1].second : beyond;
    hu +=
        (inside[i].second - next) * 0.5 * std::erfc((rho - inside[i].first) / (sigma * std::numbers::sqrt2));
  }
  return hu;
}

ImageVolume fat_image(const std::function<double(const Vec3&)>& hu_at, double noise_hu = 0.0) {
  ImageVolume image;
  image.geometry.size = {76, 76, 130};
  image.geometry.spacing = {0.4, 0.4, 0.5};
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (std::int64_t k = 0; k < 130; ++k)
    for (std::int64_t j = 0; j < 76; ++j)
      for (std::int64_t i = 0; i < 76; ++i) {
        const double hu = hu_at(image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))));
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(hu + noise_hu * noise(random))));
      }
  return image;
}

double rho_of(const Vec3& at) {
  return std::hypot(at.x() - 15.0, at.y() - 15.0);
}

/// Blood to 1.4 mm, wall to 1.9 mm, fat.
const std::vector<std::pair<double, double>> artery{{1.4, 400.0}, {1.9, 50.0}};
const FatStretch artery_stretch{10.0, 50.0, [](double, double) { return 1.9; }};

TEST(FatAttenuation, KnownFatBesideABlurredWallIsFoundWithinAUnit) {
  for (const double fat : {-105.0, -85.0, -65.0}) {
    const ImageVolume image =
        fat_image([&](const Vec3& at) { return blurred_rings(rho_of(at), artery, fat); });
    const FatProfile found = fat_profile(fat_axis(), artery_stretch, image);
    EXPECT_NEAR(found.fat.mean_hu, fat, 1.0);
    EXPECT_GT(found.fat.all_mean_hu, found.fat.mean_hu + 0.5) << "voxels that are partly wall raise it";
    EXPECT_NEAR(found.diameter_mm, 3.8, 1e-9);
  }
}

TEST(FatAttenuation, NoiseMovesItByLessThanAUnit) {
  const ImageVolume image =
      fat_image([&](const Vec3& at) { return blurred_rings(rho_of(at), artery, -90.0); }, 20.0);
  const FatProfile found = fat_profile(fat_axis(), artery_stretch, image);
  EXPECT_NEAR(found.fat.mean_hu, -90.0, 1.0);
  EXPECT_NEAR(found.fat.sd_hu, 20.0, 1.5);
}

TEST(FatAttenuation, VolumeIsThatOfTheShell) {
  // Sharp, so that every voxel of the shell is fat: from 1.9 mm to one diameter beyond.
  const ImageVolume image = fat_image([](const Vec3& at) { return rho_of(at) < 1.9 ? 100.0 : -90.0; });
  const FatProfile found = fat_profile(fat_axis(), artery_stretch, image);
  const double shell = pi * (5.7 * 5.7 - 1.9 * 1.9) * 40.0;
  EXPECT_NEAR(found.fat.volume_mm3, shell, 0.02 * shell);
  EXPECT_NEAR(found.fat.volume_mm3, static_cast<double>(found.fat.all_voxels) * 0.08, 1e-6);
  std::int64_t of_slabs = 0, of_pieces = 0;
  for (const FatAmount& slab : found.slabs) of_slabs += slab.all_voxels;
  for (const FatPiece& piece : found.pieces) of_pieces += piece.fat.all_voxels;
  EXPECT_EQ(of_slabs, found.fat.all_voxels);
  EXPECT_EQ(of_pieces, found.fat.all_voxels);
  EXPECT_EQ(found.slabs.size(), 40U);
  EXPECT_EQ(found.pieces.size(), 320U);
}

TEST(FatAttenuation, ChambersAndOtherVesselsHaveNoSay) {
  // Muscle on one side from 4 mm on, another artery on the other side.
  const ImageVolume image = fat_image([&](const Vec3& at) {
    const double other = blurred_rings(std::hypot(at.x() - 19.0, at.y() - 15.0), artery, -85.0);
    const double wall = blurred_rings(rho_of(at), artery, -85.0);
    const double muscle = 0.5 * std::erfc((at.x() - 11.0) / (0.3 * std::numbers::sqrt2));
    return wall + (other + 85.0) + muscle * (110.0 + 85.0);
  });
  const FatProfile found = fat_profile(fat_axis(), artery_stretch, image);
  EXPECT_NEAR(found.fat.mean_hu, -85.0, 1.0);
  EXPECT_GT(found.fat.voxels, 5000);
}

TEST(FatAttenuation, TheMapShowsWhereItIsBrighter) {
  const ImageVolume image = fat_image([](const Vec3& at) {
    if (rho_of(at) < 1.9) return 100.0;
    return at.z() > 30.0 && at.y() > 15.0 ? -60.0 : -100.0;
  });
  FatOptions options;
  options.sectors = 4;
  const FatProfile found = fat_profile(fat_axis(), artery_stretch, image, options);
  for (const FatPiece& piece : found.pieces) {
    const Vec3 towards = geometry::radial_direction(fat_axis().frame(30.0), piece.from_theta + pi / 4.0);
    const double middle = 0.5 * (piece.from_mm + piece.to_mm);
    if (std::abs(middle - 30.0) < 2.0) continue;
    EXPECT_NEAR(piece.fat.mean_hu, middle > 30.0 && towards.y() > 0.0 ? -60.0 : -100.0, 1.5) << middle;
  }
}

TEST(FatAttenuation, TheSameForAnyNumberOfThreads) {
  const ImageVolume image =
      fat_image([&](const Vec3& at) { return blurred_rings(rho_of(at), artery, -90.0); }, 20.0);
  core::set_max_threads(1);
  const FatProfile one = fat_profile(fat_axis(), artery_stretch, image);
  core::set_max_threads(4);
  const FatProfile four = fat_profile(fat_axis(), artery_stretch, image);
  core::set_max_threads(0);
  EXPECT_EQ(one.fat.mean_hu, four.fat.mean_hu);
  EXPECT_EQ(one.fat.sd_hu, four.fat.sd_hu);
}

TEST(FatAttenuation, RangesAndTubeVoltages) {
  EXPECT_EQ(fat_range("RCA")->from_mm, 10.0);
  EXPECT_EQ(fat_range("RCA")->to_mm, 50.0);
  EXPECT_EQ(fat_range("LAD")->to_mm, 40.0);
  EXPECT_EQ(fat_range("LCX")->from_mm, 0.0);
  EXPECT_FALSE(fat_range("D1"));
  EXPECT_NEAR(*fat_hu_at_120_kv(-80.0, 120.0), -80.0, 1e-12);
  EXPECT_NEAR(*fat_hu_at_120_kv(-80.0, 100.0), -80.0 / 1.080, 1e-12);
  EXPECT_NEAR(*fat_hu_at_120_kv(-80.0, 80.0), -80.0 / 1.267, 1e-12);
  EXPECT_NEAR(*fat_hu_at_120_kv(-80.0, 140.0), -80.0 / 0.947, 1e-12);
  EXPECT_FALSE(fat_hu_at_120_kv(-80.0, 70.0));
}

TEST(FatAttenuation, WhatCannotBeMeasuredIsRefused) {
  const ImageVolume image = fat_image([](const Vec3&) { return -90.0; });
  const geometry::AxisCurve axis = fat_axis();
  EXPECT_THROW(fat_profile(axis, {10.0, 70.0, artery_stretch.outer_mm}, image), InvalidInput);
  EXPECT_THROW(fat_profile(axis, {10.0, 50.0, {}}, image), InvalidInput);
  EXPECT_THROW(fat_profile(axis, {10.0, 50.0, [](double, double) { return std::nan(""); }}, image),
               InvalidInput);
  FatOptions bad;
  bad.to_hu = -200.0;
  EXPECT_THROW(fat_profile(axis, artery_stretch, image, bad), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
