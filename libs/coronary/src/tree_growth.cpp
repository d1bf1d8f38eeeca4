#include "ostia/coronary/tree_growth.h"

#include "branch_selection.h"
#include "candidate_voxels.h"
#include "gap_bridges.h"
#include "lost_beginnings.h"
#include "tube_front.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/segmentation/vesselness.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_set>

namespace ostia::coronary {
namespace {

void check_growth_option(const char* name, double value, double low, double high, const char* unit) {
  if (!(value >= low && value <= high))
    throw InvalidInput(std::string("growth of the coronary tree: ") + name + " is " + std::to_string(value) +
                       unit + "; give " + std::to_string(low) + " to " + std::to_string(high));
}

/// What noise looks like a tube by chance is no way for a front.
GrowthOptions above_noise(GrowthOptions options, double contrast_hu) {
  constexpr double least = 0.05, by_chance = 1.6;  // of the noise's share of the contrast
  constexpr double most = 0.6;
  options.least_tube = std::clamp(least + by_chance * options.noise_hu / contrast_hu, options.least_tube,
                                  std::max(most, options.least_tube));
  return options;
}

/// Noise makes single voxels of a vessel darker than it is.
double candidate_level(const GrowthOptions& options, double lumen_hu) {
  constexpr double borne_hu = 40.0, share = 1.0;
  return options.wall_hu + options.least_contrast * (lumen_hu - options.wall_hu) -
         share * std::max(0.0, options.noise_hu - borne_hu);
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

/// Where noise hides the fat between them, the front comes from arteries into the veins beside them. (An
/// artery that moves is as faint as a vein: without noise they are not told apart so.)
std::optional<VeinLook> veins_in(const imaging::ImageVolume& image, const GrowthOptions& options,
                                 double contrast_hu) {
  constexpr double hiding_noise = 0.1;  // as a share of the contrast
  if (options.noise_hu < hiding_noise * contrast_hu) return std::nullopt;
  return VeinLook{image, options.fat_hu, contrast_hu};
}

/// Fronts and their branches; what is found across a gap lets the next front through.
class Growing {
 public:
  Growing(const imaging::ImageVolume& image, const Aorta& aorta, const std::vector<Ostium>& ostia,
          const GrowthOptions& options, const segmentation::VesselnessOptions& tubes,
          segmentation::Vesselness& seen)
      : image_(image),
        aorta_(aorta),
        options_(options),
        tubes_(tubes),
        contrast_hu_(aorta.lumen_hu - options.fat_hu),
        tube_(seen.response_hu),
        radius_mm_(seen.radius_mm),
        veins_(veins_in(image, options, contrast_hu_)),
        open_(ostia.size()),
        sources_(sources_at(image.geometry, ostia)) {}

  GrownTree run(const core::TaskContext& task) {
    constexpr int most_gaps = 16;  // far more than there are in a heart
    for (int n = 0;; ++n) {
      const FrontNodes nodes = run_tube_front(tube_, sources_, options_.least_tube, task);
      GrownTree tree;
      tree.voxels = static_cast<std::int64_t>(nodes.size());
      tree.branches = branches_on(nodes, tube_, radius_mm_, unseen_, options_.least_branch_mm, veins_);
      if (n < most_gaps && bridge_one(nodes, tree.branches, task)) continue;
      if (find_lost(nodes, tree.branches, task)) continue;
      tree.lost = lost_;
      return tree;
    }
  }

 private:
  /// Where fewer than two trees leave the aorta, another may begin beyond its wall. Looked for once.
  bool find_lost(const FrontNodes& nodes, const std::vector<GrownBranch>& branches,
                 const core::TaskContext& task) {
    constexpr double least_tree_mm = 30.0;
    constexpr std::size_t trees_of_a_heart = 2;
    if (looked_for_lost_) return false;
    looked_for_lost_ = true;
    std::vector<double> length_mm(open_, 0.0);
    for (const GrownBranch& branch : branches) length_mm[branch.ostium] += geometry::length(branch.points);
    const auto trees = static_cast<std::size_t>(
        std::count_if(length_mm.begin(), length_mm.end(), [&](double mm) { return mm >= least_tree_mm; }));
    if (trees >= trees_of_a_heart) return false;
    const LeftBehind left{image_,   tube_,           radius_mm_,       nodes,
                          branches, options_.fat_hu, options_.wall_hu, options_.least_tube};
    lost_ = beginnings_beyond_wall(left, aorta_, options_.farthest_beginning_mm, task);
    lost_.resize(std::min(lost_.size(), trees_of_a_heart - trees));
    for (FrontSource source : sources_at(image_.geometry, lost_)) {
      source.of += open_;
      sources_.push_back(source);
    }
    return !lost_.empty();
  }

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
  const Aorta& aorta_;
  const GrowthOptions& options_;
  const segmentation::VesselnessOptions& tubes_;
  double contrast_hu_;
  imaging::FloatVolume& tube_;
  imaging::FloatVolume& radius_mm_;
  std::optional<VeinLook> veins_;
  std::size_t open_;  // ostia on the aorta's wall
  std::vector<FrontSource> sources_;
  std::vector<Ostium> lost_;
  bool looked_for_lost_ = false;
  std::unordered_set<std::int64_t> unseen_;
  std::vector<Vec3> tried_;  // ends behind which there is nothing
};

}  // namespace

void validate(const GrowthOptions& options) {
  check_growth_option("the wall's intensity", options.wall_hu, -100.0, 150.0, " HU");
  check_growth_option("the fat's intensity", options.fat_hu, -200.0, 50.0, " HU");
  check_growth_option("the least contrast", options.least_contrast, 0.1, 0.6, "");
  check_growth_option("the least likeness to a tube", options.least_tube, 0.1, 0.6, "");
  check_growth_option("the noise", options.noise_hu, 0.0, 500.0, " HU");
  check_growth_option("the image's blur", options.image_blur_mm, 0.0, 1.5, " mm");
  check_growth_option("the largest radius", options.largest_radius_mm, 2.0, 8.0, " mm");
  check_growth_option("the least branch", options.least_branch_mm, 2.0, 50.0, " mm");
  check_growth_option("the longest gap", options.longest_gap_mm, 0.0, 20.0, " mm");
  check_growth_option("the farthest beginning", options.farthest_beginning_mm, 0.0, 30.0, " mm");
}

GrownTree grow_tree(const imaging::ImageVolume& image, const Aorta& aorta, const std::vector<Ostium>& ostia,
                    const GrowthOptions& given, const core::TaskContext& task) {
  validate(given);
  if (ostia.empty() && (aorta.stations.empty() || given.farthest_beginning_mm == 0.0))
    throw InvalidInput("growth of the coronary tree: there is no ostium to start from");
  const double contrast = aorta.lumen_hu - given.fat_hu;
  const GrowthOptions options = above_noise(given, contrast);
  const double level = candidate_level(options, aorta.lumen_hu);
  segmentation::VesselnessOptions tubes;
  tubes.method = options.likeness;
  tubes.image_blur_mm = options.image_blur_mm;
  tubes.least_hu = options.fat_hu - 30.0;  // lung is no darker wall than fat
  tubes.most_hu = 1.25 * aorta.lumen_hu;   // nor calcium a brighter lumen
  segmentation::Vesselness seen;
  {
    const imaging::MaskVolume mask =
        vessel_candidates(image, level, options.largest_radius_mm, task.sub(0.0, 0.1));
    seen = segmentation::vesselness(image, {.mask = &mask}, tubes, task.sub(0.1, 0.9));
  }
  for (float& value : seen.response_hu.voxels) value /= static_cast<float>(contrast);
  GrownTree tree = Growing(image, aorta, ostia, options, tubes, seen).run(task.sub(0.9, 1.0));
  task.set_progress(1.0);
  return tree;
}

}  // namespace ostia::coronary
