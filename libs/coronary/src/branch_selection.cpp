#include "branch_selection.h"

#include "voxel_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::coronary {
namespace {

using Voxels = std::unordered_set<std::int64_t>;

/// Takes branches off the ways of a front, the longest first.
class BranchPicker {
 public:
  BranchPicker(const FrontNodes& nodes, const imaging::FloatVolume& tube,
               const imaging::FloatVolume& radius_mm, const Voxels& unseen, double least_branch_mm,
               const std::optional<VeinLook>& veins)
      : nodes_(nodes),
        tube_(tube),
        radius_mm_(radius_mm),
        unseen_(unseen),
        least_branch_mm_(least_branch_mm),
        veins_(veins) {
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
    if (voxel >= 0 && dismissed_.contains(voxel)) {
      dismiss(way, way.size());
      return;
    }
    if (const std::size_t vein = veins_ ? voxels_in_vein(*veins_, nodes_, tube_, radius_mm_, way) : 0;
        vein > 0) {
      dismiss(way, vein);
      return;
    }
    if (!is_branch(end, voxel, way)) {
      // Nothing that hangs on this way is longer.
      for (const std::int64_t passed : way) covered_[static_cast<std::size_t>(passed)] = 1;
      return;
    }
    GrownBranch branch;
    branch.ostium = static_cast<std::size_t>(nodes_.at(end).of);
    if (voxel >= 0) {
      const auto [parent, point] = nearest_place(voxel_place(tube_.geometry, voxel));
      branch.parent = parent;
      branch.parent_point = point;
      lead_out(branches_[static_cast<std::size_t>(parent)], point, way.back(), branch);
    }
    std::reverse(way.begin(), way.end());
    for (const std::int64_t passed : way) {
      if (unseen_.contains(passed)) add_to_gap(branch);
      branch.points.push_back(voxel_place(tube_.geometry, passed));
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
    const auto [parent, point] = nearest_place(voxel_place(tube_.geometry, leaves));
    const Vec3& from = branches_[static_cast<std::size_t>(parent)].points[point];
    if (beyond_mm + (voxel_place(tube_.geometry, leaves) - from).norm() < least_branch_mm_) return false;
    std::vector<float> tube;
    for (const std::int64_t voxel : way) tube.push_back(tube_.voxels[static_cast<std::size_t>(voxel)]);
    const auto middle = tube.begin() + static_cast<std::ptrdiff_t>(tube.size() / 2);
    std::nth_element(tube.begin(), middle, tube.end());
    return *middle >= clear_tube;
  }

  /// The first of a way, and what hangs on them.
  void dismiss(const std::vector<std::int64_t>& way, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      covered_[static_cast<std::size_t>(way[i])] = 1;
      dismissed_.insert(way[i]);
    }
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
    const Vec3 from = trunk.points[point], way = voxel_place(tube_.geometry, to) - from;
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
    const GridIndex at = grid_index(grid, voxel);
    GridIndex low{}, high{};
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
  const std::optional<VeinLook>& veins_;
  std::vector<std::uint8_t> covered_;
  Voxels dismissed_;
  std::vector<GrownBranch> branches_;
};

}  // namespace

std::vector<GrownBranch> branches_on(const FrontNodes& nodes, const imaging::FloatVolume& tube,
                                     const imaging::FloatVolume& radius_mm,
                                     const std::unordered_set<std::int64_t>& unseen, double least_branch_mm,
                                     const std::optional<VeinLook>& veins) {
  return BranchPicker(nodes, tube, radius_mm, unseen, least_branch_mm, veins).pick();
}

}  // namespace ostia::coronary
