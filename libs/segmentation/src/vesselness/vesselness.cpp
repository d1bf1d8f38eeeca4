#include "ostia/segmentation/vesselness.h"

#include "vesselness/tube_brick.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace ostia::segmentation {
namespace {

using detail::Box;
using detail::Index;
using detail::TubeBrick;

constexpr std::int64_t kEdge = 48;  // of a brick along y and z

void need(bool holds, const std::string& name, double value, const std::string& range) {
  if (holds) return;
  throw InvalidInput("vesselness: " + name + " is " + std::to_string(value) + "; it must be " + range);
}

void check(const imaging::ImageVolume& image) {
  const auto& g = image.geometry;
  for (const std::int64_t n : g.size)
    if (n < 1) throw InvalidInput("vesselness: the image has no voxels");
  if (static_cast<std::int64_t>(image.voxels.size()) != g.voxels())
    throw InvalidInput("vesselness: the image has " + std::to_string(image.voxels.size()) +
                       " voxels where its size says " + std::to_string(g.voxels()));
  for (int d = 0; d < 3; ++d)
    need(std::isfinite(g.spacing[d]) && g.spacing[d] > 0.0, "the image's spacing", g.spacing[d],
         "above 0 mm");
}

imaging::Region region_of(const imaging::ImageVolume& image, const VesselnessPlace& place) {
  imaging::Region region = place.region.value_or(imaging::Region{{0, 0, 0}, image.geometry.size});
  for (std::size_t d = 0; d < 3; ++d) {
    if (region.lower[d] >= 0 && region.lower[d] < region.upper[d] &&
        region.upper[d] <= image.geometry.size[d])
      continue;
    throw InvalidInput("vesselness: the region [" + std::to_string(region.lower[d]) + ", " +
                       std::to_string(region.upper[d]) + ") along axis " + std::to_string(d) +
                       " is empty or not inside the image's " + std::to_string(image.geometry.size[d]) +
                       " voxels");
  }
  return region;
}

imaging::Geometry geometry_of(const imaging::Geometry& image, const imaging::Region& region) {
  imaging::Geometry g = image;
  g.origin =
      image.world(imaging::Vec3(static_cast<double>(region.lower[0]), static_cast<double>(region.lower[1]),
                                static_cast<double>(region.lower[2])));
  for (std::size_t d = 0; d < 3; ++d) g.size[d] = region.upper[d] - region.lower[d];
  return g;
}

/// What is wanted where: the region, and the mask on its grid or on the image's.
class Wish {
 public:
  Wish(const imaging::Geometry& image, const imaging::Region& region, const imaging::Geometry& result,
       const imaging::MaskVolume* mask)
      : region_(region), mask_(mask) {
    if (mask == nullptr) return;
    const bool whole = imaging::same_grid(mask->geometry, image);
    if ((!whole && !imaging::same_grid(mask->geometry, result)) ||
        static_cast<std::int64_t>(mask->voxels.size()) != mask->geometry.voxels())
      throw InvalidInput("vesselness: the mask's grid is neither the image's nor the region's; resample it");
    if (!whole) shift_ = region.lower;
  }

  /// The voxels of a cell of the lattice in which something is wanted; false when nothing is.
  bool shrink(Box& box) const {
    Box tight{box.upper, box.lower};
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y) {
        if (!any_in_row(box, y, z)) continue;
        tight.lower = {box.lower[0], std::min(tight.lower[1], y), std::min(tight.lower[2], z)};
        tight.upper = {box.upper[0], std::max(tight.upper[1], y + 1), std::max(tight.upper[2], z + 1)};
      }
    box = tight;
    return box.lower[0] < box.upper[0];
  }

  std::vector<std::uint8_t> flags(const Box& box) const {
    std::vector<std::uint8_t> result;
    result.reserve(static_cast<std::size_t>((box.upper[0] - box.lower[0]) * (box.upper[1] - box.lower[1]) *
                                            (box.upper[2] - box.lower[2])));
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
      for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
        for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x) result.push_back(wanted(x, y, z) ? 1 : 0);
    return result;
  }

 private:
  bool wanted(std::int64_t x, std::int64_t y, std::int64_t z) const {
    if (x < region_.lower[0] || x >= region_.upper[0]) return false;
    return mask_ == nullptr || (*mask_)(x - shift_[0], y - shift_[1], z - shift_[2]) != 0;
  }
  bool any_in_row(const Box& box, std::int64_t y, std::int64_t z) const {
    for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x)
      if (wanted(x, y, z)) return true;
    return false;
  }

  imaging::Region region_;
  const imaging::MaskVolume* mask_;
  Index shift_{0, 0, 0};
};

/// Cells that cover the region: along x those of the image's lattice.
std::vector<Box> bricks_of(const imaging::Region& region) {
  std::vector<Box> bricks;
  const std::int64_t first = region.lower[0] / TubeBrick::kLength * TubeBrick::kLength;
  for (std::int64_t z = region.lower[2]; z < region.upper[2]; z += kEdge)
    for (std::int64_t y = region.lower[1]; y < region.upper[1]; y += kEdge)
      for (std::int64_t x = first; x < region.upper[0]; x += TubeBrick::kLength)
        bricks.push_back({{x, y, z},
                          {x + TubeBrick::kLength, std::min(y + kEdge, region.upper[1]),
                           std::min(z + kEdge, region.upper[2])}});
  return bricks;
}

/// Buffers for as many bricks as are worked out at once.
class Benches {
 public:
  explicit Benches(const detail::TubePlan& plan) : plan_(plan) {}

  std::unique_ptr<TubeBrick> take() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) return std::make_unique<TubeBrick>(plan_);
    std::unique_ptr<TubeBrick> brick = std::move(free_.back());
    free_.pop_back();
    return brick;
  }
  void give_back(std::unique_ptr<TubeBrick> brick) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(brick));
  }

 private:
  const detail::TubePlan& plan_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<TubeBrick>> free_;
};

void keep(const TubeBrick& brick, const Box& box, const std::vector<std::uint8_t>& wanted,
          const imaging::Region& region, Vesselness& result) {
  const imaging::Geometry& g = result.response_hu.geometry;
  std::size_t number = 0;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z) {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y) {
      for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x) {
        if (wanted[number++] == 0) continue;
        const auto peak = brick.peak(x - box.lower[0], y - box.lower[1], z - box.lower[2]);
        if (peak.response <= 0.0F) continue;
        const auto at =
            static_cast<std::size_t>(g.offset(x - region.lower[0], y - region.lower[1], z - region.lower[2]));
        result.response_hu.voxels[at] = peak.response;
        result.radius_mm.voxels[at] = peak.radius_mm;
        if (result.axis.empty()) continue;
        const auto a = brick.axis(x - box.lower[0], y - box.lower[1], z - box.lower[2]);
        const imaging::Vec3 world = g.direction * imaging::Vec3(a[0], a[1], a[2]);
        result.axis[at] = {static_cast<float>(world[0]), static_cast<float>(world[1]),
                           static_cast<float>(world[2])};
      }
    }
  }
}

}  // namespace

void validate(const VesselnessOptions& o) {
  need(!o.radii_mm.empty() && o.radii_mm.size() <= 16, "the number of radii",
       static_cast<double>(o.radii_mm.size()), "1 to 16");
  double before = 0.0;
  for (const double radius : o.radii_mm) {
    need(radius >= 0.2 && radius <= 10.0, "a radius", radius, "in [0.2, 10] mm");
    need(radius > before, "a radius", radius, "larger than the one before it");
    before = radius;
  }
  need(o.image_blur_mm >= 0.0 && o.image_blur_mm <= 1.5, "image_blur_mm", o.image_blur_mm, "in [0, 1.5] mm");
  need(o.flux_blur_voxels >= 0.5 && o.flux_blur_voxels <= 3.0, "flux_blur_voxels", o.flux_blur_voxels,
       "in [0.5, 3] voxels");
  need(o.gap_weight >= 0.0 && o.gap_weight <= 1.0, "gap_weight", o.gap_weight, "in [0, 1]");
  need(std::isfinite(o.least_hu) && std::isfinite(o.most_hu) && o.least_hu < o.most_hu, "least_hu",
       o.least_hu, "finite and below most_hu");
}

Vesselness vesselness(const imaging::ImageVolume& image, const VesselnessPlace& place,
                      const VesselnessOptions& options, const core::TaskContext& task) {
  validate(options);
  check(image);
  const imaging::Region region = region_of(image, place);
  Vesselness result;
  result.response_hu.geometry = result.radius_mm.geometry = geometry_of(image.geometry, region);
  const Wish wish(image.geometry, region, result.radius_mm.geometry, place.mask);
  const detail::TubePlan plan(image, options);
  for (const detail::TubeScale& scale : plan.scales.list()) result.radii_mm.push_back(scale.radius_mm);
  task.throw_if_cancelled();
  const auto voxels = static_cast<std::size_t>(result.radius_mm.geometry.voxels());
  result.response_hu.voxels.assign(voxels, 0.0F);
  result.radius_mm.voxels.assign(voxels, 0.0F);
  if (options.axes == TubeAxes::computed) result.axis.assign(voxels, {0.0F, 0.0F, 0.0F});

  const std::vector<Box> bricks = bricks_of(region);
  Benches benches(plan);
  std::atomic<std::size_t> done{0};
  core::parallel_for(bricks.size(), 1, [&](std::size_t n) {
    task.throw_if_cancelled();
    Box box = bricks[n];
    if (wish.shrink(box)) {
      const std::vector<std::uint8_t> wanted = wish.flags(box);
      std::unique_ptr<TubeBrick> brick = benches.take();
      brick->work_out(box, wanted, task);
      keep(*brick, box, wanted, region, result);
      benches.give_back(std::move(brick));
    }
    task.set_progress(static_cast<double>(++done) / static_cast<double>(bricks.size()));
  });
  return result;
}

}  // namespace ostia::segmentation
