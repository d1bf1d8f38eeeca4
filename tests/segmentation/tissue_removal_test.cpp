#include "ostia/segmentation/tissue_removal.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace ostia::segmentation {
namespace {

enum Truth : std::uint8_t { none, lumen, bone, calcium, skin, lung };

/// A chest in small: air, skin and fat; a rib and a vertebra-like column of shell and marrow; a vessel whose
/// wall touches the column, one beside it with calcium on its wall, and a lung.
struct Chest {
  imaging::ImageVolume image;
  imaging::MaskVolume truth;
  Vec3 in_lumen = Vec3(22.0, 22.0, 12.0), in_touching = Vec3(33.0, 37.0, 12.0);
};

double across(const Vec3& p, double x, double y) {
  return std::hypot(p.x() - x, p.y() - y);
}

std::pair<Truth, double> material(const Vec3& p) {
  const double body = 31.0 - across(p, 33.0, 33.0);  // depth under the skin
  if (body < 0.0) return {none, -1000.0};
  if (body < 2.0) return {skin, 20.0};
  const double spot = (p - Vec3(24.0, 22.0, 12.0)).norm();
  if (spot < 1.2) return {calcium, 1200.0};
  if (across(p, 22.0, 22.0) < 2.0) return {lumen, 350.0};
  const double column = across(p, 33.0, 48.0);
  if (column < 6.6) return {bone, 190.0};
  if (column < 8.0) return {bone, 650.0};
  if (across(p, 33.0, 37.2) < 2.0) return {lumen, 350.0};  // its wall touches the column
  const double rib = std::hypot(p.y() - 12.0, p.z() - 12.0);
  if (rib < 5.0) return {bone, rib < 3.6 ? 200.0 : 650.0};
  if (across(p, 50.0, 33.0) < 8.0) return {lung, -860.0};
  return {none, body < 6.0 ? -100.0 : 55.0};
}

Chest chest(double noise) {
  Chest out;
  out.image.geometry.size = {132, 132, 48};
  out.image.geometry.spacing = Vec3::Constant(0.5);
  out.truth.geometry = out.image.geometry;
  std::mt19937 generator(3);
  std::normal_distribution<double> random(0.0, 1.0);
  for (std::int64_t n = 0; n < out.image.geometry.voxels(); ++n) {
    const Vec3 p =
        out.image.geometry.world(Vec3(static_cast<double>(n % 132), static_cast<double>(n / 132 % 132),
                                      static_cast<double>(n / (132 * 132))));
    double hu = 0.0;  // partial volumes
    for (int s = 0; s < 8; ++s)
      hu += material(p + 0.125 * Vec3(s & 1 ? 1 : -1, s & 2 ? 1 : -1, s & 4 ? 1 : -1)).second / 8.0;
    out.image.voxels.push_back(static_cast<std::int16_t>(std::lround(hu + noise * random(generator))));
    out.truth.voxels.push_back(material(p).first);
  }
  return out;
}

struct Overlap {
  std::int64_t both = 0, truth = 0, found = 0, lost_lumen = 0, lost_lung = 0;
  double dice() const { return 2.0 * static_cast<double>(both) / static_cast<double>(truth + found); }
};

Overlap overlap(const Chest& c, const imaging::MaskVolume& mask, Truth truth, Tissue tissue) {
  Overlap o;
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) {
    const bool is = c.truth.voxels[n] == truth, found = mask.voxels[n] == static_cast<std::uint8_t>(tissue);
    o.truth += is ? 1 : 0;
    o.found += found ? 1 : 0;
    o.both += is && found ? 1 : 0;
    o.lost_lumen += found && c.truth.voxels[n] == lumen ? 1 : 0;
    o.lost_lung += found && c.truth.voxels[n] == lung ? 1 : 0;
  }
  return o;
}

TEST(TissueRemoval, TakesBonesAlsoWhereAVesselTouchesThem) {
  const Chest c = chest(20.0);
  TissueOptions what;
  what.bone = true;
  for (const std::vector<Vec3>& seeds : {std::vector<Vec3>{c.in_lumen, c.in_touching}, std::vector<Vec3>{}}) {
    const Overlap o = overlap(c, tissues_to_remove(c.image, seeds, what), bone, Tissue::bone);
    EXPECT_GE(o.dice(), 0.95);
    EXPECT_EQ(o.lost_lumen, 0);
  }
}

TEST(TissueRemoval, ASeedInABoneMeansThatItIsNone) {
  const Chest c = chest(20.0);
  TissueOptions what;
  what.bone = true;
  const Overlap o =
      overlap(c, tissues_to_remove(c.image, {Vec3(33.0, 48.0, 12.0)}, what), bone, Tissue::bone);
  EXPECT_GT(o.both, 0.2 * o.truth);  // the rib
  EXPECT_LT(o.both, 0.6 * o.truth);
}

TEST(TissueRemoval, TakesCalciumAndLeavesTheLumen) {
  const Chest c = chest(20.0);
  TissueOptions what;
  what.calcium = true;
  what.bone = true;
  const Overlap o = overlap(c, tissues_to_remove(c.image, {c.in_lumen}, what), calcium, Tissue::calcium);
  EXPECT_EQ(o.both, o.truth);
  EXPECT_LT(o.found, 2 * o.truth);         // nothing but what blooms about it
  EXPECT_LT(o.lost_lumen, 0.5 * o.truth);  // beside the spot alone; the tube has 9,600 voxels
  what.largest_calcium_mm3 = 1.0;
  EXPECT_EQ(overlap(c, tissues_to_remove(c.image, {c.in_lumen}, what), calcium, Tissue::calcium).found, 0);
}

TEST(TissueRemoval, TakesSkinAndNotWhatLiesBesideALung) {
  const Chest c = chest(20.0);
  TissueOptions what;
  what.skin = true;
  const Overlap o = overlap(c, tissues_to_remove(c.image, {}, what), skin, Tissue::skin);
  EXPECT_GT(o.both, 0.95 * o.truth);
  EXPECT_EQ(o.lost_lumen, 0);
  EXPECT_EQ(o.lost_lung, 0);
}

TEST(TissueRemoval, FillsWithSoftTissueAndKeepsTheRest) {
  const Chest c = chest(20.0);
  TissueOptions what;
  what.bone = true;
  const imaging::MaskVolume mask = tissues_to_remove(c.image, {c.in_lumen}, what);
  const imaging::ImageVolume left = without_tissues(c.image, mask, 50.0);
  for (std::size_t n = 0; n < mask.voxels.size(); ++n)
    ASSERT_EQ(left.voxels[n], mask.voxels[n] != 0 ? 50 : c.image.voxels[n]);
  imaging::MaskVolume other = mask;
  other.geometry.origin.x() += 1.0;
  EXPECT_THROW(without_tissues(c.image, other, 50.0), InvalidInput);
  TissueOptions nothing;
  EXPECT_THAT(tissues_to_remove(c.image, {}, nothing).voxels, ::testing::Each(0));
}

TEST(TissueRemoval, RefusesBadOptionsByNameAndCanBeCancelled) {
  const Chest c = chest(0.0);
  const auto refused = [&](const TissueOptions& options, const std::string& name) {
    try {
      tissues_to_remove(c.image, {c.in_lumen}, options);
      ADD_FAILURE() << name;
    } catch (const InvalidInput& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr(name));
    }
  };
  TissueOptions bad;
  bad.shell_hu = bad.candidate_hu;
  refused(bad, "shell_hu");
  bad = {};
  bad.skin_mm = 0.0;
  refused(bad, "skin_mm");
  bad = {};
  bad.contact_mm = 9.0;
  refused(bad, "contact_mm");
  bad = {};
  bad.fill_hu = std::nan("");
  refused(bad, "fill_hu");
  TissueOptions what;
  what.calcium = true;
  EXPECT_THROW(tissues_to_remove(c.image, {}, what), InvalidInput);  // no point in the lumen
  EXPECT_THROW(tissues_to_remove(c.image, {Vec3(-50, 0, 0)}, what), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  what.bone = true;
  EXPECT_THROW(tissues_to_remove(c.image, {c.in_lumen}, what, task), Cancelled);
}

}  // namespace
}  // namespace ostia::segmentation
