#include "editing/change_extent.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace ostia::lumen {
namespace {

using Cell = Eigen::Array3i;

constexpr double least_change_mm = 1e-6;
constexpr double in_hand = 0.1;  // places between those evaluated
constexpr double surely = 0.1;   // mm: a bound so great leaves no hope
constexpr std::size_t most_cells = 4'000'000;

// A dense grid of cells around all changes; vessels are thin, but their cells are wide.
struct Cells {
  double size = 0.0;
  Cell first = Cell::Zero(), count = Cell::Zero();
  std::vector<double> sum;
  Cell at(const Vec3& place) const { return (place / size).array().floor().cast<int>() - first; }
  std::size_t index(const Cell& c) const {
    return (static_cast<std::size_t>(c.z()) * static_cast<std::size_t>(count.y()) +
            static_cast<std::size_t>(c.y())) *
               static_cast<std::size_t>(count.x()) +
           static_cast<std::size_t>(c.x());
  }
  bool holds(const Cell& c) const { return (c >= 0).all() && (c < count).all(); }
  Vec3 corner(const Cell& c) const { return (c + first).cast<double>().matrix() * size; }
};

template <class Visit>
void for_each_around(const Cell& cell, int reach, const Visit& visit) {
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) visit(Cell(cell + Cell(x, y, z)), Cell(x, y, z));
}

// sum |delta c| phi, phi at the least distance of two cells.
std::vector<double> bounds_of(const Cells& cells, const std::vector<Cell>& filled, Kernel kernel) {
  std::array<double, 125> factor{};
  std::size_t i = 0;
  for_each_around(Cell::Zero(), 2, [&](const Cell&, const Cell& shift) {
    const Vec3 gap = (shift.abs() - 1).max(0).cast<double>();
    factor[i++] = phi(kernel, 0.5 * gap.norm());
  });
  std::vector<double> bound(cells.sum.size(), 0.0);
  for (const Cell& cell : filled) {
    const double sum = cells.sum[cells.index(cell)];
    i = 0;
    for_each_around(cell, 2, [&](const Cell& c, const Cell&) { bound[cells.index(c)] += sum * factor[i++]; });
  }
  return bound;
}

ChangeExtent everywhere(const std::vector<WeightChange>& changes, double reach_mm) {
  ChangeExtent extent{{}, changes.front().s_mm, changes.front().s_mm};
  for (const WeightChange& change : changes) {
    extent.box.extend(Vec3(change.place - Vec3::Constant(reach_mm)));
    extent.box.extend(Vec3(change.place + Vec3::Constant(reach_mm)));
    extent.from_mm = std::min(extent.from_mm, change.s_mm);
    extent.to_mm = std::max(extent.to_mm, change.s_mm);
  }
  return extent;
}

// Of the marked cells and those around them, and of the centres in them.
ChangeExtent around(const std::vector<Cell>& marked, const Cells& cells,
                    const std::vector<WeightChange>& changes) {
  ChangeExtent extent;
  if (marked.empty()) return extent;
  std::vector<char> within(cells.sum.size(), 0);
  for (const Cell& cell : marked) {
    extent.box.extend(Vec3(cells.corner(cell - 1)));
    extent.box.extend(Vec3(cells.corner(cell + 2)));
    for_each_around(cell, 1, [&](const Cell& c, const Cell&) {
      if (cells.holds(c)) within[cells.index(c)] = 1;
    });
  }
  extent.from_mm = std::numeric_limits<double>::infinity();
  extent.to_mm = -extent.from_mm;
  for (const WeightChange& change : changes) {
    if (within[cells.index(cells.at(change.place))] == 0) continue;
    extent.from_mm = std::min(extent.from_mm, change.s_mm);
    extent.to_mm = std::max(extent.to_mm, change.s_mm);
  }
  if (extent.from_mm > extent.to_mm) extent.from_mm = extent.to_mm = changes.front().s_mm;
  return extent;
}

}  // namespace

ChangeExtent extent_of(const std::vector<WeightChange>& changes, Kernel kernel, double support_radius_mm) {
  if (changes.empty()) return {};
  Cells cells;
  cells.size = 0.5 * support_radius_mm;
  geometry::Box3 box;
  for (const WeightChange& change : changes) box.extend(change.place);
  cells.first = (box.min() / cells.size).array().floor().cast<int>() - 2;
  cells.count = (box.max() / cells.size).array().floor().cast<int>() + 3 - cells.first;
  if (cells.count.cast<double>().prod() > static_cast<double>(most_cells))
    return everywhere(changes, support_radius_mm);
  cells.sum.assign(static_cast<std::size_t>(cells.count.prod()), 0.0);
  std::vector<Cell> filled;
  for (const WeightChange& change : changes) {
    const Cell at = cells.at(change.place);
    double& sum = cells.sum[cells.index(at)];
    if (sum == 0.0) filled.push_back(at);
    sum += std::abs(change.by);
  }
  const std::vector<double> bound = bounds_of(cells, filled, kernel);

  ImplicitCoefficients difference;
  difference.kernel = kernel;
  difference.support_radius_mm = support_radius_mm;
  for (const WeightChange& change : changes) {
    difference.centres.push_back(change.place);
    difference.weights.push_back(change.by);
  }
  const ImplicitSurface field(std::move(difference));
  std::vector<Cell> doubtful, marked;
  std::vector<Vec3> places;
  Cell cell;
  for (cell.z() = 0; cell.z() < cells.count.z(); ++cell.z())
    for (cell.y() = 0; cell.y() < cells.count.y(); ++cell.y())
      for (cell.x() = 0; cell.x() < cells.count.x(); ++cell.x()) {
        if (!(bound[cells.index(cell)] > least_change_mm)) continue;
        if (bound[cells.index(cell)] > surely) {
          marked.push_back(cell);
          continue;
        }
        doubtful.push_back(cell);
        for (int k = 0; k < 8; ++k) {
          const Vec3 share(k & 1 ? 0.75 : 0.25, k & 2 ? 0.75 : 0.25, k & 4 ? 0.75 : 0.25);
          places.push_back(cells.corner(cell) + cells.size * share);
        }
      }
  std::vector<double> values(places.size());
  field.values(places, values);
  for (std::size_t i = 0; i < doubtful.size(); ++i)
    if (std::any_of(values.begin() + static_cast<std::ptrdiff_t>(8 * i),
                    values.begin() + static_cast<std::ptrdiff_t>(8 * i + 8),
                    [](double value) { return !(std::abs(value) <= in_hand * least_change_mm); }))
      marked.push_back(doubtful[i]);
  return around(marked, cells, changes);
}

}  // namespace ostia::lumen
