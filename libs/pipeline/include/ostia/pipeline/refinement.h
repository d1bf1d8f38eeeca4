#pragma once
/// \file A mesh's lengths from what a solver computed on the one before ([Antiga] 7).

#include "ostia/core/task_context.h"
#include "ostia/geometry/vec.h"
#include "ostia/meshing/field_sizing.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

struct RefinementOptions {
  std::filesystem::path
      result;         ///< a VTU file of a linear volume mesh with fields, or a folder with result.vtu
  std::string field;  ///< its name: in the elements where it is known there, else at nodes
  meshing::FieldSizingOptions sizing;
};

/// What was asked for, what is foretold, and what the mesh came to: part of quality.json.
struct RefinementReport {
  std::string field;
  bool at_elements = false;
  meshing::FieldSizingOptions asked;
  double range = 0.0, largest_error = 0.0, target_error = 0.0, reached_error = 0.0;  ///< in the field's unit
  double refined_share = 0.0, held_share = 0.0;                                      ///< of the volume
  double least_edge_mm = 0.0, largest_edge_mm = 0.0;  ///< of the lengths asked for
  double elements_before = 0.0, elements_foretold = 0.0;
  std::size_t elements = 0;  ///< of the mesh that was made
};

struct Refinement {
  std::shared_ptr<const meshing::SizeField> sizes;
  RefinementReport report;
  std::vector<std::string> warnings;
};

/// Reads the result and turns its field into lengths. `box` is around what is to be meshed. Throws
/// InvalidInput: options, no VTU file, no field of that name (with those that there are), a result that lies
/// elsewhere or is in another unit, and what read_volume_mesh and sizes_from_field throw; Cancelled.
Refinement refinement_by(const RefinementOptions& options, const geometry::Box3& box,
                         const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
