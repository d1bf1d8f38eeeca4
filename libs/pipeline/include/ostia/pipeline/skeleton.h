#pragma once
/// \file From a mask to a tree of centerlines by its skeleton ([Luboz] 2.1): all steps of
/// docs/methods/skeleton.md.

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/centerline/skeleton_graph.h"
#include "ostia/centerline/skeleton_radius.h"
#include "ostia/centerline/thinning.h"
#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ostia::pipeline {

/// What a person does to the lines, by places in mm (LPS): cuts first, then removals, then connections, each
/// in their order. Places may lie off the lines by centerline::PlaceOptions.
struct SkeletonCommands {
  std::vector<geometry::Vec3> cuts, removals;
  std::vector<std::pair<geometry::Vec3, geometry::Vec3>> connections;
};

struct SkeletonOptions {
  bool fill_cavities = true;
  centerline::PruneOptions prune;
  bool open_loops = false;  ///< then: `loops_opened`, for vessels that touch but do not join
  centerline::EndOptions ends;
  centerline::GapOptions gaps;
  SkeletonCommands commands;  ///< after the gaps are closed
  centerline::OrientOptions orient;
  std::optional<centerline::SplineOptions> smooth =
      centerline::SplineOptions{};  ///< nothing: lines as thinned
  /// After the first sections; nothing: junctions stay where thinning put them, ends where the mask's voxels
  /// end, and points where their sections have their middles.
  std::optional<centerline::JunctionOptions> settle = centerline::JunctionOptions{};
  centerline::SectionOptions sections;
  double step_mm = 0.5;                ///< between the points of the tree, (0, 10]
  std::vector<geometry::Vec3> inlets;  ///< mm, LPS; none: each component's widest end
};
void validate(const SkeletonOptions& options);  ///< throws InvalidInput

struct SkeletonResult {
  centerline::MeasuredSkeleton skeleton;  ///< with loops
  centerline::SkeletonTree tree;          ///< without
  std::int64_t object_voxels = 0, skeleton_voxels = 0;
  std::int64_t components = 0, loops = 0;  ///< of the skeleton's graph
  double length_mm = 0.0;                  ///< of all lines
  std::vector<std::string> warnings;       ///< filled cavities, guessed roots, opened loops, guessed radii
};

/// `image`: the CT that the mask was made of, for the sections; null: the mask's own edges. Throws
/// InvalidInput (options, a mask without object, an inlet or a command off the lines, an image that does not
/// cover the mask), GeometryError, ResourceError, Cancelled.
SkeletonResult skeleton_of(const imaging::MaskVolume& mask, const imaging::ImageVolume* image,
                           const SkeletonOptions& options = {},
                           const core::TaskContext& task = core::no_task());

/// A line for each point of each edge: edge, place, circle, ellipse, support ("edge,point,x_mm,...").
std::string sections_csv(const centerline::MeasuredSkeleton& skeleton);

}  // namespace ostia::pipeline
