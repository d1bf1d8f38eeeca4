#include "shared_data.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/image_file.h"
#include "ostia/segmentation/segment.h"

#include <gtest/gtest.h>

namespace ostia::segmentation {
namespace {

/// Dice of the region phi < 0 and a mask, over voxels between the planes through `from` and `to` and near the
/// line.
double dice(const SegmentationResult& result, const imaging::MaskVolume& mask, const Vec3& from,
            const Vec3& to, double radius) {
  const imaging::Geometry& g = mask.geometry;
  const Vec3 axis = (to - from).normalized();
  std::int64_t ours = 0;
  std::int64_t theirs = 0;
  std::int64_t both = 0;
  for (std::int64_t k = 0; k < g.size[2]; ++k) {
    for (std::int64_t j = 0; j < g.size[1]; ++j) {
      for (std::int64_t i = 0; i < g.size[0]; ++i) {
        const Vec3 away =
            g.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))) - from;
        const double along = away.dot(axis);
        if (along < 0.0 || along > (to - from).norm() || (away - along * axis).norm() > radius) continue;
        const imaging::Region& box = result.region;
        const bool in_box = i >= box.lower[0] && j >= box.lower[1] && k >= box.lower[2] && i < box.upper[0] &&
                            j < box.upper[1] && k < box.upper[2];
        const bool inside =
            in_box && result.level_set(i - box.lower[0], j - box.lower[1], k - box.lower[2]) < 0.0F;
        const bool reference = mask(i, j, k) != 0;
        ours += inside ? 1 : 0;
        theirs += reference ? 1 : 0;
        both += inside && reference ? 1 : 0;
      }
    }
  }
  return 2.0 * static_cast<double>(both) / static_cast<double>(ours + theirs);
}

TEST(SegmentReal, AscendingAortaAndArch) {
  OSTIA_REQUIRE_SHARED(image_path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  OSTIA_REQUIRE_SHARED(mask_path, "cta/totalsegmentator-aorta-cta/aorta_true_lumen.nii.gz");
  const auto image = imaging::read_image(image_path).volume;
  const auto mask = imaging::read_mask(mask_path).volume;
  const std::vector<BranchSeeds> branches{
      {Vec3(4.8, -185.2, 666.2), std::nullopt, Vec3(15.3, -164.2, 742.7)},
      {Vec3(15.3, -164.2, 742.7), std::nullopt, Vec3(22.8, -111.7, 684.2)}};
  const SegmentationResult result = segment_vessels(image, branches);
  const double score = dice(result, mask, Vec3(8.5, -187.6, 675.2), Vec3(5.6, -177.9, 720.2), 25.0);
  RecordProperty("dice", std::to_string(score));
  EXPECT_GE(score, 0.96);
  EXPECT_TRUE(result.converged) << result.rms_voxels;
  const auto mesh = surface_of(result.level_set, {branches[0].from});
  const auto faults = geometry::find_faults(mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 1U);
  EXPECT_EQ(faults.self_intersections, 0U);
}

TEST(SegmentReal, TrueLumenOfTheDescendingAorta) {
  OSTIA_REQUIRE_SHARED(image_path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  OSTIA_REQUIRE_SHARED(mask_path, "cta/totalsegmentator-aorta-cta/aorta_true_lumen.nii.gz");
  const auto image = imaging::read_image(image_path).volume;
  const auto mask = imaging::read_mask(mask_path).volume;
  const BranchSeeds branch{Vec3(19.8, -120.7, 720.2), Vec3(22.8, -119.2, 648.2), Vec3(1.8, -144.7, 585.2)};
  SegmentOptions options;
  options.bright_is_lumen = true;  // the stent counts as lumen in the reference
  const SegmentationResult result = segment_vessels(image, {branch}, options);
  const double score = dice(result, mask, branch.from, branch.to, 30.0);
  RecordProperty("dice", std::to_string(score));
  EXPECT_GE(score, 0.90);
}

}  // namespace
}  // namespace ostia::segmentation
