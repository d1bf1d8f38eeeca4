#pragma once
/// \file A mesh that was made, prepared for being looked at.

#include "ostia/core/task_context.h"
#include "ostia/meshing/element_measures.h"
#include "ostia/view/mesh_shell.h"
#include "ostia/view/scene_colors.h"

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
  std::string name;  ///< of the folder
  std::shared_ptr<const view::ShownMesh> mesh;
  /// By meshing::ElementMeasure, of each element, tetrahedra first.
  std::array<std::shared_ptr<const std::vector<double>>, meshing::element_measure_count> measures;
};

/// What export_mesh has written into a folder; the meshes of several trees as one. Throws what
/// read_volume_mesh, prepared and element_measures throw.
std::shared_ptr<const MeshPreview> preview_of(const std::filesystem::path& folder,
                                              const core::TaskContext& task = core::no_task());

/// As a person reads it, with its unit.
QString title_of(meshing::ElementMeasure measure);
/// Colours from the worst there can be to the best; of lengths from the shortest to the longest there is.
view::ValueScale scale_of(const MeshPreview& preview, meshing::ElementMeasure measure);
/// The worst first, at most so many.
std::vector<std::size_t> worst_elements(const MeshPreview& preview, meshing::ElementMeasure measure,
                                        std::size_t most);

}  // namespace ostia::workstation
