#include "ostia/view/volume_cuts.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace ostia::view {
namespace {

constexpr double air_hu = -1024.0;

double cross_of(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool is_inside(const std::vector<Vec2>& outline, const Vec2& at) {
  bool inside = false;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const Vec2 a = outline[n] - at, b = outline[(n + 1) % outline.size()] - at;
    if ((a.y() <= 0.0) == (b.y() <= 0.0)) continue;
    if (a.x() - a.y() * (b.x() - a.x()) / (b.y() - a.y()) > 0.0) inside = !inside;
  }
  return inside;
}

/// Where a row of voxels `first + i * step` crosses the outline, in voxels, rising; of an even number.
void outline_crossings(const std::vector<Vec2>& outline, const Vec2& first, const Vec2& step,
                       std::vector<double>& places) {
  places.clear();
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const Vec2 a = outline[n] - first, b = outline[(n + 1) % outline.size()] - first;
    const double side_a = cross_of(step, a), side_b = cross_of(step, b);
    if ((side_a <= 0.0) == (side_b <= 0.0)) continue;
    const Vec2 met = a + side_a / (side_a - side_b) * (b - a);
    places.push_back(met.dot(step) / step.squaredNorm());
  }
  std::sort(places.begin(), places.end());
}

/// Of a row the voxels [from, to) are set 0.
void clear_row(std::uint8_t* row, std::int64_t size, double from, double to) {
  const auto first = static_cast<std::int64_t>(std::ceil(std::clamp(from, 0.0, static_cast<double>(size))));
  const auto last = static_cast<std::int64_t>(std::ceil(std::clamp(to, 0.0, static_cast<double>(size))));
  if (first < last) std::fill(row + first, row + last, std::uint8_t{0});
}

void cut_row(std::uint8_t* row, std::int64_t size, const VolumeCut& cut, const std::vector<double>& places) {
  if (!cut.keep_inside) {
    for (std::size_t n = 0; n + 1 < places.size(); n += 2) clear_row(row, size, places[n], places[n + 1]);
    return;
  }
  double from = 0.0;
  for (std::size_t n = 0; n + 1 < places.size(); n += 2) {
    clear_row(row, size, from, places[n]);
    from = places[n + 1];
  }
  clear_row(row, size, from, static_cast<double>(size));
}

/// The weights 1 2 1 along one axis, the border repeated; of values up to 64 times those of a mask.
void smooth_along(std::vector<std::uint8_t>& values, const imaging::Geometry& grid, std::size_t axis) {
  const std::array<std::int64_t, 3> stride{1, grid.size[0], grid.size[0] * grid.size[1]};
  const std::size_t a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  core::parallel_for(static_cast<std::size_t>(grid.size[b]), 1, [&](std::size_t outer) {
    for (std::int64_t inner = 0; inner < grid.size[a]; ++inner) {
      std::uint8_t* line = values.data() + static_cast<std::int64_t>(outer) * stride[b] + inner * stride[a];
      std::uint8_t before = line[0];
      for (std::int64_t n = 0; n < grid.size[axis]; ++n) {
        const std::uint8_t now = line[n * stride[axis]];
        const std::uint8_t after = n + 1 < grid.size[axis] ? line[(n + 1) * stride[axis]] : now;
        line[n * stride[axis]] = static_cast<std::uint8_t>(before + 2 * now + after);
        before = now;
      }
    }
  });
}

}  // namespace

void validate(const VolumeCut& cut) {
  if (cut.outline_mm.size() < 3)
    throw InvalidInput("a cut's outline has " + std::to_string(cut.outline_mm.size()) +
                       " corners, it takes three");
  for (const Vec2& corner : cut.outline_mm)
    if (!corner.allFinite()) throw InvalidInput("a cut's outline has a corner that is not finite");
  if (!cut.right.allFinite() || !cut.up.allFinite() || std::abs(cut.right.norm() - 1.0) > 1e-6 ||
      std::abs(cut.up.norm() - 1.0) > 1e-6 || std::abs(cut.right.dot(cut.up)) > 1e-6)
    throw InvalidInput("a cut's directions have to be unit vectors, normal to each other");
}

void cut_away(imaging::MaskVolume& mask, const VolumeCut& cut, const core::TaskContext& task) {
  validate(cut);
  const imaging::Geometry& grid = mask.geometry;
  if (static_cast<std::int64_t>(mask.voxels.size()) != grid.voxels())
    throw InvalidInput("the mask to be cut has " + std::to_string(mask.voxels.size()) +
                       " voxels, its size says " + std::to_string(grid.voxels()));
  const auto seen = [&](const Vec3& place) { return Vec2(place.dot(cut.right), place.dot(cut.up)); };
  const Vec2 step = seen(grid.direction * grid.spacing.cwiseProduct(Vec3::UnitX()));
  const bool along_view = step.norm() < 1e-9 * grid.spacing.x();
  core::parallel_for(static_cast<std::size_t>(grid.size[2]), 1, [&](std::size_t slice) {
    task.throw_if_cancelled();
    std::vector<double> places;
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < grid.size[1]; ++j) {
      const Vec2 first = seen(grid.world({0.0, static_cast<double>(j), static_cast<double>(k)}));
      std::uint8_t* row = mask.voxels.data() + grid.offset(0, j, k);
      if (along_view) {
        if (is_inside(cut.outline_mm, first) != cut.keep_inside) std::fill(row, row + grid.size[0], 0);
        continue;
      }
      outline_crossings(cut.outline_mm, first, step, places);
      cut_row(row, grid.size[0], cut, places);
    }
  });
}

void validate(const VolumeCrop& crop) {
  for (std::size_t a = 0; a < 3; ++a)
    if (!(crop.low[a] >= 0.0 && crop.low[a] < crop.high[a] && crop.high[a] <= 1.0))
      throw InvalidInput("a box from " + std::to_string(crop.low[a]) + " to " + std::to_string(crop.high[a]) +
                         " of the image is not possible: 0 <= from < to <= 1");
}

std::array<Eigen::Index, 3> patient_axes(const imaging::Geometry& grid) {
  std::array<Eigen::Index, 3> axes{};
  std::array<bool, 3> taken{};
  for (Eigen::Index image_axis = 0; image_axis < 3; ++image_axis) {
    Eigen::Index patient_axis = 0;
    double most = -1.0;
    for (Eigen::Index p = 0; p < 3; ++p) {
      const double along = std::abs(grid.direction(p, image_axis));
      if (taken[static_cast<std::size_t>(p)] || along <= most) continue;
      most = along;
      patient_axis = p;
    }
    taken[static_cast<std::size_t>(patient_axis)] = true;
    axes[static_cast<std::size_t>(image_axis)] = patient_axis;
  }
  return axes;
}

IndexBox index_box(const VolumeCrop& crop, const imaging::Geometry& grid) {
  validate(crop);
  IndexBox box;
  const std::array<Eigen::Index, 3> axes = patient_axes(grid);
  for (Eigen::Index image_axis = 0; image_axis < 3; ++image_axis) {
    const Eigen::Index patient_axis = axes[static_cast<std::size_t>(image_axis)];
    const auto axis = static_cast<std::size_t>(patient_axis);
    const double last = static_cast<double>(grid.size[static_cast<std::size_t>(image_axis)] - 1);
    const bool backwards = grid.direction(patient_axis, image_axis) < 0.0;
    box.low[image_axis] = last * (backwards ? 1.0 - crop.high[axis] : crop.low[axis]);
    box.high[image_axis] = last * (backwards ? 1.0 - crop.low[axis] : crop.high[axis]);
  }
  return box;
}

imaging::ImageVolume with_mask(const imaging::ImageVolume& image, const imaging::MaskVolume& mask) {
  if (!imaging::same_grid(image.geometry, mask.geometry) || image.voxels.size() != mask.voxels.size())
    throw InvalidInput("the mask of what is shown in 3D does not lie on the image's grid");
  constexpr double whole = 64.0;
  std::vector<std::uint8_t> share(mask.voxels.size());
  for (std::size_t n = 0; n < share.size(); ++n) share[n] = mask.voxels[n] != 0 ? 1 : 0;
  for (const std::size_t axis : {0, 1, 2}) smooth_along(share, image.geometry, axis);
  imaging::ImageVolume shown{image.geometry, std::vector<std::int16_t>(image.voxels.size())};
  core::parallel_for(shown.voxels.size(), 262144, [&](std::size_t n) {
    const double kept = share[n] / whole;
    shown.voxels[n] = static_cast<std::int16_t>(
        std::lround(air_hu + kept * (static_cast<double>(image.voxels[n]) - air_hu)));
  });
  return shown;
}

}  // namespace ostia::view
