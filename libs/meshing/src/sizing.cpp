#include "ostia/meshing/sizing.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <string>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

void validate(const SizingOptions& o) {
  auto refuse = [](const std::string& what) { throw InvalidInput("sizing: " + what); };
  if (!(o.edge_ratio >= 0.02 && o.edge_ratio <= 2.0))
    refuse("edge_ratio " + std::to_string(o.edge_ratio) + " must lie in [0.02, 2]");
  if (!(o.gradation >= 0.01 && o.gradation <= 2.0))
    refuse("gradation " + std::to_string(o.gradation) + " mm per mm must lie in [0.01, 2]");
  if (!(o.min_edge_mm >= 0.0) || !(o.max_edge_mm > o.min_edge_mm))
    refuse("min_edge_mm must be at least 0 and max_edge_mm larger than it");
}

TubeFunction::TubeFunction(const geometry::VesselTree& tree) {
  for (const geometry::TreeSegment& segment : tree.segments) add(segment.axis);
  build_blocks();
}

TubeFunction::TubeFunction(const std::vector<geometry::Centerline>& lines) {
  for (const geometry::Centerline& line : lines) add(line);
  build_blocks();
}

void TubeFunction::add(const geometry::Centerline& line) {
  if (line.radius.size() != line.size())
    throw InvalidInput("an axis has " + std::to_string(line.size()) + " points but " +
                       std::to_string(line.radius.size()) + " radii; the tube function needs one a point");
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!line.points[i].allFinite() || !(line.radius[i] >= 0.0) || !std::isfinite(line.radius[i]))
      throw InvalidInput("point " + std::to_string(i) + " of an axis has radius " +
                         std::to_string(line.radius[i]) + " mm; it must be finite and not negative");
    if (i + 1 < line.size())
      pieces_.push_back({line.points[i], line.points[i + 1] - line.points[i], line.radius[i],
                         line.radius[i + 1] - line.radius[i]});
  }
}

void TubeFunction::build_blocks() {
  if (pieces_.empty())
    throw InvalidInput("the tree has no segment of two points or more; compute centerlines first");
  constexpr std::size_t per_block = 16;
  for (std::size_t first = 0; first < pieces_.size(); first += per_block) {
    Block block{Vec3::Zero(), 0.0, 0.0, first, std::min(first + per_block, pieces_.size())};
    geometry::Box3 box;
    for (std::size_t i = first; i < block.last; ++i)
      box.extend(pieces_[i].a).extend(pieces_[i].a + pieces_[i].step);
    block.centre = box.center();
    block.reach = 0.5 * box.diagonal().norm();
    for (std::size_t i = first; i < block.last; ++i)
      block.max_radius =
          std::max({block.max_radius, pieces_[i].radius, pieces_[i].radius + pieces_[i].radius_step});
    blocks_.push_back(block);
  }
}

TubeSize TubeFunction::operator()(const Vec3& point) const {
  TubeSize best;
  best.tube_mm2 = std::numeric_limits<double>::infinity();
  auto consider = [&](const Piece& piece, double t) {
    const Vec3 axis_point = piece.a + t * piece.step;
    const double radius = piece.radius + t * piece.radius_step;
    const double squared = (point - axis_point).squaredNorm();
    if (squared - radius * radius < best.tube_mm2)
      best = {std::sqrt(squared), radius, squared - radius * radius, axis_point};
  };
  for (const Block& block : blocks_) {
    const double near = std::max(0.0, (point - block.centre).norm() - block.reach);
    if (near * near - block.max_radius * block.max_radius >= best.tube_mm2) continue;
    for (std::size_t i = block.first; i < block.last; ++i) {
      const Piece& piece = pieces_[i];
      // Equation 8: products in the four-dimensional space (x, y, z, i r), where the radius counts negative.
      const double squared = piece.step.squaredNorm() - piece.radius_step * piece.radius_step;
      const double along = (point - piece.a).dot(piece.step) + piece.radius * piece.radius_step;
      if (squared > 0.0) {
        consider(piece, std::clamp(along / squared, 0.0, 1.0));
      } else {  // one ball holds the other: the minimum is at an end
        consider(piece, 0.0);
        consider(piece, 1.0);
      }
    }
  }
  return best;
}

void limit_gradation(const geometry::TriMesh& surface, double gradation,
                     std::vector<double>& edge_lengths_mm) {
  const auto neighbours = geometry::vertex_neighbours(surface);
  using Item = std::pair<double, std::int32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (std::size_t i = 0; i < edge_lengths_mm.size(); ++i)
    queue.emplace(edge_lengths_mm[i], static_cast<std::int32_t>(i));
  while (!queue.empty()) {
    const auto [value, from] = queue.top();
    queue.pop();
    if (value > edge_lengths_mm[static_cast<std::size_t>(from)]) continue;
    for (const std::int32_t to : neighbours[static_cast<std::size_t>(from)]) {
      const double step =
          (surface.points[static_cast<std::size_t>(to)] - surface.points[static_cast<std::size_t>(from)])
              .norm();
      const double limit = value + gradation * step;
      if (limit < edge_lengths_mm[static_cast<std::size_t>(to)]) {
        edge_lengths_mm[static_cast<std::size_t>(to)] = limit;
        queue.emplace(limit, to);
      }
    }
  }
}

std::vector<double> target_edge_lengths(const geometry::TriMesh& surface, const TubeFunction& tube,
                                        const SizingOptions& options, const core::TaskContext& task) {
  validate(options);
  std::vector<double> lengths(surface.points.size());
  core::parallel_chunks(lengths.size(), 1024, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      const TubeSize size = tube(surface.points[i]);
      const double measure = options.measure == SizeMeasure::distance ? size.distance_mm : size.radius_mm;
      lengths[i] = std::clamp(options.edge_ratio * measure, options.min_edge_mm, options.max_edge_mm);
    }
  });
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (!(lengths[i] > 0.0) || !std::isfinite(lengths[i]))
      throw GeometryError(
          "point " + std::to_string(i) + " of the surface lies on the axis, so its target edge length is " +
          std::to_string(lengths[i]) + " mm; check that centerline and surface belong together");
  limit_gradation(surface, options.gradation, lengths);
  return lengths;
}

}  // namespace ostia::meshing
