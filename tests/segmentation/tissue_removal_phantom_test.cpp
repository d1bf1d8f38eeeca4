#include "ostia/phantom/phantom_case.h"
#include "ostia/segmentation/tissue_removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace ostia::segmentation {
namespace {

using phantom::Label;

bool is_bone(Label label) {
  return label == Label::bone || label == Label::marrow;
}

/// Small veins touch ribs and vertebrae, closer than a voxel.
bool may_touch_bone(Label label) {
  return label == Label::pulmonary_vessel || label == Label::vein;
}

/// Everything else that carries contrast.
bool is_blood(Label label) {
  switch (label) {
    case Label::coronary_lumen:
    case Label::aorta:
    case Label::left_ventricle:
    case Label::right_ventricle:
    case Label::left_atrium:
    case Label::right_atrium:
    case Label::pulmonary_artery:
    case Label::coronary_vein:
      return true;
    default:
      return false;
  }
}

struct Found {
  double dice = 0.0;
  std::int64_t bone = 0;
  std::map<Label, std::int64_t> lost;
};

Found found_in(const phantom::Scan& scan, const imaging::MaskVolume& mask) {
  Found found;
  std::int64_t both = 0, taken = 0;
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) {
    const auto label = static_cast<Label>(scan.labels.voxels[n]);
    const bool removed = mask.voxels[n] != 0;
    found.bone += is_bone(label) ? 1 : 0;
    taken += removed ? 1 : 0;
    both += removed && is_bone(label) ? 1 : 0;
    if (removed && !is_bone(label)) ++found.lost[label];
  }
  found.dice = 2.0 * static_cast<double>(both) / static_cast<double>(found.bone + taken);
  return found;
}

class BoneRemovalOnPhantoms : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(BoneRemovalOnPhantoms, FindsTheBonesAndTakesNoBlood) {
  phantom::CaseOptions options;
  options.preset = phantom::Preset::small;
  options.seed = GetParam();
  const phantom::CasePlan plan = phantom::plan_case(options);
  const phantom::Scan scan = phantom::scan_case(plan);
  std::vector<Vec3> lumen;
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels)
    if (vessel.name == "LAD" || vessel.name == "RCA")
      lumen.push_back(vessel.axis.points[vessel.axis.size() / 4]);
  TissueOptions what;
  what.bone = true;
  const Found found = found_in(scan, tissues_to_remove(scan.image, lumen, what));
  ASSERT_GT(found.bone, 100000);  // ribs, sternum and vertebrae of the field of view
  EXPECT_GE(found.dice, 0.95);
  std::int64_t blood = 0, veins = 0;
  for (const auto& [label, voxels] : found.lost) {
    if (is_blood(label)) blood += voxels;
    if (may_touch_bone(label)) veins += voxels;
  }
  EXPECT_EQ(blood, 0);
  EXPECT_LT(veins, 250);
  RecordProperty("dice", std::to_string(found.dice));
}

INSTANTIATE_TEST_SUITE_P(Seeds, BoneRemovalOnPhantoms, ::testing::Values(1, 4));

}  // namespace
}  // namespace ostia::segmentation
