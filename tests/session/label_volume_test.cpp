#include "ostia/session/label_volume.h"

#include "report_cases.h"

#include "ostia/core/error.h"
#include "ostia/session/found_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

imaging::Geometry grid_about_tube() {
  imaging::Geometry grid;
  grid.size = {60, 60, 200};
  grid.spacing = {0.25, 0.25, 0.25};
  grid.origin = {-7.4, -7.4, -5.0};
  return grid;
}

double count_of(const LabelVolume& labels, const std::string& name) {
  for (const LabelCount& one : labels.counts)
    if (one.name == name) return static_cast<double>(one.voxels);
  return 0.0;
}

double dice(const imaging::MaskVolume& a, const imaging::MaskVolume& b) {
  double both = 0.0, sum = 0.0;
  for (std::size_t n = 0; n < a.voxels.size(); ++n) {
    const bool in_a = a.voxels[n] != 0, in_b = b.voxels[n] != 0;
    both += in_a && in_b ? 1.0 : 0.0;
    sum += (in_a ? 1.0 : 0.0) + (in_b ? 1.0 : 0.0);
  }
  return 2.0 * both / sum;
}

TEST(LabelVolume, TheLumenHasTheVolumeOfTheTubeThatItIs) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5);
  const LabelVolume labels = label_volume(model, grid_about_tube(), VoxelLabels::lumen);
  const double voxel = std::pow(0.25, 3);
  const double tube = std::numbers::pi * 1.5 * 1.5 * (40.0 + 4.0 / 3.0 * 1.5);  // with its domes
  EXPECT_NEAR(count_of(labels, "lumen") * voxel, tube, 0.02 * tube);
  ASSERT_EQ(labels.counts.size(), 1U);
  EXPECT_EQ(labels.counts[0].value, label_lumen);
}

TEST(LabelVolume, SegmentsBearTheStandardNumbers) {
  const lumen::LumenModel model = named_y();
  imaging::Geometry grid = grid_about_tube();
  grid.size = {240, 240, 240};
  grid.origin = {-30.0, -30.0, -30.0};
  const LabelVolume labels = label_volume(model, grid, VoxelLabels::segments);
  EXPECT_GT(count_of(labels, "LM (5)"), 1000.0);
  EXPECT_GT(count_of(labels, "pLAD (6)"), 500.0);
  EXPECT_GT(count_of(labels, "pLCX (11)"), 500.0);
}

TEST(LabelVolume, WallAndPlaqueLieAboutTheLumenWhereTheImageShowsThem) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5);
  const imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const double voxel = image.geometry.spacing.prod(), pi = std::numbers::pi;
  const double wall = pi * (2.6 * 2.6 - 1.5 * 1.5) * 37.0;  // without a radius at its ends
  const LabelVolume walls = label_volume(model, image.geometry, VoxelLabels::wall, &image);
  EXPECT_NEAR(count_of(walls, "wall") * voxel, wall, 0.1 * wall);
  const LabelVolume plaque = label_volume(model, image.geometry, VoxelLabels::plaque, &image);
  EXPECT_NEAR(count_of(plaque, "fibrofatty") * voxel, wall, 0.15 * wall);
  EXPECT_EQ(count_of(plaque, "calcified"), 0.0);
}

TEST(LabelVolume, WhatCannotBeLabelledIsToldWithTheReason) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5);
  imaging::Geometry far = grid_about_tube();
  far.origin.x() += 500.0;
  try {
    label_volume(model, far, VoxelLabels::lumen);
    FAIL() << "a grid beside the vessels was taken";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("another patient's"));
  }
  EXPECT_THROW(label_volume(model, grid_about_tube(), VoxelLabels::wall), InvalidInput);
  EXPECT_THROW(label_volume({}, grid_about_tube(), VoxelLabels::lumen), InvalidInput);
}

/// A trunk and two branches of tubes on a grid of 0.6 mm, as a network would draw them.
imaging::MaskVolume drawn_y() {
  imaging::Geometry grid;
  grid.spacing = {0.6, 0.6, 0.6};
  grid.size = {110, 60, 110};
  grid.origin = {-33.0, -18.0, -10.0};
  return label_volume(named_y(), grid, VoxelLabels::lumen).volume;
}

TEST(ModelOfMask, KeepsTheMasksVolumeAndGoesBackToIt) {
  const imaging::MaskVolume mask = drawn_y();
  const MaskModel made = model_of_mask(mask);
  EXPECT_EQ(made.found.doubts.size(), made.found.model.tree.vessels.size());
  const LabelVolume back = label_volume(made.found.model, mask.geometry, VoxelLabels::lumen);
  double before = 0.0;
  for (const std::uint8_t voxel : mask.voxels) before += voxel != 0 ? 1.0 : 0.0;
  EXPECT_NEAR(count_of(back, "lumen"), before, 0.02 * before);
  EXPECT_GT(dice(mask, back.volume), 0.92);
}

TEST(ModelOfMask, AnImageOfAnotherPatientIsRefused) {
  const imaging::MaskVolume mask = drawn_y();
  imaging::ImageVolume image;
  image.geometry = mask.geometry;
  for (const std::uint8_t voxel : mask.voxels)
    image.voxels.push_back(static_cast<std::int16_t>(voxel != 0 ? 350 : 0));
  EXPECT_NO_THROW(model_of_mask(mask, &image));
  imaging::ImageVolume other = image;
  other.geometry.origin.x() += 9.0;
  other.geometry.origin.z() += 9.0;
  const auto refusal = [&](const imaging::ImageVolume& ct) -> std::string {
    try {
      model_of_mask(mask, &ct);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "no refusal";
  };
  imaging::ImageVolume dark = image;
  for (std::int16_t& voxel : dark.voxels) voxel = 40;
  EXPECT_THAT(refusal(dark), HasSubstr("does not lie on the image's vessels"));
  other.geometry.origin.x() += 300.0;
  EXPECT_THAT(refusal(other), HasSubstr("does not lie in the image"));
}

}  // namespace
}  // namespace ostia::session
