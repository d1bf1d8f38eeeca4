#include "path/prepared_image.h"

namespace ostia::segmentation::detail {

namespace {

bool removes(const TissueOptions& options) {
  return options.bone || options.calcium || options.skin;
}

}  // namespace

bool needs_preparation(const SegmentOptions& options) {
  return options.denoise.has_value() || removes(options.remove);
}

imaging::ImageVolume prepared_image(const imaging::ImageVolume& image,
                                    const std::vector<BranchSeeds>& branches, const SegmentOptions& options,
                                    const core::TaskContext& task) {
  imaging::ImageVolume out;
  const double removed = options.denoise ? 0.3 : 1.0;
  if (removes(options.remove)) {
    task.set_stage("removing tissues");
    std::vector<Vec3> seeds;
    for (const BranchSeeds& branch : branches) {
      seeds.push_back(branch.from);
      if (branch.through) seeds.push_back(*branch.through);
      seeds.push_back(branch.to);
    }
    out = without_tissues(image, tissues_to_remove(image, seeds, options.remove, task.sub(0.0, removed)),
                          options.remove.fill_hu);
  }
  if (!options.denoise) return out;
  task.set_stage("denoising");
  return imaging::diffused(removes(options.remove) ? out : image, *options.denoise, task.sub(removed, 1.0));
}

}  // namespace ostia::segmentation::detail
