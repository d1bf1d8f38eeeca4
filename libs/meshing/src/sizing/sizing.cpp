#include "ostia/meshing/sizing.h"

#include "sizing/gradation.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/curvature.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("sizing: " + what);
}

void validate(const SizeFocus& focus) {
  if (!focus.place.allFinite() || !(focus.reach_mm > 0.0) || !std::isfinite(focus.reach_mm))
    refuse("a focus must have a finite place and a positive reach_mm");
  if (!(focus.share >= 0.05 && focus.share <= 1.0))
    refuse("share " + std::to_string(focus.share) + " of a focus must lie in [0.05, 1]");
}

void validate(const SizeArray& array) {
  if (array.edge_mm.size() != array.surface.points.size() || array.surface.triangles.empty())
    refuse("the array has " + std::to_string(array.edge_mm.size()) + " lengths for " +
           std::to_string(array.surface.points.size()) + " points; it needs a surface and one a point");
  for (std::size_t i = 0; i < array.edge_mm.size(); ++i)
    if (!(array.edge_mm[i] > 0.0) || !std::isfinite(array.edge_mm[i]))
      refuse("the array's length at point " + std::to_string(i) + " is " + std::to_string(array.edge_mm[i]) +
             " mm; it must be positive and finite");
}

}  // namespace

void validate(const SizingOptions& o) {
  if (!(o.edge_ratio >= 0.02 && o.edge_ratio <= 2.0))
    refuse("edge_ratio " + std::to_string(o.edge_ratio) + " must lie in [0.02, 2]");
  if (!(o.gradation >= 0.01 && o.gradation <= 2.0))
    refuse("gradation " + std::to_string(o.gradation) + " mm per mm must lie in [0.01, 2]");
  if (!(o.min_edge_mm >= 0.0) || !(o.max_edge_mm > o.min_edge_mm))
    refuse("the shortest edge (min_edge_mm) must be at least 0 and the longest (max_edge_mm) larger than it");
  if (!(o.most_distance_radii >= 1.0))
    refuse("most_distance_radii " + std::to_string(o.most_distance_radii) + " must be 1 or more");
  if (o.curvature_ratio != 0.0 && !(o.curvature_ratio >= 0.02 && o.curvature_ratio <= 2.0))
    refuse("curvature_ratio " + std::to_string(o.curvature_ratio) + " must be 0 or lie in [0.02, 2]");
  if (!(o.curvature_reach >= 0.1 && o.curvature_reach <= 2.0))
    refuse("curvature_reach " + std::to_string(o.curvature_reach) + " must lie in [0.1, 2]");
  for (const SizeFocus& focus : o.foci) validate(focus);
  if (!(o.throat_share >= 0.05 && o.throat_share <= 1.0))
    refuse("throat_share " + std::to_string(o.throat_share) + " must lie in [0.05, 1]");
  if (o.array) validate(*o.array);
  if (o.field) validate(*o.field);
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
  limit_growth(
      surface.points, [&](std::size_t i) -> const auto& { return neighbours[i]; }, gradation,
      edge_lengths_mm);
}

namespace {

/// D_c or R_c at each point of the surface.
std::vector<double> vessel_sizes(const geometry::TriMesh& surface, const TubeFunction& tube,
                                 const SizingOptions& options, const core::TaskContext& task) {
  std::vector<double> sizes(surface.points.size());
  core::parallel_chunks(sizes.size(), 1024, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      const TubeSize size = tube(surface.points[i]);
      sizes[i] = options.measure == SizeMeasure::radius
                     ? size.radius_mm
                     // The middle of a cap lies on the axis, and has no length of its own.
                     : std::clamp(size.distance_mm, 0.05 * size.radius_mm,
                                  std::max(0.05, options.most_distance_radii) * size.radius_mm);
    }
  });
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (!(sizes[i] > 0.0) || !std::isfinite(sizes[i]))
      throw GeometryError(
          "point " + std::to_string(i) + " of the surface lies on the axis, so its target edge length is " +
          std::to_string(sizes[i]) + " mm; check that centerline and surface belong together");
  return sizes;
}

/// A wall farther from its axis than this many inscribed radii belongs to something else.
constexpr double explained_radii = 2.5;
/// The width of such a branch may be this much larger than rays see it.
constexpr double calibre_margin = 1.25;

/// D_c of a wall that no axis explains is no more than what rays see there.
void bound_by_calibre(const geometry::TriMesh& surface, const TubeFunction& tube,
                      const SizingOptions& options, std::vector<double>& sizes,
                      const core::TaskContext& task) {
  if (options.measure != SizeMeasure::distance) return;
  const std::vector<double> radii = local_radii(surface, tube, task);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const TubeSize size = tube(surface.points[i]);
    if (size.distance_mm > explained_radii * size.radius_mm)
      sizes[i] = std::min(sizes[i], calibre_margin * radii[i]);
  }
}

std::vector<double> from_array(const geometry::TriMesh& surface, const SizeArray& array) {
  const geometry::AabbTree tree(array.surface);
  std::vector<double> lengths(surface.points.size());
  core::parallel_for(lengths.size(), 1024, [&](std::size_t i) {
    const geometry::SurfacePoint near = tree.closest(surface.points[i]);
    const geometry::Triangle& t = array.surface.triangles[static_cast<std::size_t>(near.triangle)];
    lengths[i] = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      lengths[i] +=
          near.barycentric[static_cast<Eigen::Index>(k)] * array.edge_mm[static_cast<std::size_t>(t[k])];
  });
  return lengths;
}

void shorten_where_it_bends(const geometry::TriMesh& surface, const std::vector<double>& sizes,
                            const SizingOptions& options, std::vector<double>& lengths,
                            const core::TaskContext& task) {
  std::vector<double> reach = sizes;
  for (double& mm : reach) mm *= options.curvature_reach;
  const auto bends = geometry::principal_curvatures(surface, reach, task);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    lengths[i] = std::min(lengths[i], options.curvature_ratio / std::abs(bends[i].largest));
}

void shorten_to(const SizeField& field, const geometry::TriMesh& surface, std::vector<double>& lengths) {
  const SizeLookup lookup(field);
  core::parallel_for(lengths.size(), 1024,
                     [&](std::size_t i) { lengths[i] = std::min(lengths[i], lookup(surface.points[i])); });
}

void shorten_at(const SizeFocus& focus, const geometry::TriMesh& surface, std::vector<double>& lengths) {
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double far = (surface.points[i] - focus.place).norm() / focus.reach_mm;
    if (far < 1.0) lengths[i] *= focus.share + (1.0 - focus.share) * far;
  }
}

}  // namespace

std::vector<double> target_edge_lengths(const geometry::TriMesh& surface, const TubeFunction& tube,
                                        const SizingOptions& options, const core::TaskContext& task) {
  validate(options);
  std::vector<double> sizes = vessel_sizes(surface, tube, options, task);
  bound_by_calibre(surface, tube, options, sizes, task);
  std::vector<double> lengths;
  if (options.array) {
    lengths = from_array(surface, *options.array);
  } else {
    lengths = sizes;
    for (double& length : lengths) length *= options.edge_ratio;
  }
  if (options.curvature_ratio > 0.0) shorten_where_it_bends(surface, sizes, options, lengths, task);
  for (const SizeFocus& focus : options.foci) shorten_at(focus, surface, lengths);
  if (options.field) shorten_to(*options.field, surface, lengths);
  for (double& length : lengths) length = std::clamp(length, options.min_edge_mm, options.max_edge_mm);
  limit_gradation(surface, options.gradation, lengths);
  return lengths;
}

}  // namespace ostia::meshing
