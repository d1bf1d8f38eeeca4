#include "voxel_box.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::centerline::detail {
namespace {

using imaging::MaskVolume;

void check(const MaskVolume& mask) {
  const imaging::Geometry& grid = mask.geometry;
  for (const std::int64_t n : grid.size)
    if (n < 1) throw InvalidInput("thinning: the mask has " + std::to_string(n) + " voxels along an axis");
  if (static_cast<std::int64_t>(mask.voxels.size()) != grid.voxels())
    throw InvalidInput("thinning: the mask's geometry means " + std::to_string(grid.voxels()) +
                       " voxels, but it has " + std::to_string(mask.voxels.size()));
  for (int d = 0; d < 3; ++d)
    if (!(grid.spacing[d] > 0.0) || !std::isfinite(grid.spacing[d]))
      throw InvalidInput("thinning: the mask's spacing is " + std::to_string(grid.spacing[d]) +
                         " mm; it must be positive");
}

imaging::Region empty_region(const imaging::Geometry& grid) {
  return {grid.size, {0, 0, 0}};
}

// The box of what is not 0.
imaging::Region object_region(const MaskVolume& mask) {
  const imaging::Geometry& grid = mask.geometry;
  const auto rows = static_cast<std::size_t>(grid.size[1] * grid.size[2]);
  const auto merge = [](imaging::Region a, const imaging::Region& b) {
    for (std::size_t d = 0; d < 3; ++d) {
      a.lower[d] = std::min(a.lower[d], b.lower[d]);
      a.upper[d] = std::max(a.upper[d], b.upper[d]);
    }
    return a;
  };
  const auto part = [&](std::size_t first, std::size_t last) {
    imaging::Region found = empty_region(grid);
    for (std::size_t row = first; row < last; ++row) {
      const auto begin = mask.voxels.begin() + static_cast<std::ptrdiff_t>(row) * grid.size[0];
      const auto end = begin + grid.size[0];
      const auto left = std::find_if(begin, end, [](std::uint8_t v) { return v != 0; });
      if (left == end) continue;
      auto right = end - 1;
      while (*right == 0) --right;
      const std::int64_t j = static_cast<std::int64_t>(row) % grid.size[1];
      const std::int64_t k = static_cast<std::int64_t>(row) / grid.size[1];
      found = merge(found, {{left - begin, j, k}, {right - begin + 1, j + 1, k + 1}});
    }
    return found;
  };
  return core::parallel_reduce(rows, 1024, empty_region(grid), part, merge);
}

// One run of the object along an axis: f holds the squared distances so far, with 0 before and after.
class RunEnvelope {
 public:
  // Writes min over q of (h (p - q))^2 + f[q] for p in [1, n - 1) into `out`.
  void transform(const std::vector<double>& f, double h2, std::vector<double>& out) {
    const auto n = static_cast<std::int64_t>(f.size());
    at_.resize(f.size());
    from_.resize(f.size() + 1);
    std::int64_t k = 0;
    at_[0] = 0;
    from_[0] = -std::numeric_limits<double>::infinity();
    for (std::int64_t q = 1; q < n; ++q) {
      double s = crossing(f, h2, q, at_[static_cast<std::size_t>(k)]);
      while (s <= from_[static_cast<std::size_t>(k)]) {
        --k;
        s = crossing(f, h2, q, at_[static_cast<std::size_t>(k)]);
      }
      ++k;
      at_[static_cast<std::size_t>(k)] = q;
      from_[static_cast<std::size_t>(k)] = s;
    }
    const std::int64_t last = k;
    k = 0;
    for (std::int64_t p = 1; p + 1 < n; ++p) {
      while (k < last && from_[static_cast<std::size_t>(k + 1)] < static_cast<double>(p)) ++k;
      const std::int64_t q = at_[static_cast<std::size_t>(k)];
      const auto step = static_cast<double>(p - q);
      out[static_cast<std::size_t>(p)] = h2 * step * step + f[static_cast<std::size_t>(q)];
    }
  }

 private:
  static double crossing(const std::vector<double>& f, double h2, std::int64_t q, std::int64_t v) {
    const auto a = static_cast<double>(q), b = static_cast<double>(v);
    const double rise = f[static_cast<std::size_t>(q)] - f[static_cast<std::size_t>(v)];
    return 0.5 * (rise / (h2 * (a - b)) + a + b);
  }
  std::vector<std::int64_t> at_;
  std::vector<double> from_;
};

void pass_along(const VoxelBox& box, std::int64_t stride, double spacing, bool first_pass, float* squared,
                const core::TaskContext& task) {
  core::parallel_chunks(box.voxels.size(), 16384, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    RunEnvelope envelope;
    std::vector<double> f, out;
    for (std::size_t i = first; i < last; ++i) {
      const std::int64_t begin = box.voxels[i];
      if (box.object[static_cast<std::size_t>(begin - stride)] != 0) continue;
      std::int64_t count = 0;
      f.assign(1, 0.0);
      for (std::int64_t at = begin; box.object[static_cast<std::size_t>(at)] != 0; at += stride, ++count)
        f.push_back(first_pass ? 0.0 : static_cast<double>(squared[at]));
      f.push_back(0.0);
      out.resize(f.size());
      if (first_pass) {
        for (std::int64_t p = 1; p <= count; ++p) {
          const double d = spacing * static_cast<double>(std::min(p, count + 1 - p));
          out[static_cast<std::size_t>(p)] = d * d;
        }
      } else {
        envelope.transform(f, spacing * spacing, out);
      }
      for (std::int64_t p = 1; p <= count; ++p)
        squared[begin + (p - 1) * stride] = static_cast<float>(out[static_cast<std::size_t>(p)]);
    }
  });
}

}  // namespace

std::int64_t VoxelBox::image_offset(std::uint32_t at, const imaging::Geometry& grid) const {
  const std::int64_t v = at;
  const std::int64_t i = v % size[0], j = v / size[0] % size[1], k = v / (size[0] * size[1]);
  return grid.offset(i - 1 + lower[0], j - 1 + lower[1], k - 1 + lower[2]);
}

VoxelBox box_of(const MaskVolume& mask) {
  check(mask);
  const imaging::Region region = object_region(mask);
  VoxelBox box;
  if (region.upper[0] <= region.lower[0]) return box;
  for (std::size_t d = 0; d < 3; ++d) box.size[d] = region.upper[d] - region.lower[d] + 2;
  box.lower = region.lower;
  box.stride = {1, box.size[0], box.size[0] * box.size[1]};
  const std::int64_t count = box.stride[2] * box.size[2];
  if (count >= (std::int64_t{1} << 32))
    throw ResourceError("thinning: the object's box has " + std::to_string(count) +
                        " voxels, 2^32 or more: crop or resample the mask");
  box.object.assign(static_cast<std::size_t>(count), 0);
  const std::int64_t width = region.upper[0] - region.lower[0];
  for (std::int64_t k = 1; k + 1 < box.size[2]; ++k)
    for (std::int64_t j = 1; j + 1 < box.size[1]; ++j) {
      const std::int64_t row = 1 + j * box.stride[1] + k * box.stride[2];
      const std::uint8_t* in =
          mask.voxels.data() +
          mask.geometry.offset(region.lower[0], j - 1 + box.lower[1], k - 1 + box.lower[2]);
      for (std::int64_t i = 0; i < width; ++i) {
        if (in[i] == 0) continue;
        box.object[static_cast<std::size_t>(row + i)] = 1;
        box.voxels.push_back(static_cast<std::uint32_t>(row + i));
      }
    }
  return box;
}

std::int64_t fill_cavities(VoxelBox& box) {
  if (box.voxels.empty()) return 0;
  constexpr std::uint8_t outside = 2;
  std::vector<std::int64_t> open{0};
  box.object[0] = outside;
  while (!open.empty()) {
    const std::int64_t at = open.back();
    open.pop_back();
    const std::array<std::int64_t, 3> place{at % box.size[0], at / box.size[0] % box.size[1],
                                            at / box.stride[2]};
    for (std::size_t d = 0; d < 3; ++d)
      for (const std::int64_t sign : {-1, 1}) {
        if (place[d] + sign < 0 || place[d] + sign >= box.size[d]) continue;
        const std::int64_t next = at + sign * box.stride[d];
        if (box.object[static_cast<std::size_t>(next)] != 0) continue;
        box.object[static_cast<std::size_t>(next)] = outside;
        open.push_back(next);
      }
  }
  const auto before = static_cast<std::int64_t>(box.voxels.size());
  box.voxels.clear();
  for (std::size_t v = 0; v < box.object.size(); ++v) {
    box.object[v] = box.object[v] == outside ? 0 : 1;
    if (box.object[v] != 0) box.voxels.push_back(static_cast<std::uint32_t>(v));
  }
  return static_cast<std::int64_t>(box.voxels.size()) - before;
}

std::unique_ptr<float[]> squared_distances(const VoxelBox& box, const imaging::Vec3& spacing,
                                           const core::TaskContext& task) {
  auto squared = std::make_unique_for_overwrite<float[]>(box.object.size());
  for (int d = 0; d < 3; ++d)
    pass_along(box, box.stride[static_cast<std::size_t>(d)], spacing[d], d == 0, squared.get(), task);
  return squared;
}

}  // namespace ostia::centerline::detail
