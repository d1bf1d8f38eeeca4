#include "ostia/coronary/tree_growth.h"

#include "candidates.h"
#include "gap_bridges.h"
#include "tube_front.h"

#include "ostia/core/error.h"
#include "ostia/segmentation/vesselness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_set>
#include <utility>

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

Vec3 world_of(const imaging::Geometry& grid, std::int64_t voxel) {
  return grid.world(Vec3(static_cast<double>(voxel % grid.size[0]),
                         static_cast<double>(voxel / grid.size[0] % grid.size[1]),
                         static_cast<double>(voxel / (grid.size[0] * grid.size[1]))));
}

using Voxels = std::unordered_set<std::int64_t>;

/// Takes branches off the ways of a front, the longest first.
class BranchPicker {
 public:
  BranchPicker(const FrontNodes& nodes, const imaging::FloatVolume& tube,
               const imaging::FloatVolume& radius_mm, const Voxels& unseen, double least_branch_mm)
      : nodes_(nodes),
        tube_(tube),
        radius_mm_(radius_mm),
        unseen_(unseen),
        least_branch_mm_(least_branch_mm) {
    covered_.assign(tube.voxels.size(), 0);
  }

  std::vector<GrownBranch> pick() {
    std::vector<std::int64_t> order;
    for (const auto& [voxel, node] : nodes_) order.push_back(voxel);
    std::sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
      const float la = nodes_.at(a).length_mm, lb = nodes_.at(b).length_mm;
      return la != lb ? la > lb : a < b;
    });
    for (const std::int64_t end : order)
      if (!covered_[static_cast<std::size_t>(end)]) try_branch(end);
    return std::move(branches_);
  }

 private:
  /// The way back from its end to where it enters what is covered; there it joins the nearest place of the
  /// branch that covers it. (Cheapest ways run side by side long before they meet.)
  void try_branch(std::int64_t end) {
    std::vector<std::int64_t> way;
    std::int64_t voxel = end;
    while (voxel >= 0 && !covered_[static_cast<std::size_t>(voxel)]) {
      way.push_back(voxel);
      voxel = nodes_.at(voxel).before;
    }
    if (!is_branch(end, voxel, way)) {
      // Nothing that hangs on this way is longer.
      for (const std::int64_t passed : way) covered_[static_cast<std::size_t>(passed)] = 1;
      return;
    }
    GrownBranch branch;
    branch.ostium = static_cast<std::size_t>(nodes_.at(end).of);
    if (voxel >= 0) {
      const auto [parent, point] = nearest_place(world_of(tube_.geometry, voxel));
      branch.parent = parent;
      branch.parent_point = point;
      lead_out(branches_[static_cast<std::size_t>(parent)], point, way.back(), branch);
    }
    std::reverse(way.begin(), way.end());
    for (const std::int64_t passed : way) {
      if (unseen_.contains(passed)) add_to_gap(branch);
      branch.points.push_back(world_of(tube_.geometry, passed));
      branch.radius_mm.push_back(radius_mm_.voxels[static_cast<std::size_t>(passed)]);
      branch.tube.push_back(tube_.voxels[static_cast<std::size_t>(passed)]);
      cover(passed);
    }
    branches_.push_back(std::move(branch));
  }

  /// Long enough beyond the lumen it leaves or, where it is a clear tube, from its parent's middle: as far as
  /// the axis will run.
  bool is_branch(std::int64_t end, std::int64_t leaves, const std::vector<std::int64_t>& way) const {
    constexpr float clear_tube = 0.5F;
    constexpr double least_part = 0.5;  // that must lie beyond the lumen: a bump is no branch
    if (leaves < 0) return nodes_.at(end).length_mm >= least_branch_mm_;
    const double beyond_mm = nodes_.at(end).length_mm - nodes_.at(leaves).length_mm;
    if (beyond_mm >= least_branch_mm_) return true;
    if (beyond_mm < least_part * least_branch_mm_) return false;
    const auto [parent, point] = nearest_place(world_of(tube_.geometry, leaves));
    const Vec3& from = branches_[static_cast<std::size_t>(parent)].points[point];
    if (beyond_mm + (world_of(tube_.geometry, leaves) - from).norm() < least_branch_mm_) return false;
    std::vector<float> tube;
    for (const std::int64_t voxel : way) tube.push_back(tube_.voxels[static_cast<std::size_t>(voxel)]);
    const auto middle = tube.begin() + static_cast<std::ptrdiff_t>(tube.size() / 2);
    std::nth_element(tube.begin(), middle, tube.end());
    return *middle >= clear_tube;
  }

  /// From the place before to the one behind what is not seen.
  static void add_to_gap(GrownBranch& branch) {
    const std::size_t here = branch.points.size();
    if (branch.gaps.empty() || branch.gaps.back().second != here)
      branch.gaps.emplace_back(here > 0 ? here - 1 : 0, here);
    branch.gaps.back().second = here + 1;
  }

  /// A straight line from a place of the trunk to just before the voxel where a branch leaves its lumen.
  void lead_out(const GrownBranch& trunk, std::size_t point, std::int64_t to, GrownBranch& branch) const {
    constexpr double step_mm = 0.5;
    const Vec3 from = trunk.points[point], way = world_of(tube_.geometry, to) - from;
    const double width = radius_mm_.voxels[static_cast<std::size_t>(to)];
    const double likeness = tube_.voxels[static_cast<std::size_t>(to)];
    const auto steps = std::max<std::size_t>(1, static_cast<std::size_t>(way.norm() / step_mm));
    for (std::size_t k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(steps);
      branch.points.push_back(from + t * way);
      branch.radius_mm.push_back(std::lerp(trunk.radius_mm[point], width, t));
      branch.tube.push_back(std::lerp(trunk.tube[point], likeness, t));
    }
  }

  std::pair<std::int32_t, std::size_t> nearest_place(const Vec3& to) const {
    std::pair<std::int32_t, std::size_t> best{0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < branches_.size(); ++b)
      for (std::size_t i = 0; i < branches_[b].points.size(); ++i) {
        const double away = (branches_[b].points[i] - to).squaredNorm();
        if (away >= least) continue;
        least = away;
        best = {static_cast<std::int32_t>(b), i};
      }
    return best;
  }

  /// What lies within the lumen about a voxel of a branch is no branch of its own.
  void cover(std::int64_t voxel) {
    constexpr double wider = 1.3, and_mm = 0.7;
    const imaging::Geometry& grid = tube_.geometry;
    const double reach_mm = wider * radius_mm_.voxels[static_cast<std::size_t>(voxel)] + and_mm;
    std::array<std::int64_t, 3> at{voxel % grid.size[0], voxel / grid.size[0] % grid.size[1],
                                   voxel / (grid.size[0] * grid.size[1])};
    std::array<std::int64_t, 3> low{}, high{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto reach = static_cast<std::int64_t>(reach_mm / grid.spacing[static_cast<Eigen::Index>(a)]);
      low[a] = std::max<std::int64_t>(0, at[a] - reach);
      high[a] = std::min(grid.size[a] - 1, at[a] + reach);
    }
    for (std::int64_t k = low[2]; k <= high[2]; ++k)
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
          const Vec3 away(static_cast<double>(i - at[0]), static_cast<double>(j - at[1]),
                          static_cast<double>(k - at[2]));
          if (grid.spacing.cwiseProduct(away).squaredNorm() <= reach_mm * reach_mm)
            covered_[static_cast<std::size_t>(grid.offset(i, j, k))] = 1;
        }
  }

  const FrontNodes& nodes_;
  const imaging::FloatVolume& tube_;
  const imaging::FloatVolume& radius_mm_;
  const Voxels& unseen_;
  double least_branch_mm_;
  std::vector<std::uint8_t> covered_;
  std::vector<GrownBranch> branches_;
};

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
      tree.branches = BranchPicker(nodes, tube_, radius_mm_, unseen_, options_.least_branch_mm).pick();
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
  Voxels unseen_;
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
