#pragma once
/// \file A mesh, prepared for being looked at.

#include "ostia/core/task_context.h"
#include "ostia/meshing/element_measures.h"
#include "ostia/meshing/quality.h"
#include "ostia/view/mesh_shell.h"
#include "ostia/view/value_scale.h"

#include <QString>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ostia::workstation {

/// Immutable.
struct MeshPreview {
  std::string name;  ///< of the folder, or of the file in it
  meshing::QualityVerdict verdict;
  std::shared_ptr<const view::ShownMesh> mesh;
  /// By meshing::ElementMeasure, of each element, tetrahedra first.
  std::array<std::shared_ptr<const std::vector<double>>, meshing::element_measure_count> measures;
};

/// What export_mesh has written into a folder, and its verdict on it; the meshes of several trees as one.
/// Throws what read_volume_mesh, prepared and element_measures throw.
std::shared_ptr<const MeshPreview> preview_of(const std::filesystem::path& folder,
                                              meshing::QualityVerdict verdict,
                                              const core::TaskContext& task = core::no_task());

/// The mesh that is meant by a path: itself, the mesh.vtu in a folder of export_mesh, or the OpenFOAM case of
/// which it is a file of the polyMesh. Empty where it is named as no volume mesh is.
std::filesystem::path mesh_meant_by(const std::filesystem::path& path);

/// A mesh of any origin, judged as `ostia mesh --check` does. Throws InvalidInput for what is named as no
/// mesh is, and as preview_of and pipeline::judged do. Cancelled, once the file has been read.
std::shared_ptr<const MeshPreview> opened_mesh(const std::filesystem::path& path,
                                               const core::TaskContext& task = core::no_task());

/// As a person reads it, with its unit.
QString title_of(meshing::ElementMeasure measure);
/// Colours from the worst there can be to the best; of lengths from the shortest to the longest there is.
view::ValueScale scale_of(const MeshPreview& preview, meshing::ElementMeasure measure);
/// The worst first, at most so many.
std::vector<std::size_t> worst_elements(const MeshPreview& preview, meshing::ElementMeasure measure,
                                        std::size_t most);

}  // namespace ostia::workstation
