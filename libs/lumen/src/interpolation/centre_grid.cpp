#include "interpolation/centre_grid.h"

#include <algorithm>
#include <cmath>

namespace ostia::lumen {
namespace {

using geometry::Box3;
using geometry::Vec3;

constexpr double cells_per_reach = 2.0;  // finer cells hold fewer centres out of reach, but are more to visit
constexpr double most_cells_per_centre = 64.0;
constexpr double round_off = 1.0 + 1e-9;  // a centre at the very edge of its reach is kept

}  // namespace

CentreGrid::CentreGrid(const std::vector<Vec3>& centres, const std::vector<double>& weights, double reach_mm)
    : append_near_(kernel_loops(Kernel::wendland_c2).append_near), reach_(reach_mm) {
  Box3 box;
  for (const Vec3& centre : centres) box.extend(centre);
  origin_ = box.min();
  const Vec3 extent = box.max() - box.min();
  double cell = reach_mm / cells_per_reach;
  const auto count = [&](int axis) { return std::floor(extent[axis] / cell) + 1.0; };
  while (count(0) * count(1) * count(2) > most_cells_per_centre * static_cast<double>(centres.size()) + 512.0)
    cell *= 1.5;
  for (int axis = 0; axis < 3; ++axis)
    cells_[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(count(axis)),
    last_cell_[axis] = count(axis) - 1.0;
  cell_ = cell;
  per_cell_ = 1.0 / cell;

  const auto cell_of = [&](const Vec3& p) {
    return static_cast<std::size_t>((cell_along(2, p.z()) * cells_[1] + cell_along(1, p.y())) * cells_[0] +
                                    cell_along(0, p.x()));
  };
  start_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]) + 1, 0);
  for (const Vec3& centre : centres) ++start_[cell_of(centre) + 1];
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  x_.resize(centres.size() + list_padding);
  y_ = z_ = weight_ = x_;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto slot = static_cast<std::size_t>(next[cell_of(centres[i])]++);
    x_[slot] = centres[i].x();
    y_[slot] = centres[i].y();
    z_[slot] = centres[i].z();
    weight_[slot] = weights[i];
  }
}

std::int64_t CentreGrid::cell_along(int axis, double coordinate) const {
  const double cell = (coordinate - origin_[axis]) * per_cell_;
  const double last = last_cell_[axis];
  return cell > 0.0 ? static_cast<std::int64_t>(cell < last ? cell : last) : 0;
}

double CentreGrid::distance_to_cells(int axis, std::int64_t cell, double least, double most) const {
  const double low = origin_[axis] + static_cast<double>(cell) * cell_, high = low + cell_;
  const double before = low - most, behind = least - high;
  const double away = before > behind ? before : behind;
  return away > 0.0 ? away * (1.0 / round_off) : 0.0;
}

void CentreGrid::gather(const Box3& box, Gathered& out) const {
  out.size = 0;
  if (!(box.min().allFinite() && box.max().allFinite())) return;
  if (out.x.size() < x_.size() + list_padding) {
    out.x.resize(x_.size() + list_padding);
    out.y = out.z = out.weight = out.terms = out.x;
  }
  const Vec3 least = box.min(), most = box.max();
  const double reach = reach_ * round_off, reach2 = reach * reach;
  const auto range = [&](int axis) {
    return std::pair(cell_along(axis, least[axis] - reach), cell_along(axis, most[axis] + reach));
  };
  const auto [y0, y1] = range(1);
  const auto [z0, z1] = range(2);
  const Region region{{least.x(), least.y(), least.z()}, {most.x(), most.y(), most.z()}, reach2};
  const CentreArrays to{out.x.data(), out.y.data(), out.z.data(), out.weight.data()};
  std::size_t size = 0;
  for (std::int64_t z = z0; z <= z1; ++z) {
    const double away_z = distance_to_cells(2, z, least.z(), most.z());
    for (std::int64_t y = y0; y <= y1; ++y) {
      const double away_y = distance_to_cells(1, y, least.y(), most.y());
      const double left2 = reach2 - away_z * away_z - away_y * away_y;
      if (left2 < 0.0) continue;
      const double left = std::sqrt(left2);
      const std::int64_t x0 = cell_along(0, least.x() - left), x1 = cell_along(0, most.x() + left);
      const std::int64_t row = (z * cells_[1] + y) * cells_[0];
      const auto first = static_cast<std::size_t>(start_[static_cast<std::size_t>(row + x0)]);
      const auto last = static_cast<std::size_t>(start_[static_cast<std::size_t>(row + x1 + 1)]);
      const CentreList cells{x_.data() + first, y_.data() + first, z_.data() + first, weight_.data() + first,
                             last - first};
      size = append_near_(region, cells, to, size);
    }
  }
  out.size = size;
}

}  // namespace ostia::lumen
