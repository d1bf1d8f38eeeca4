#include "ostia/centerline/delaunay.h"

#include "ostia/core/error.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <string>

namespace ostia::centerline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel,
                                                           CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Point = Kernel::Point_3;

std::vector<Point> to_cgal(const std::vector<geometry::Vec3>& points) {
  std::vector<Point> result;
  result.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const geometry::Vec3& p = points[i];
    if (!p.allFinite())
      throw InvalidInput("point " + std::to_string(i) + " has a coordinate that is not finite");
    result.emplace_back(p.x(), p.y(), p.z());
  }
  return result;
}

// A biased randomised insertion order: rounds that double in size, each along a Hilbert curve. The shuffle is
// our own and seeded, so that the order, and with it the numbering of the cells, is the same in every call.
std::vector<std::size_t> insertion_order(const std::vector<Point>& points) {
  std::vector<std::size_t> order(points.size());
  if (order.empty()) return order;  // the property map below takes the address of the first point
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 generator(20240229);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[generator() % i]);
  using Map = CGAL::Pointer_property_map<Point>::const_type;
  const CGAL::Spatial_sort_traits_adapter_3<Kernel, Map> traits(CGAL::make_property_map(points));
  constexpr std::size_t smallest_round = 64;
  std::size_t last = order.size();
  while (last > 0) {
    const std::size_t first = last > smallest_round ? last / 4 : 0;
    CGAL::hilbert_sort(order.begin() + static_cast<std::ptrdiff_t>(first),
                       order.begin() + static_cast<std::ptrdiff_t>(last), traits);
    last = first;
  }
  return order;
}

// Place of each point along one Hilbert curve through all.
std::vector<std::int32_t> hilbert_ranks(const std::vector<Point>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  using Map = CGAL::Pointer_property_map<Point>::const_type;
  CGAL::hilbert_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>(CGAL::make_property_map(points)));
  std::vector<std::int32_t> ranks(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) ranks[order[i]] = static_cast<std::int32_t>(i);
  return ranks;
}

// Cells are numbered by the lowest rank of their corners: neighbours in space lie close together in memory.
Delaunay to_arrays(Triangulation& triangulation, const std::vector<std::int32_t>& ranks) {
  std::vector<std::int32_t> next(ranks.size() + 1, 0);
  const auto lowest_rank = [&](const auto& cell) {
    std::int32_t lowest = std::numeric_limits<std::int32_t>::max();
    for (int i = 0; i < 4; ++i)
      lowest = std::min(lowest, ranks[static_cast<std::size_t>(cell->vertex(i)->info())]);
    return static_cast<std::size_t>(lowest);
  };
  std::size_t count = 0;
  for (auto cell : triangulation.all_cell_handles()) {
    cell->info() = -1;
    if (triangulation.is_infinite(cell)) continue;
    ++count;
    ++next[lowest_rank(cell) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (auto cell : triangulation.finite_cell_handles()) cell->info() = next[lowest_rank(cell)]++;
  Delaunay result;
  result.cells.resize(count);
  result.neighbours.resize(count);
  for (auto cell : triangulation.finite_cell_handles()) {
    const auto place = static_cast<std::size_t>(cell->info());
    for (int i = 0; i < 4; ++i) {
      result.cells[place][static_cast<std::size_t>(i)] = cell->vertex(i)->info();
      result.neighbours[place][static_cast<std::size_t>(i)] = cell->neighbor(i)->info();
    }
  }
  return result;
}

}  // namespace

Delaunay delaunay(const std::vector<geometry::Vec3>& points, const core::TaskContext& task) {
  const std::vector<Point> sites = to_cgal(points);
  const std::vector<std::size_t> order = insertion_order(sites);
  Triangulation triangulation;
  Triangulation::Cell_handle hint;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i % 1024 == 0) {
      task.throw_if_cancelled();
      task.set_progress(static_cast<double>(i) / static_cast<double>(order.size()));
    }
    const std::size_t before = triangulation.number_of_vertices();
    const auto vertex = triangulation.insert(sites[order[i]], hint);
    if (triangulation.number_of_vertices() > before) vertex->info() = static_cast<std::int32_t>(order[i]);
    hint = vertex->cell();
  }
  if (triangulation.dimension() < 3)
    throw GeometryError("the " + std::to_string(points.size()) +
                        " points of the surface do not span a volume: give a surface that encloses a lumen");
  task.throw_if_cancelled();
  const std::vector<std::int32_t> ranks = hilbert_ranks(sites);
  task.throw_if_cancelled();
  Delaunay result = to_arrays(triangulation, ranks);
  task.throw_if_cancelled();
  result.dropped_points = points.size() - triangulation.number_of_vertices();
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::centerline
