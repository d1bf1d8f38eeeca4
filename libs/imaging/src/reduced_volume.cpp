#include "ostia/imaging/reduced_volume.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace ostia::imaging {
namespace {

using Size = std::array<std::int64_t, 3>;

/// The part of a line of voxels that one coarser voxel covers.
struct Cover {
  std::int64_t first = 0;
  std::vector<float> weights;  // sum 1
};

std::vector<Cover> covers_of(std::int64_t fine, std::int64_t coarse) {
  std::vector<Cover> covers(static_cast<std::size_t>(coarse));
  const double ratio = static_cast<double>(fine) / static_cast<double>(coarse);
  for (std::int64_t c = 0; c < coarse; ++c) {
    const double from = ratio * static_cast<double>(c), to = ratio * static_cast<double>(c + 1);
    Cover& cover = covers[static_cast<std::size_t>(c)];
    cover.first = std::min(static_cast<std::int64_t>(from), fine - 1);
    for (std::int64_t i = cover.first; i < fine && static_cast<double>(i) < to - 1e-9; ++i) {
      const double share = std::min(to, static_cast<double>(i + 1)) - std::max(from, static_cast<double>(i));
      cover.weights.push_back(static_cast<float>(share / ratio));
    }
  }
  return covers;
}

/// The voxels that touch the box.
Region region_of(const Geometry& image, const std::optional<geometry::Box3>& box) {
  Region region{{0, 0, 0}, image.size};
  if (!box) return region;
  geometry::Box3 indices;
  for (int corner = 0; corner < 8; ++corner)
    indices.extend(image.index(box->corner(static_cast<geometry::Box3::CornerType>(corner))));
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a);
    const double low =
        std::clamp(std::floor(indices.min()[a] + 0.5), 0.0, static_cast<double>(image.size[k]));
    const double high =
        std::clamp(std::ceil(indices.max()[a] + 0.5), 0.0, static_cast<double>(image.size[k]));
    region.lower[k] = static_cast<std::int64_t>(low);
    region.upper[k] = static_cast<std::int64_t>(high);
    if (region.lower[k] >= region.upper[k])
      throw InvalidInput("the box to be shown lies outside the image; show the whole image");
  }
  return region;
}

Size coarse_size(const Size& size, const geometry::Vec3& spacing, std::int64_t most) {
  const double voxels =
      static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(size[2]);
  if (voxels <= static_cast<double>(most)) return size;
  const geometry::Vec3 extent(spacing.x() * static_cast<double>(size[0]),
                              spacing.y() * static_cast<double>(size[1]),
                              spacing.z() * static_cast<double>(size[2]));
  // The edge of the cube, found by bisection: an axis that is coarser than it already stays as it is.
  const auto with_edge = [&](double edge) {
    Size result{};
    for (int a = 0; a < 3; ++a) {
      const auto k = static_cast<std::size_t>(a);
      result[k] =
          std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(extent[a] / edge)), 1, size[k]);
    }
    return result;
  };
  double low = spacing.minCoeff(), high = extent.maxCoeff();
  for (int step = 0; step < 60; ++step) {
    const double edge = 0.5 * (low + high);
    const Size tried = with_edge(edge);
    (tried[0] * tried[1] * tried[2] <= most ? high : low) = edge;
  }
  return with_edge(high);
}

/// One coarse slice: lines along x first, then y, then z, in single precision.
class SliceMaker {
 public:
  SliceMaker(const ImageVolume& image, const Region& region, const Size& coarse)
      : image_(image), region_(region), coarse_(coarse) {
    for (std::size_t a = 0; a < 3; ++a) covers_[a] = covers_of(region.upper[a] - region.lower[a], coarse[a]);
  }
  void make(std::int64_t k, std::int16_t* out) const {
    const auto columns = static_cast<std::size_t>(coarse_[0]);
    std::vector<float> slice(columns * static_cast<std::size_t>(coarse_[1]), 0.0F), line(columns);
    const Cover& deep = covers_[2][static_cast<std::size_t>(k)];
    for (std::size_t dz = 0; dz < deep.weights.size(); ++dz) {
      const std::int64_t z = region_.lower[2] + deep.first + static_cast<std::int64_t>(dz);
      for (std::int64_t j = 0; j < coarse_[1]; ++j) {
        const Cover& high = covers_[1][static_cast<std::size_t>(j)];
        for (std::size_t dy = 0; dy < high.weights.size(); ++dy) {
          const std::int64_t y = region_.lower[1] + high.first + static_cast<std::int64_t>(dy);
          const float weight = deep.weights[dz] * high.weights[dy];
          add_line(image_.voxels.data() + image_.geometry.offset(region_.lower[0], y, z), weight,
                   slice.data() + static_cast<std::size_t>(j) * columns);
        }
      }
    }
    for (std::size_t i = 0; i < slice.size(); ++i) out[i] = static_cast<std::int16_t>(std::lround(slice[i]));
  }

 private:
  void add_line(const std::int16_t* from, float weight, float* to) const {
    for (std::size_t i = 0; i < covers_[0].size(); ++i) {
      const Cover& cover = covers_[0][i];
      float sum = 0.0F;
      for (std::size_t d = 0; d < cover.weights.size(); ++d)
        sum += cover.weights[d] * static_cast<float>(from[cover.first + static_cast<std::int64_t>(d)]);
      to[i] += weight * sum;
    }
  }
  const ImageVolume& image_;
  Region region_;
  Size coarse_;
  std::array<std::vector<Cover>, 3> covers_;
};

Geometry coarse_geometry(const Geometry& fine, const Region& region, const Size& coarse) {
  Geometry result = fine;
  geometry::Vec3 first;  // index of the first coarse voxel's centre in the fine image
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a);
    const double ratio =
        static_cast<double>(region.upper[k] - region.lower[k]) / static_cast<double>(coarse[k]);
    result.size[k] = coarse[k];
    result.spacing[a] = fine.spacing[a] * ratio;
    first[a] = static_cast<double>(region.lower[k]) + 0.5 * ratio - 0.5;
  }
  result.origin = fine.world(first);
  return result;
}

}  // namespace

void validate(const ReducedVolumeOptions& options) {
  if (options.most_voxels < 8 || options.most_voxels > 1'000'000'000)
    throw InvalidInput("most_voxels is " + std::to_string(options.most_voxels) +
                       ", it has to be between 8 and 1000000000");
}

ImageVolume reduced_volume(const ImageVolume& image, const ReducedVolumeOptions& options,
                           const core::TaskContext& task) {
  validate(options);
  if (image.voxels.empty()) throw InvalidInput("the image has no voxels; there is nothing to show");
  const Region region = region_of(image.geometry, options.box);
  const Size fine{region.upper[0] - region.lower[0], region.upper[1] - region.lower[1],
                  region.upper[2] - region.lower[2]};
  const Size coarse = coarse_size(fine, image.geometry.spacing, options.most_voxels);
  if (coarse == image.geometry.size) return image;
  ImageVolume result;
  result.geometry = coarse_geometry(image.geometry, region, coarse);
  result.voxels.resize(static_cast<std::size_t>(result.geometry.voxels()));
  const SliceMaker maker(image, region, coarse);
  core::parallel_for(static_cast<std::size_t>(coarse[2]), 1, [&](std::size_t k) {
    task.throw_if_cancelled();
    maker.make(static_cast<std::int64_t>(k),
               result.voxels.data() + result.geometry.offset(0, 0, static_cast<std::int64_t>(k)));
  });
  return result;
}

}  // namespace ostia::imaging
