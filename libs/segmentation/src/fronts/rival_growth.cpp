#include "ostia/segmentation/rival_growth.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <queue>
#include <string>

namespace ostia::segmentation {
namespace {

using imaging::Geometry;
using imaging::ImageVolume;
using imaging::MaskVolume;

std::string text_of(const Vec3& p) {
  return "(" + core::fixed_text(p.x(), 1) + ", " + core::fixed_text(p.y(), 1) + ", " +
         core::fixed_text(p.z(), 1) + ")";
}

/// The brightest voxel within `snap_mm` of a place; of equals the first in scanning order.
std::int64_t bright_voxel(const ImageVolume& image, const Vec3& place, const RivalGrowthOptions& options) {
  const Geometry& grid = image.geometry;
  if (!place.allFinite() || !grid.contains(place))
    throw InvalidInput("the place " + text_of(place) + " mm lies outside the image");
  const Vec3 at = grid.index(place);
  std::array<std::int64_t, 3> low{}, high{};
  for (int a = 0; a < 3; ++a) {
    const double reach = options.snap_mm / grid.spacing[a] + 0.5;
    const std::int64_t last = grid.size[static_cast<std::size_t>(a)] - 1;
    low[static_cast<std::size_t>(a)] =
        std::clamp<std::int64_t>(static_cast<std::int64_t>(std::ceil(at[a] - reach)), 0, last);
    high[static_cast<std::size_t>(a)] =
        std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(at[a] + reach)), 0, last);
  }
  std::int64_t best = -1;
  for (std::int64_t k = low[2]; k <= high[2]; ++k)
    for (std::int64_t j = low[1]; j <= high[1]; ++j)
      for (std::int64_t i = low[0]; i <= high[0]; ++i) {
        const Vec3 index(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        const bool own = (index - at).cwiseAbs().maxCoeff() <= 0.5;
        if (!own && (grid.world(index) - place).norm() > options.snap_mm) continue;
        const std::int64_t voxel = grid.offset(i, j, k);
        if (best < 0 ||
            image.voxels[static_cast<std::size_t>(voxel)] > image.voxels[static_cast<std::size_t>(best)])
          best = voxel;
      }
  if (best < 0 || image.voxels[static_cast<std::size_t>(best)] <= options.least_hu) {
    char text[200];
    std::snprintf(text, sizeof text, " mm: nothing within %.1f mm is brighter than %.0f HU; move it",
                  options.snap_mm, options.least_hu);
    throw InvalidInput("the place " + text_of(place) + text);
  }
  return best;
}

/// The front: brightest way first, of equals the one that came first.
struct Reached {
  std::int16_t weakest;
  std::int64_t order;
  std::int64_t voxel;
  Owner owner;
};
struct Later {
  bool operator()(const Reached& a, const Reached& b) const {
    return a.weakest != b.weakest ? a.weakest < b.weakest : a.order > b.order;
  }
};

class Growth {
 public:
  Growth(const ImageVolume& image, double least_hu)
      : image_(image), least_hu_(least_hu), owner_{image.geometry, {}} {
    owner_.voxels.assign(image.voxels.size(), 0);
  }

  void begin_at(std::int64_t voxel, Owner owner) { reach(voxel, value(voxel), owner); }

  MaskVolume run(const core::TaskContext& task) {
    for (std::int64_t steps = 0; !front_.empty(); ++steps) {
      if (steps % 65536 == 0) task.throw_if_cancelled();
      const Reached now = front_.top();
      front_.pop();
      std::uint8_t& owner = owner_.voxels[static_cast<std::size_t>(now.voxel)];
      if (owner != 0) continue;
      owner = static_cast<std::uint8_t>(now.owner);
      to_neighbours(now);
    }
    return std::move(owner_);
  }

 private:
  std::int16_t value(std::int64_t voxel) const { return image_.voxels[static_cast<std::size_t>(voxel)]; }

  void reach(std::int64_t voxel, std::int16_t weakest, Owner owner) {
    front_.push({weakest, order_++, voxel, owner});
  }

  void to_neighbours(const Reached& from) {
    const auto& size = image_.geometry.size;
    std::int64_t stride = 1;
    for (std::size_t a = 0; a < 3; stride *= size[a], ++a) {
      const std::int64_t at = from.voxel / stride % size[a];
      for (const std::int64_t step : {-1, 1}) {
        if (at + step < 0 || at + step >= size[a]) continue;
        const std::int64_t next = from.voxel + step * stride;
        if (owner_.voxels[static_cast<std::size_t>(next)] != 0 || value(next) <= least_hu_) continue;
        reach(next, std::min(from.weakest, value(next)), from.owner);
      }
    }
  }

  const ImageVolume& image_;
  double least_hu_;
  MaskVolume owner_;
  std::priority_queue<Reached, std::vector<Reached>, Later> front_;
  std::int64_t order_ = 0;
};

}  // namespace

void validate(const RivalGrowthOptions& o) {
  if (!std::isfinite(o.least_hu)) throw InvalidInput("rival growth: least_hu must be finite");
  if (!(o.snap_mm >= 0.0 && o.snap_mm <= 10.0))
    throw InvalidInput("rival growth: snap_mm must lie in [0, 10]");
}

MaskVolume grown_against(const ImageVolume& image, const std::vector<Vec3>& seeds,
                         const std::vector<Vec3>& rivals, const RivalGrowthOptions& options,
                         const core::TaskContext& task) {
  validate(options);
  if (image.voxels.empty() || image.geometry.voxels() != static_cast<std::int64_t>(image.voxels.size()))
    throw InvalidInput("rival growth: the image is empty");
  if (seeds.empty()) throw InvalidInput("rival growth: there is no seed");
  std::vector<std::int64_t> own;
  Growth growth(image, options.least_hu);
  for (const Vec3& seed : seeds) {
    own.push_back(bright_voxel(image, seed, options));
    growth.begin_at(own.back(), Owner::seeds);
  }
  for (const Vec3& rival : rivals) {
    const std::int64_t voxel = bright_voxel(image, rival, options);
    if (std::find(own.begin(), own.end(), voxel) != own.end())
      throw InvalidInput("the rival at " + text_of(rival) + " mm means the same voxel as a seed; move it");
    growth.begin_at(voxel, Owner::rivals);
  }
  return growth.run(task);
}

}  // namespace ostia::segmentation
