#include "gap_bridges.h"

#include "median.h"
#include "voxel_places.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_set>
#include <utility>

namespace ostia::coronary {
namespace {

constexpr double degrees = std::numbers::pi / 180.0;
constexpr double shortest_end_mm = 6.0;  // a shorter branch has no direction
constexpr double least_end_tube = 0.4;   // what fades away has ended
constexpr double cone_deg = 40.0;        // about the branch's direction
constexpr double least_gap_tube = 0.12;  // plaque in fat, or lumen that the blur thins
constexpr double least_far_tube = 0.5;   // of the branch's own: the vessel behind is one
constexpr double far_look_mm = 6.0;      // of the vessel behind, how far it is looked at
constexpr double far_least_mm = 5.0;     // it is at least so long
constexpr double far_one_sided = 0.6;    // 1: all of it lies ahead; 0: it passes by
constexpr double far_turn_deg = 50.0;
constexpr double detour = 1.35, detour_mm = 1.0;

double angle_deg(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / degrees;
}

/// What a vessel is like along some of its voxels.
struct Calibre {
  double radius_mm = 0.0, tube = 0.0, hu = 0.0;
};

Calibre calibre_of(const GrownFront& front, const std::vector<std::int64_t>& voxels) {
  std::vector<double> radius, tube, hu;
  for (const std::int64_t voxel : voxels) {
    const auto at = static_cast<std::size_t>(voxel);
    radius.push_back(front.radius_mm.voxels[at]);
    tube.push_back(front.tube.voxels[at]);
    hu.push_back(front.image.voxels[at]);
  }
  return {median(std::move(radius)), median(std::move(tube)), median(std::move(hu))};
}

struct End {
  Vec3 place = Vec3::Zero(), ahead = Vec3::UnitZ();
  Calibre calibre;
};

/// Nothing where the branch is too short or fades away. Its last millimetres are left out of its calibre: a
/// throat narrows them.
std::optional<End> end_of(const GrownFront& front, const GrownBranch& branch) {
  constexpr double tip_mm = 2.0, back_from_mm = 5.0, back_to_mm = 8.0, calibre_from_mm = 3.0,
                   calibre_to_mm = 12.0;
  const std::vector<double> s = geometry::abscissas(branch.points);
  if (s.back() < shortest_end_mm) return std::nullopt;
  Vec3 tip = Vec3::Zero(), back = Vec3::Zero();
  double tips = 0.0, backs = 0.0;
  std::vector<std::int64_t> voxels;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double before_end = s.back() - s[i];
    if (before_end <= tip_mm) tip += branch.points[i], tips += 1.0;
    if (before_end >= back_from_mm && before_end <= back_to_mm) back += branch.points[i], backs += 1.0;
    if (before_end >= calibre_from_mm && before_end <= calibre_to_mm)
      voxels.push_back(voxel_near(front.image.geometry, branch.points[i]));
  }
  if (backs == 0.0 || voxels.empty()) return std::nullopt;
  End end;
  end.place = branch.points.back();
  end.ahead = (tip / tips - back / backs).normalized();
  end.calibre = calibre_of(front, voxels);
  if (end.calibre.tube < least_end_tube) return std::nullopt;
  return end;
}

imaging::Region box_about(const imaging::Geometry& grid, const Vec3& place, double reach_mm) {
  const Vec3 at = grid.index(place);
  imaging::Region box;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto d = static_cast<Eigen::Index>(a);
    const double reach = reach_mm / grid.spacing[d];
    box.lower[a] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(at[d] - reach)));
    box.upper[a] = std::min(grid.size[a], static_cast<std::int64_t>(std::ceil(at[d] + reach)) + 1);
  }
  return box;
}

/// The neighbourhood ahead of an end, on a grid of its own, and a front that runs from the end through all
/// that looks the least like a tube.
class Ahead {
 public:
  Ahead(const GrownFront& front, const GrownBranch& branch, const End& end, double longest_mm,
        const core::TaskContext& task)
      : whole_(front.image.geometry) {
    constexpr double tip_mm = 1.5;
    box_ = box_about(whole_, end.place, longest_mm + tip_mm);
    imaging::MaskVolume mask;
    mask.geometry = whole_;
    for (std::size_t a = 0; a < 3; ++a) mask.geometry.size[a] = box_.upper[a] - box_.lower[a];
    mask.geometry.origin = voxel_place(whole_, whole_.offset(box_.lower[0], box_.lower[1], box_.lower[2]));
    mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxels()), 0);
    const imaging::Geometry& grid = mask.geometry;
    for (std::int64_t voxel = 0; voxel < grid.voxels(); ++voxel) {
      const Vec3 to = voxel_place(grid, voxel) - end.place;
      const bool in_cone = to.norm() <= longest_mm && angle_deg(to, end.ahead) <= cone_deg;
      mask.voxels[static_cast<std::size_t>(voxel)] = to.norm() <= tip_mm || in_cone ? 1 : 0;
    }
    seen_ = segmentation::vesselness(front.image, {.region = box_, .mask = &mask}, front.tubes, task);
    for (float& value : seen_.response_hu.voxels) value /= static_cast<float>(front.contrast_hu);
    std::vector<FrontSource> sources;
    for (const Vec3& point : branch.points)
      if ((point - end.place).norm() <= tip_mm) sources.push_back({voxel_near(grid, point), 0});
    nodes_ =
        run_tube_front(seen_.response_hu, sources, std::max(least_gap_tube, 0.5 * front.least_tube), task);
  }

  /// All that was met, the nearest first.
  std::vector<std::int64_t> met() const {
    std::vector<std::int64_t> voxels;
    for (const auto& [voxel, node] : nodes_) voxels.push_back(voxel);
    std::sort(voxels.begin(), voxels.end(), [&](std::int64_t a, std::int64_t b) {
      const float ca = nodes_.at(a).cost, cb = nodes_.at(b).cost;
      return ca != cb ? ca < cb : a < b;
    });
    return voxels;
  }

  std::int64_t in_image(std::int64_t voxel) const {
    const GridIndex at = grid_index(seen_.response_hu.geometry, voxel);
    return whole_.offset(at[0] + box_.lower[0], at[1] + box_.lower[1], at[2] + box_.lower[2]);
  }

  double way_mm(std::int64_t voxel) const { return nodes_.at(voxel).length_mm; }

  Bridge way_to(std::int64_t voxel) const {
    Bridge bridge;
    for (; voxel >= 0; voxel = nodes_.at(voxel).before) {
      bridge.voxels.push_back(in_image(voxel));
      bridge.radius_mm.push_back(seen_.radius_mm.voxels[static_cast<std::size_t>(voxel)]);
    }
    std::reverse(bridge.voxels.begin(), bridge.voxels.end());
    std::reverse(bridge.radius_mm.begin(), bridge.radius_mm.end());
    return bridge;
  }

 private:
  const imaging::Geometry& whole_;
  imaging::Region box_;
  segmentation::Vesselness seen_;  // its response as a share of the contrast
  FrontNodes nodes_;
};

/// Neighbouring voxels that look like a tube, from one of them on, as far as it is looked at.
std::vector<std::int64_t> tube_about(const GrownFront& front, std::int64_t from) {
  const imaging::Geometry& grid = front.image.geometry;
  const Vec3 middle = voxel_place(grid, from);
  std::vector<std::int64_t> found{from};
  std::unordered_set<std::int64_t> known{from};
  for (std::size_t next = 0; next < found.size(); ++next) {
    const GridIndex at = grid_index(grid, found[next]);
    for (int n = 0; n < 27; ++n) {
      const GridIndex to{at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1};
      bool inside = true;
      for (std::size_t a = 0; a < 3; ++a) inside = inside && to[a] >= 0 && to[a] < grid.size[a];
      if (!inside) continue;
      const std::int64_t voxel = grid.offset(to[0], to[1], to[2]);
      if (static_cast<double>(front.tube.voxels[static_cast<std::size_t>(voxel)]) < front.least_tube ||
          (voxel_place(grid, voxel) - middle).norm() > far_look_mm || !known.insert(voxel).second)
        continue;
      found.push_back(voxel);
    }
  }
  return found;
}

/// Whether what was met is this vessel's other side: it begins there and leads on, as wide and as bright.
bool goes_on(const GrownFront& front, const End& end, const std::vector<std::int64_t>& tube) {
  constexpr double core = 0.7;  // of its greatest likeness
  constexpr double narrowest = 0.5, widest = 1.5, faintest = 0.7, brightest = 1.3;
  const imaging::Geometry& grid = front.image.geometry;
  const Vec3 start = voxel_place(grid, tube.front());
  Vec3 mean = Vec3::Zero();
  double away = 0.0, farthest = 0.0;
  float most = 0.0F;
  for (const std::int64_t voxel : tube) {
    const Vec3 to = voxel_place(grid, voxel) - start;
    mean += to;
    away += to.norm();
    farthest = std::max(farthest, to.norm());
    most = std::max(most, front.tube.voxels[static_cast<std::size_t>(voxel)]);
  }
  if (farthest < far_least_mm || mean.norm() < far_one_sided * away) return false;
  if (angle_deg(mean, start - end.place) > far_turn_deg) return false;
  std::vector<std::int64_t> middle;
  for (const std::int64_t voxel : tube)
    if (static_cast<double>(front.tube.voxels[static_cast<std::size_t>(voxel)]) >= core * most)
      middle.push_back(voxel);
  const Calibre calibre = calibre_of(front, middle);
  const double wide = calibre.radius_mm / end.calibre.radius_mm;
  const double bright = (calibre.hu - front.fat_hu) / (end.calibre.hu - front.fat_hu);
  return wide >= narrowest && wide <= widest && bright >= faintest && bright <= brightest;
}

}  // namespace

Bridge bridge_ahead(const GrownFront& front, const GrownBranch& branch, double longest_mm,
                    const core::TaskContext& task) {
  const std::optional<End> end = end_of(front, branch);
  if (!end) return {};
  const Ahead ahead(front, branch, *end, longest_mm, task);
  const imaging::Geometry& grid = front.image.geometry;
  std::unordered_set<std::int64_t> refused;
  for (const std::int64_t voxel : ahead.met()) {
    const std::int64_t there = ahead.in_image(voxel);
    const double likeness = front.tube.voxels[static_cast<std::size_t>(there)];
    if (likeness < least_far_tube * end->calibre.tube || front.reached.contains(there) ||
        refused.contains(there))
      continue;
    const double straight = (voxel_place(grid, there) - end->place).norm();
    if (ahead.way_mm(voxel) > detour * straight + detour_mm) continue;
    const std::vector<std::int64_t> tube = tube_about(front, there);
    if (goes_on(front, *end, tube)) return ahead.way_to(voxel);
    refused.insert(tube.begin(), tube.end());
  }
  return {};
}

}  // namespace ostia::coronary
