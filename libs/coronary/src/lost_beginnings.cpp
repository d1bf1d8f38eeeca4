#include "lost_beginnings.h"

#include "median.h"
#include "voxel_places.h"

#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>

namespace ostia::coronary {
namespace {

constexpr double searched_aorta_mm = 60.0;  // from its lower end, as for ostia
constexpr double least_artery_mm = 30.0;    // from its beginning to its farthest end
constexpr double clear_artery_tube = 0.5;
constexpr double vein_share = 0.7, too_bright_share = 1.25;  // of the aorta's contrast above fat
constexpr double thinnest_trunk_mm = 0.6, widest_trunk_mm = 3.2;
constexpr double begins_within_mm = 8.0, begins_one_sided = 0.5;  // 1: all lies ahead; 0: it passes by
constexpr double beside_mm = 6.0, most_beside = 0.5;              // of its way, near what is known
constexpr double lung_is_below_hu = -400.0, most_in_lung = 0.35;

/// Root and ascending aorta as balls about their axis.
class AorticBalls {
 public:
  explicit AorticBalls(const Aorta& aorta) {
    double along = 0.0;
    for (const AortaStation& station : aorta.stations) {
      if (!stations_.empty()) along += (station.centre - stations_.back().centre).norm();
      if (along > searched_aorta_mm) break;
      stations_.push_back(station);
    }
  }

  const AortaStation& nearest(const Vec3& place) const {
    return *std::min_element(stations_.begin(), stations_.end(), [&](const auto& a, const auto& b) {
      return outside(a, place) < outside(b, place);
    });
  }
  double outside_mm(const Vec3& place) const { return outside(nearest(place), place); }

  geometry::Box3 box(double beyond_mm) const {
    geometry::Box3 box;
    for (const AortaStation& station : stations_) {
      box.extend(station.centre - Vec3::Constant(station.radius_mm + beyond_mm));
      box.extend(station.centre + Vec3::Constant(station.radius_mm + beyond_mm));
    }
    return box;
  }

 private:
  static double outside(const AortaStation& station, const Vec3& place) {
    return (place - station.centre).norm() - station.radius_mm;
  }
  std::vector<AortaStation> stations_;
};

class LostBeginnings {
 public:
  LostBeginnings(const LeftBehind& left, const Aorta& aorta, double farthest_mm)
      : left_(left), aorta_(aorta), balls_(aorta), farthest_mm_(farthest_mm) {}

  std::vector<Ostium> find(const core::TaskContext& task) {
    struct Found {
      Ostium ostium;
      double length_mm;
    };
    std::vector<Found> found;
    for (const std::int64_t seed : seeds()) {
      if (!known_.insert(seed).second) continue;
      task.throw_if_cancelled();
      const FrontNodes part = run_tube_front(left_.tube, {{seed, 0}}, left_.least_tube, task);
      for (const auto& [voxel, node] : part) known_.insert(voxel);
      const std::int64_t begin = nearest_to_aorta(part);
      const FrontNodes ways = run_tube_front(left_.tube, {{begin, 0}}, left_.least_tube, task);
      const std::vector<std::int64_t> way = longest_way(ways);
      const double length_mm = ways.at(way.back()).length_mm;
      const std::optional<Vec3> direction = leads_away(ways, begin);
      if (length_mm < least_artery_mm || !direction || !is_artery(way)) continue;
      found.push_back({ostium_at(begin, *direction), length_mm});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.length_mm > b.length_mm; });
    std::vector<Ostium> ostia;
    for (const Found& one : found) ostia.push_back(one.ostium);
    return ostia;
  }

 private:
  const imaging::Geometry& grid() const { return left_.image.geometry; }

  /// Clear tubes near the root that were not reached, in the grid's order.
  std::vector<std::int64_t> seeds() const {
    const geometry::Box3 box = balls_.box(farthest_mm_);
    GridIndex low = grid().size, high{0, 0, 0};
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at = grid().index(Vec3((corner & 1) != 0 ? box.max().x() : box.min().x(),
                                        (corner & 2) != 0 ? box.max().y() : box.min().y(),
                                        (corner & 4) != 0 ? box.max().z() : box.min().z()));
      for (std::size_t a = 0; a < 3; ++a) {
        const auto here = static_cast<std::int64_t>(std::lround(at[static_cast<Eigen::Index>(a)]));
        low[a] = std::clamp<std::int64_t>(std::min(low[a], here), 0, grid().size[a]);
        high[a] = std::clamp<std::int64_t>(std::max(high[a], here + 1), 0, grid().size[a]);
      }
    }
    std::vector<std::int64_t> result;
    for (std::int64_t k = low[2]; k < high[2]; ++k)
      for (std::int64_t j = low[1]; j < high[1]; ++j)
        for (std::int64_t i = low[0]; i < high[0]; ++i) {
          const std::int64_t voxel = grid().offset(i, j, k);
          if (left_.tube.voxels[static_cast<std::size_t>(voxel)] < clear_artery_tube ||
              left_.reached.contains(voxel))
            continue;
          const double away = balls_.outside_mm(voxel_place(grid(), voxel));
          if (away > 0.0 && away <= farthest_mm_) result.push_back(voxel);
        }
    return result;
  }

  std::int64_t nearest_to_aorta(const FrontNodes& part) const {
    std::int64_t best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [voxel, node] : part) {
      const double away = balls_.outside_mm(voxel_place(grid(), voxel));
      if (away > least || (away == least && voxel > best)) continue;
      least = away;
      best = voxel;
    }
    return best;
  }

  static std::vector<std::int64_t> longest_way(const FrontNodes& ways) {
    std::int64_t end = -1;
    for (const auto& [voxel, node] : ways)
      if (end < 0 || node.length_mm > ways.at(end).length_mm ||
          (node.length_mm == ways.at(end).length_mm && voxel < end))
        end = voxel;
    std::vector<std::int64_t> way;
    for (; end >= 0; end = ways.at(end).before) way.push_back(end);
    std::reverse(way.begin(), way.end());
    return way;
  }

  /// Where the first millimetres lead; nothing for a vessel that passes by.
  std::optional<Vec3> leads_away(const FrontNodes& ways, std::int64_t begin) const {
    const Vec3 from = voxel_place(grid(), begin);
    std::vector<std::int64_t> near;
    for (const auto& [voxel, node] : ways)
      if ((voxel_place(grid(), voxel) - from).norm() <= begins_within_mm) near.push_back(voxel);
    std::sort(near.begin(), near.end());  // sums do not depend on the order of the map
    Vec3 mean = Vec3::Zero();
    double away = 0.0;
    for (const std::int64_t voxel : near) {
      mean += voxel_place(grid(), voxel) - from;
      away += (voxel_place(grid(), voxel) - from).norm();
    }
    if (mean.norm() < begins_one_sided * away || mean.norm() == 0.0) return std::nullopt;
    return mean.normalized();
  }

  bool is_artery(const std::vector<std::int64_t>& way) const {
    constexpr std::array<int, 6> axes{0, 0, 1, 1, 2, 2};
    const double contrast = aorta_.lumen_hu - left_.fat_hu;
    std::vector<double> tube, hu, radius;
    double beside = 0.0, lung = 0.0, looks = 0.0;
    for (const std::int64_t voxel : way) {
      const Vec3 place = voxel_place(grid(), voxel);
      if ((place - voxel_place(grid(), way.front())).norm() > least_artery_mm) break;
      const auto at = static_cast<std::size_t>(voxel);
      tube.push_back(left_.tube.voxels[at]);
      hu.push_back((left_.image.voxels[at] - left_.fat_hu) / contrast);
      radius.push_back(left_.radius_mm.voxels[at]);
      beside += near_known(place) ? 1.0 : 0.0;
      for (std::size_t n = 0; n < axes.size(); ++n) {
        const Vec3 there = place + (n % 2 == 0 ? 1.0 : -1.0) * (radius.back() + 2.5) * Vec3::Unit(axes[n]);
        if (!grid().contains(there)) continue;
        looks += 1.0;
        lung += imaging::sample(left_.image, there) < lung_is_below_hu ? 1.0 : 0.0;
      }
    }
    const double share = median(hu), wide = median(radius);
    return median(tube) >= clear_artery_tube && share >= vein_share && share <= too_bright_share &&
           wide >= thinnest_trunk_mm && wide <= widest_trunk_mm &&
           beside <= most_beside * static_cast<double>(tube.size()) && lung <= most_in_lung * looks;
  }

  bool near_known(const Vec3& place) const {
    for (const GrownBranch& branch : left_.branches)
      for (const Vec3& point : branch.points)
        if ((point - place).squaredNorm() < beside_mm * beside_mm) return true;
    return false;
  }

  Ostium ostium_at(std::int64_t begin, const Vec3& direction) const {
    Ostium ostium;
    ostium.place = voxel_place(grid(), begin);
    ostium.direction = direction;
    ostium.radius_mm = left_.radius_mm.voxels[static_cast<std::size_t>(begin)];
    ostium.hu = left_.image.voxels[static_cast<std::size_t>(begin)];
    ostium.beyond_mm = dark_between(ostium.place);
    return ostium;
  }

  /// On the straight way to the aorta: how much of it shows no lumen.
  double dark_between(const Vec3& place) const {
    constexpr double step_mm = 0.25;
    const Vec3 to = balls_.nearest(place).centre - place;
    const double level = left_.wall_hu + 0.5 * (aorta_.lumen_hu - left_.wall_hu);
    double dark = 0.0, bright = 0.0;
    for (double s = 0.0; s < to.norm() && bright < 3.0; s += step_mm) {
      const bool lumen = imaging::sample(left_.image, place + s * to.normalized()) >= level;
      if (!lumen) dark += step_mm;
      bright = lumen && dark > 0.0 ? bright + step_mm : 0.0;
    }
    return dark;
  }

  const LeftBehind& left_;
  const Aorta& aorta_;
  AorticBalls balls_;
  double farthest_mm_;
  std::unordered_set<std::int64_t> known_;
};

}  // namespace

std::vector<Ostium> beginnings_beyond_wall(const LeftBehind& left, const Aorta& aorta, double farthest_mm,
                                           const core::TaskContext& task) {
  if (aorta.stations.size() < 3 || farthest_mm <= 0.0) return {};
  return LostBeginnings(left, aorta, farthest_mm).find(task);
}

}  // namespace ostia::coronary
