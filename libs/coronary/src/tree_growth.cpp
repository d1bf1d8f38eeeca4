#include "ostia/coronary/tree_growth.h"

#include "branch_selection.h"
#include "candidate_voxels.h"
#include "gap_bridges.h"
#include "tube_front.h"

#include "ostia/core/error.h"
#include "ostia/segmentation/vesselness.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

namespace ostia::coronary {
namespace {

void check_growth_option(const char* name, double value, double low, double high, const char* unit) {
  if (!(value >= low && value <= high))
    throw InvalidInput(std::string("growth of the coronary tree: ") + name + " is " + std::to_string(value) +
                       unit + "; give " + std::to_string(low) + " to " + std::to_string(high));
}

/// Voxels in and just outside the aorta's wall where the ostia are.
std::vector<FrontSource> sources_at(const imaging::Geometry& grid, const std::vector<Ostium>& ostia) {
  constexpr double inwards_mm = 1.0, outwards_mm = 2.0, step_mm = 0.25;
  std::vector<FrontSource> sources;
  for (std::size_t i = 0; i < ostia.size(); ++i)
    for (double s = -inwards_mm; s <= outwards_mm; s += step_mm) {
      const Vec3 place = ostia[i].place + s * ostia[i].direction;
      if (!grid.contains(place)) continue;
      const Vec3 at = grid.index(place);
      sources.push_back({grid.offset(std::lround(at.x()), std::lround(at.y()), std::lround(at.z())), i});
    }
  return sources;
}

/// Fronts and their branches; what is found across a gap lets the next front through.
class Growing {
 public:
  Growing(const imaging::ImageVolume& image, const std::vector<Ostium>& ostia, const GrowthOptions& options,
          const segmentation::VesselnessOptions& tubes, double contrast_hu, segmentation::Vesselness& seen)
      : image_(image),
        options_(options),
        tubes_(tubes),
        contrast_hu_(contrast_hu),
        tube_(seen.response_hu),
        radius_mm_(seen.radius_mm),
        sources_(sources_at(image.geometry, ostia)) {}

  GrownTree run(const core::TaskContext& task) {
    constexpr int most_gaps = 16;  // far more than there are in a heart
    for (int n = 0;; ++n) {
      const FrontNodes nodes = run_tube_front(tube_, sources_, options_.least_tube, task);
      GrownTree tree;
      tree.voxels = static_cast<std::int64_t>(nodes.size());
      tree.branches = branches_on(nodes, tube_, radius_mm_, unseen_, options_.least_branch_mm);
      if (n == most_gaps || !bridge_one(nodes, tree.branches, task)) return tree;
    }
  }

 private:
  /// The first gap that can be bridged: what lies behind one may have two ways to it.
  bool bridge_one(const FrontNodes& nodes, const std::vector<GrownBranch>& branches,
                  const core::TaskContext& task) {
    if (options_.longest_gap_mm == 0.0) return false;
    const GrownFront front{image_, tube_,           radius_mm_,   nodes,
                           tubes_, options_.fat_hu, contrast_hu_, options_.least_tube};
    for (const GrownBranch& branch : branches) {
      const Vec3& end = branch.points.back();
      if (std::find(tried_.begin(), tried_.end(), end) != tried_.end()) continue;
      const Bridge bridge = bridge_ahead(front, branch, options_.longest_gap_mm, task);
      if (!bridge.voxels.empty()) {
        open(bridge);
        return true;
      }
      tried_.push_back(end);
    }
    return false;
  }

  void open(const Bridge& bridge) {
    const auto least = static_cast<float>(options_.least_tube);
    for (std::size_t i = 0; i < bridge.voxels.size(); ++i) {
      const auto at = static_cast<std::size_t>(bridge.voxels[i]);
      if (tube_.voxels[at] >= least) continue;
      tube_.voxels[at] = least;
      radius_mm_.voxels[at] = bridge.radius_mm[i];
      unseen_.insert(bridge.voxels[i]);
    }
  }

  const imaging::ImageVolume& image_;
  const GrowthOptions& options_;
  const segmentation::VesselnessOptions& tubes_;
  double contrast_hu_;
  imaging::FloatVolume& tube_;
  imaging::FloatVolume& radius_mm_;
  std::vector<FrontSource> sources_;
  std::unordered_set<std::int64_t> unseen_;
  std::vector<Vec3> tried_;  // ends behind which there is nothing
};

}  // namespace

void validate(const GrowthOptions& options) {
  check_growth_option("the wall's intensity", options.wall_hu, -100.0, 150.0, " HU");
  check_growth_option("the fat's intensity", options.fat_hu, -200.0, 50.0, " HU");
  check_growth_option("the least contrast", options.least_contrast, 0.1, 0.6, "");
  check_growth_option("the least likeness to a tube", options.least_tube, 0.1, 0.6, "");
  check_growth_option("the largest radius", options.largest_radius_mm, 2.0, 8.0, " mm");
  check_growth_option("the least branch", options.least_branch_mm, 2.0, 50.0, " mm");
  check_growth_option("the longest gap", options.longest_gap_mm, 0.0, 20.0, " mm");
}

GrownTree grow_tree(const imaging::ImageVolume& image, const Aorta& aorta, const std::vector<Ostium>& ostia,
                    const GrowthOptions& options, const core::TaskContext& task) {
  validate(options);
  if (ostia.empty()) throw InvalidInput("growth of the coronary tree: there is no ostium to start from");
  const double level = options.wall_hu + options.least_contrast * (aorta.lumen_hu - options.wall_hu);
  const double contrast = aorta.lumen_hu - options.fat_hu;
  segmentation::VesselnessOptions tubes;
  tubes.method = options.likeness;
  tubes.least_hu = options.fat_hu - 30.0;  // lung is no darker wall than fat
  tubes.most_hu = 1.25 * aorta.lumen_hu;   // nor calcium a brighter lumen
  segmentation::Vesselness seen;
  {
    const imaging::MaskVolume mask =
        vessel_candidates(image, level, options.largest_radius_mm, task.sub(0.0, 0.1));
    seen = segmentation::vesselness(image, {.mask = &mask}, tubes, task.sub(0.1, 0.9));
  }
  for (float& value : seen.response_hu.voxels) value /= static_cast<float>(contrast);
  GrownTree tree = Growing(image, ostia, options, tubes, contrast, seen).run(task.sub(0.9, 1.0));
  task.set_progress(1.0);
  return tree;
}

}  // namespace ostia::coronary
