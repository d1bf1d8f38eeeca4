#include "ostia/imaging/morphology.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace ostia::imaging {
namespace {

using Index = std::array<std::int64_t, 3>;

void require_whole(const MaskVolume& mask) {
  if (static_cast<std::int64_t>(mask.voxels.size()) != mask.geometry.voxels())
    throw InvalidInput("morphology: the mask has " + std::to_string(mask.voxels.size()) + " values for " +
                       std::to_string(mask.geometry.voxels()) + " voxels");
}

/// A row of voxels of the ball about a voxel: how far along x it reaches, j and k rows away.
struct BallRow {
  std::int64_t i, j, k;
};

std::vector<BallRow> ball(const Geometry& grid, double radius_mm) {
  if (!(radius_mm >= 0.0) || radius_mm > 100.0)
    throw InvalidInput("morphology: the radius is " + std::to_string(radius_mm) +
                       " mm; it must be in [0, 100]");
  Index reach{};
  for (int d = 0; d < 3; ++d)
    reach[static_cast<std::size_t>(d)] = static_cast<std::int64_t>(radius_mm / grid.spacing[d] + 1e-9);
  const auto holds = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const Vec3 away(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
    return grid.spacing.cwiseProduct(away).norm() <= radius_mm * (1.0 + 1e-9);
  };
  std::vector<BallRow> rows;
  for (std::int64_t k = -reach[2]; k <= reach[2]; ++k)
    for (std::int64_t j = -reach[1]; j <= reach[1]; ++j) {
      std::int64_t i = reach[0];
      while (i >= 0 && !holds(i, j, k)) --i;
      if (i >= 0) rows.push_back({i, j, k});
    }
  return rows;
}

Index index_of(std::int64_t n, const Index& size) {
  return {n % size[0], n / size[0] % size[1], n / (size[0] * size[1])};
}

/// Calls visit on the face neighbours of a voxel inside the grid.
template <class Visit>
void for_neighbours(std::int64_t n, const Index& size, const Visit& visit) {
  const Index at = index_of(n, size);
  std::int64_t stride = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    if (at[d] > 0) visit(n - stride);
    if (at[d] + 1 < size[d]) visit(n + stride);
    stride *= size[d];
  }
}

/// Gives every voxel within the ball about a voxel that is `from`, and next to one that is not, the value
/// `from`. Such voxels beside each other along x are taken together.
MaskVolume spread(const MaskVolume& mask, double radius_mm, std::uint8_t from) {
  require_whole(mask);
  const std::vector<BallRow> rows = ball(mask.geometry, radius_mm);
  const Index& size = mask.geometry.size;
  const auto on_border = [&](std::int64_t n) {
    bool border = false;
    if (mask.voxels[static_cast<std::size_t>(n)] == from)
      for_neighbours(n, size,
                     [&](std::int64_t m) { border |= mask.voxels[static_cast<std::size_t>(m)] != from; });
    return border;
  };
  MaskVolume out = mask;
  for (std::int64_t row = 0; row < size[1] * size[2]; ++row)
    for (std::int64_t first = 0, last = 0; first < size[0]; first = last + 1) {
      last = first;
      if (!on_border(row * size[0] + first)) continue;
      while (last + 1 < size[0] && on_border(row * size[0] + last + 1)) ++last;
      for (const BallRow& of : rows) {
        const std::int64_t j = row % size[1] + of.j, k = row / size[1] + of.k;
        if (j < 0 || j >= size[1] || k < 0 || k >= size[2]) continue;
        const auto start = out.voxels.begin() + (k * size[1] + j) * size[0];
        std::fill(start + std::max<std::int64_t>(0, first - of.i), start + std::min(size[0], last + of.i + 1),
                  from);
      }
    }
  return out;
}

MaskVolume ones(const MaskVolume& mask) {
  MaskVolume out{mask.geometry, {}};
  out.voxels.reserve(mask.voxels.size());
  for (const std::uint8_t v : mask.voxels) out.voxels.push_back(v != 0 ? 1 : 0);
  return out;
}

/// A slice across one axis: its first voxel and the strides of the other two.
struct Slice {
  std::int64_t first, along_a, along_b, count_a, count_b;
  std::int64_t at(std::int64_t n) const { return first + n % count_a * along_a + n / count_a * along_b; }
};

/// Floods from voxel n through those that are 0 in `seen`; returns them. `border` tells whether it got to the
/// slice's.
std::vector<std::int64_t> flood(std::int64_t n, const Slice& slice, std::vector<std::uint8_t>& seen,
                                bool& border) {
  std::vector<std::int64_t> found{n};
  seen[static_cast<std::size_t>(n)] = 1;
  border = false;
  for (std::size_t at = 0; at < found.size(); ++at) {
    const std::int64_t a = found[at] % slice.count_a, b = found[at] / slice.count_a;
    const auto look = [&](bool inside, std::int64_t m) {
      border |= !inside;
      if (!inside || seen[static_cast<std::size_t>(m)] != 0) return;
      seen[static_cast<std::size_t>(m)] = 1;
      found.push_back(m);
    };
    const std::int64_t here = found[at];
    look(a > 0, here - 1);
    look(a + 1 < slice.count_a, here + 1);
    look(b > 0, here - slice.count_a);
    look(b + 1 < slice.count_b, here + slice.count_a);
  }
  return found;
}

void fill_slice(MaskVolume& mask, const ImageVolume& image, double least_mean_hu, const Slice& slice) {
  const std::int64_t count = slice.count_a * slice.count_b;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(count));
  bool any = false;
  for (std::int64_t n = 0; n < count; ++n) {
    seen[static_cast<std::size_t>(n)] = mask.voxels[static_cast<std::size_t>(slice.at(n))];
    any |= seen[static_cast<std::size_t>(n)] != 0;
  }
  if (!any) return;
  for (std::int64_t n = 0; n < count; ++n) {
    if (seen[static_cast<std::size_t>(n)] != 0) continue;
    bool border = false;
    const std::vector<std::int64_t> hole = flood(n, slice, seen, border);
    if (border) continue;
    double sum = 0.0;
    for (const std::int64_t m : hole) sum += image.voxels[static_cast<std::size_t>(slice.at(m))];
    if (sum < least_mean_hu * static_cast<double>(hole.size())) continue;
    for (const std::int64_t m : hole) mask.voxels[static_cast<std::size_t>(slice.at(m))] = 1;
  }
}

}  // namespace

MaskVolume dilated(const MaskVolume& mask, double radius_mm) {
  require_whole(mask);
  return spread(ones(mask), radius_mm, 1);
}

MaskVolume eroded(const MaskVolume& mask, double radius_mm) {
  require_whole(mask);
  return spread(ones(mask), radius_mm, 0);
}

Components components(const MaskVolume& mask) {
  require_whole(mask);
  Components out;
  out.label.assign(mask.voxels.size(), 0);
  out.voxels.assign(1, 0);
  std::vector<std::int64_t> front;
  for (std::size_t first = 0; first < mask.voxels.size(); ++first) {
    if (mask.voxels[first] == 0) ++out.voxels[0];
    if (mask.voxels[first] == 0 || out.label[first] != 0) continue;
    const auto label = static_cast<std::uint32_t>(out.voxels.size());
    out.voxels.push_back(0);
    out.label[first] = label;
    front.assign(1, static_cast<std::int64_t>(first));
    while (!front.empty()) {
      const std::int64_t n = front.back();
      front.pop_back();
      ++out.voxels[label];
      for_neighbours(n, mask.geometry.size, [&](std::int64_t m) {
        const auto at = static_cast<std::size_t>(m);
        if (mask.voxels[at] == 0 || out.label[at] != 0) return;
        out.label[at] = label;
        front.push_back(m);
      });
    }
  }
  return out;
}

void fill_bright_holes(MaskVolume& mask, const ImageVolume& image, double least_mean_hu) {
  require_whole(mask);
  if (!same_grid(mask.geometry, image.geometry) || image.voxels.size() != mask.voxels.size())
    throw InvalidInput("morphology: mask and image do not lie on one grid");
  mask = ones(mask);
  const Index& size = mask.geometry.size;
  const Index stride{1, size[0], size[0] * size[1]};
  for (const std::size_t d : {2UL, 1UL, 0UL}) {
    const std::size_t a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;
    core::parallel_for(static_cast<std::size_t>(size[d]), 4, [&](std::size_t at) {
      fill_slice(mask, image, least_mean_hu,
                 {static_cast<std::int64_t>(at) * stride[d], stride[a], stride[b], size[a], size[b]});
    });
  }
}

}  // namespace ostia::imaging
