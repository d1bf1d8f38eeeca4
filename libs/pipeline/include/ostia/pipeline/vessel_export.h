#pragma once
/// \file The vessels of a lumen model as a surface or a mesh for other programs.

#include "ostia/core/task_context.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/meshing/quality.h"
#include "ostia/meshing/sizing.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/volume_mesh.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// What an exported surface does where a vessel begins or ends.
enum class SurfaceEnds {
  rounded,  ///< closed as the model is, by a dome beyond the end of the axis
  capped,   ///< cut across the axis and closed by flat faces `inlet_<vessel>`, `outlet_<vessel>`
  open,     ///< cut across the axis, without a cap
};

/// Edge lengths that follow the calibre: so many edges around a vessel, thick or thin ([Antiga] equation 9).
/// Throws InvalidInput outside [6, 120].
meshing::SizingOptions edges_around(double edges);
/// The same edge length everywhere; shorter only where fewer than eight edges would be around the lumen.
/// Throws InvalidInput outside [0.05, 3] mm.
meshing::SizingOptions even_edges(double edge_mm);

struct SurfaceExportOptions {
  std::vector<std::int32_t> vessels;  ///< with the vessels that they come from (with_parents); none: all
  SurfaceEnds ends = SurfaceEnds::capped;
  std::optional<meshing::SizingOptions> sizing;    ///< nothing: the triangles of the wall's grid
  std::vector<std::string> formats{"vtp", "stl"};  ///< of vtp, stl, ply; at least one
};
struct MeshExportOptions {
  std::vector<std::int32_t> vessels;  ///< as above
  meshing::SizingOptions sizing;
  VolumeOptions volume;
  /// How far inside its end a vessel is cut, in radii, [0, 10]; walls of cases are straight up to the end of
  /// the axis, where a dome begins.
  double inset_radii = 0.4;
  std::vector<meshing::PlacedPlane> planes;                 ///< where a person wants ends cut instead
  std::optional<meshing::FlowExtensionOptions> extensions;  ///< beyond the cut ends; none unless asked for
  std::vector<std::string> surface_formats{"vtp", "stl"};   ///< of vtp, stl, ply; may be none
};
/// Throw InvalidInput naming the field.
void validate(const SurfaceExportOptions& options);
void validate(const MeshExportOptions& options);

/// How large a mesh of this kind will be, from axes and radii alone, in well under a millisecond a vessel.
struct MeshEstimate {
  double triangles = 0.0, tetrahedra = 0.0, prisms = 0.0;
};
/// Within a fifth of what is made of smooth vessels (measured). Throws as with_parents and validate do.
MeshEstimate estimate_mesh(const lumen::LumenModel& model, const std::vector<std::int32_t>& vessels,
                           const meshing::SizingOptions& sizing, const VolumeOptions& volume = {});
/// Of an export; 5 million took 0.9 GB at most (measured), and TetGen may have 4.
inline constexpr double most_tetrahedra = 8e6;

/// What was made.
struct ExportSummary {
  std::size_t trees = 0;  ///< roots, each with all that hangs on it
  std::size_t triangles = 0, tetrahedra = 0, prisms = 0;
  std::optional<double> full_layers;  ///< share of the wall where the layers have the thickness asked for
  double volume_mm3 = 0.0;            ///< enclosed; 0 for an open surface
  double min_dihedral_deg = 0.0, min_angle_deg = 0.0;
  meshing::QualityVerdict verdict;  ///< of a mesh
  std::vector<std::string> warnings;
};

/// The wall, solved afresh, in a folder that appears whole or not at all: lumen.vtp, .stl, .ply, and
/// centerlines.vtp, quality.json, manifest.json. All trees are in the same files; face names are in the VTP
/// alone. Throws InvalidInput (options; a folder that holds other files), GeometryError naming the vessel
/// that cannot be cut or whose wall is in pieces, IoError, ResourceError (full disk), Cancelled.
ExportSummary export_surface(const std::filesystem::path& folder, const lumen::LumenModel& model,
                             const SurfaceExportOptions& options = {},
                             const core::TaskContext& task = core::no_task());

/// What export_mesh records, and by which `already_done` knows its folder again.
JobKey mesh_job(const lumen::LumenModel& model, const MeshExportOptions& options);

/// A mesh between flat, named ends, in a folder that appears whole or not at all: mesh.vtu and the formats
/// asked for, lumen.vtp, .stl, .ply, centerlines.vtp, quality.json, manifest.json; with several trees a
/// folder for each, named by its first vessel, and a manifest.json over all. Throws as export_surface does.
ExportSummary export_mesh(const std::filesystem::path& folder, const lumen::LumenModel& model,
                          const MeshExportOptions& options = {},
                          const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
