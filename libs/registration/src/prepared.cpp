#include "prepared.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/quasi_random.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/reduced_volume.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ostia::registration {
namespace {

constexpr double margin_mm = 8.0;  // of the box about the region
constexpr double close_to_vessels_mm = 8.0;
constexpr double blur_voxels = 0.6;  // so that the images' gradients vary smoothly
constexpr std::uint64_t strewing_seed = 20031;
constexpr std::int16_t air_hu = -1024;

geometry::Box3 hull_of(const imaging::Geometry& image) {
  geometry::Box3 hull;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 index;
    for (int a = 0; a < 3; ++a)
      index[a] = (corner >> a & 1) != 0 ? static_cast<double>(image.size[a] - 1) : 0.0;
    hull.extend(image.world(index));
  }
  return hull;
}

/// With the world's axes, over all that the image covers, with voxels no larger than its smallest side; turns
/// by right angles keep the voxels' places.
imaging::Geometry upright(const imaging::Geometry& image) {
  const geometry::Box3 hull = hull_of(image);
  imaging::Geometry grid;
  grid.origin = hull.min();
  for (int a = 0; a < 3; ++a) {
    const Vec3 row = image.direction.row(a).cwiseAbs();
    Eigen::Index along = 0;
    const bool right_angle = row.maxCoeff(&along) > 1.0 - 1e-9;
    grid.spacing[a] = right_angle ? image.spacing[along] : image.spacing.minCoeff();
    grid.size[a] = static_cast<std::int64_t>(std::floor(hull.sizes()[a] / grid.spacing[a] + 1e-6)) + 1;
  }
  return grid;
}

std::int64_t voxels_in(const geometry::Box3& box, double voxel_mm) {
  const double count = box.volume() / (voxel_mm * voxel_mm * voxel_mm);
  return std::clamp<std::int64_t>(std::llround(count), 512, 1'000'000'000);
}

/// Two corners hold the ends of the range, and the rest stays within it.
void set_range(imaging::FloatVolume& image) {
  for (float& v : image.voxels) v = std::clamp(v, 1e-3F, 1.0F - 1e-3F);
  image.voxels.front() = 0.0F;
  image.voxels.back() = 1.0F;
}

float windowed(double value, const Window& window) {
  return static_cast<float>(std::clamp((value - window.low) / (window.high - window.low), 0.0, 1.0));
}

/// Of those marked, each with the chance that about `count` are taken.
void strew(const std::vector<std::uint8_t>& marks, std::uint8_t mark, std::int64_t count,
           std::vector<std::uint8_t>& taken) {
  const auto all = std::count(marks.begin(), marks.end(), mark);
  if (all == 0) return;
  const double chance = static_cast<double>(count) / static_cast<double>(all);
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i] == mark && (chance >= 1.0 || core::uniform_number(strewing_seed, i) < chance)) taken[i] = 1;
}

}  // namespace

Region::Region(const imaging::Geometry& fixed, const Guidance& guidance, double region_mm)
    : fixed_(fixed), region_mm_(region_mm) {
  std::vector<Vec3> shown;
  for (const Vec3& point : guidance.vessels_mm) {
    if (!point.allFinite())
      throw InvalidInput("a point of the vessels has a coordinate that is not a finite number");
    if (fixed.contains(point)) shown.push_back(point);
  }
  if (!guidance.vessels_mm.empty() && 2 * shown.size() < guidance.vessels_mm.size())
    throw InvalidInput("the vessels do not lie in the fixed scan: " + std::to_string(shown.size()) + " of " +
                       std::to_string(guidance.vessels_mm.size()) +
                       " points are inside it; give the tree that was made from this scan");
  const geometry::Box3 hull = hull_of(fixed);
  if (shown.empty()) {
    box_ = hull;
    centre_ = hull.center();
    reach_ = 0.3 * hull.diagonal().norm();
    return;
  }
  for (const Vec3& point : shown) box_.extend(point);
  const Vec3 margin = Vec3::Constant(region_mm + margin_mm);
  box_ = geometry::Box3(box_.min() - margin, box_.max() + margin).intersection(hull);
  centre_ =
      std::accumulate(shown.begin(), shown.end(), Vec3(Vec3::Zero())) / static_cast<double>(shown.size());
  double sum = 0.0;
  for (const Vec3& point : shown) sum += (point - centre_).squaredNorm();
  reach_ = std::max(20.0, std::sqrt(sum / static_cast<double>(shown.size())));
  vessels_ = std::make_shared<const geometry::KdTree>(std::move(shown));
}

std::vector<std::int64_t> Region::samples(const imaging::Geometry& image, const imaging::Geometry& moving,
                                          const LinearMap& map, std::int64_t count, double* overlap) const {
  enum : std::uint8_t { outside, in_region, close, not_shown };
  std::vector<std::uint8_t> marks(image.voxels(), outside);
  const std::int64_t row = image.size[0];
  core::parallel_for(static_cast<std::size_t>(image.size[1] * image.size[2]), 16, [&](std::size_t line) {
    const auto j = static_cast<std::int64_t>(line) % image.size[1],
               k = static_cast<std::int64_t>(line) / image.size[1];
    for (std::int64_t i = 0; i < row; ++i) {
      const Vec3 point =
          image.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
      std::uint8_t mark = in_region;
      if (vessels_) {
        const double distance = (vessels_->points()[vessels_->nearest(point)] - point).norm();
        mark = distance > region_mm_ ? outside : distance > close_to_vessels_mm ? in_region : close;
      }
      if (mark != outside && !fixed_.contains(point)) mark = outside;
      if (mark != outside && !moving.contains(map.linear * point + map.offset_mm)) mark = not_shown;
      marks[image.offset(i, j, k)] = mark;
    }
  });
  std::vector<std::uint8_t> taken(marks.size(), 0);
  const auto close_ones = std::count(marks.begin(), marks.end(), std::uint8_t{close});
  const std::int64_t near = std::min<std::int64_t>(close_ones, count / 2);
  strew(marks, close, near, taken);
  strew(marks, in_region, count - near, taken);
  if (overlap) {
    const auto shown = close_ones + std::count(marks.begin(), marks.end(), std::uint8_t{in_region});
    const auto hidden = std::count(marks.begin(), marks.end(), std::uint8_t{not_shown});
    *overlap = static_cast<double>(shown) / static_cast<double>(std::max<std::int64_t>(1, shown + hidden));
  }
  std::vector<std::int64_t> offsets;
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (taken[i] != 0) offsets.push_back(static_cast<std::int64_t>(i));
  if (offsets.size() < 100) throw InvalidInput(no_overlap);
  return offsets;
}

Window window_of(const imaging::ImageVolume& scan, bool hounsfield, const char* name) {
  std::vector<std::int16_t> some;
  const std::size_t stride = std::max<std::size_t>(1, scan.voxels.size() / 200000);
  for (std::size_t i = 0; i < scan.voxels.size(); i += stride) some.push_back(scan.voxels[i]);
  std::sort(some.begin(), some.end());
  const double low = some[some.size() / 100], high = some[some.size() - 1 - some.size() / 200];
  if (some.front() == some.back())
    throw InvalidInput(std::string("the ") + name + " scan shows nothing: all of its values are " +
                       std::to_string(some.front()));
  if (!hounsfield) return {low, std::max(high, low + 1.0)};
  if (low > -20.0)
    throw InvalidInput(
        std::string("the values of the ") + name +
        " scan are not Hounsfield units, since neither air nor fat is in it: it is no CT, or its rescale "
        "is missing; scans of other kinds are compared with hounsfield = false");
  return {};
}

imaging::ImageVolume reduced(const imaging::ImageVolume& scan, const geometry::Box3* box, double voxel_mm,
                             const core::TaskContext& task) {
  imaging::ReducedVolumeOptions options;
  if (box) options.box = *box;
  options.most_voxels = voxels_in(box ? *box : hull_of(scan.geometry), voxel_mm);
  imaging::ImageVolume small = imaging::reduced_volume(scan, options, task);
  if (small.geometry.direction.isIdentity(1e-12)) return small;
  return imaging::resampled(small, upright(small.geometry), imaging::Interpolation::cubic, air_hu, task);
}

imaging::FloatVolume coarse(const imaging::ImageVolume& scan, const geometry::Box3* box, double voxel_mm,
                            const Window& window, const core::TaskContext& task) {
  const imaging::ImageVolume small = reduced(scan, box, voxel_mm, task);
  imaging::FloatVolume image;
  image.geometry = small.geometry;
  image.voxels.resize(small.voxels.size());
  std::transform(small.voxels.begin(), small.voxels.end(), image.voxels.begin(),
                 [&](std::int16_t value) { return windowed(value, window); });
  image = imaging::gaussian_blurred(image, blur_voxels * voxel_mm, task);
  set_range(image);
  return image;
}

imaging::FloatVolume laid_on(const imaging::Geometry& grid, const imaging::ImageVolume& moving,
                             const LinearMap& map, double voxel_mm, const Window& window,
                             const core::TaskContext& task) {
  geometry::Box3 there;
  const geometry::Box3 hull = hull_of(grid);
  for (int corner = 0; corner < 8; ++corner)
    there.extend(map.linear * hull.corner(static_cast<geometry::Box3::CornerType>(corner)) + map.offset_mm);
  there = there.intersection(hull_of(moving.geometry));
  if (there.isEmpty())
    throw InvalidInput("the scans do not overlap: the region of the fixed scan lies outside the moving scan");
  const imaging::FloatVolume source = coarse(moving, &there, voxel_mm, window, task);
  imaging::FloatVolume image;
  image.geometry = grid;
  image.voxels.assign(grid.voxels(), 0.0F);
  core::parallel_for(static_cast<std::size_t>(grid.size[1] * grid.size[2]), 16, [&](std::size_t line) {
    const auto j = static_cast<std::int64_t>(line) % grid.size[1],
               k = static_cast<std::int64_t>(line) / grid.size[1];
    for (std::int64_t i = 0; i < grid.size[0]; ++i) {
      const Vec3 point = map.linear * grid.world(Vec3(static_cast<double>(i), static_cast<double>(j),
                                                      static_cast<double>(k))) +
                         map.offset_mm;
      if (source.geometry.contains(point))
        image.voxels[grid.offset(i, j, k)] = static_cast<float>(imaging::sample(source, point));
    }
  });
  set_range(image);
  return image;
}

}  // namespace ostia::registration
