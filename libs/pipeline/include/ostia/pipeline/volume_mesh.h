#pragma once
/// \file What fills a lumen, how good it is, and how it is handed to other programs.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/io/mesh_export.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/flow_extension.h"
#include "ostia/meshing/mixed_quality.h"
#include "ostia/meshing/quadratic.h"
#include "ostia/meshing/shape_kept.h"
#include "ostia/meshing/tetrahedralize.h"
#include "ostia/pipeline/refinement.h"
#include "ostia/pipeline/solver_case.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

struct VolumeOptions {
  meshing::TetrahedralizeOptions tetrahedralize;
  std::optional<meshing::BoundaryLayerOptions> layers;  ///< of prisms on the wall; none: tetrahedra alone
  bool split_prisms = false;                            ///< each prism into three tetrahedra; needs layers
  int order = 1;                        ///< of the elements: 1, or 2 with nodes on the wall before remeshing
  std::vector<io::MeshFormat> formats;  ///< besides mesh.vtu, which is always written
  std::optional<RefinementReport> refinement;  ///< why `tetrahedralize.field` is as it is
  std::optional<SolverCase> solver_case;       ///< written with the mesh; none unless asked for
};
/// Throws InvalidInput for numbers out of range, and for a format that cannot hold the elements: told before
/// anything is computed.
void validate(const VolumeOptions& options);

/// What is known of a mesh: quality.json.
struct MeshQuality {
  meshing::SurfaceQuality surface;
  meshing::MixedQuality volume;
  std::optional<meshing::WallDeviation> wall_deviation;  ///< from the wall before remeshing
  std::optional<meshing::ShapeKept> shape;               ///< the same both ways, and the volume
  std::optional<meshing::BoundaryLayerReport> layers;
  std::optional<meshing::QuadraticReport> quadratic;
  std::vector<meshing::FlowExtension> extensions;
  std::optional<RefinementReport> refinement;
  meshing::QualityVerdict verdict;  ///< of surface and volume
};
/// Of tetrahedra and prisms together.
double least_dihedral_deg(const meshing::MixedQuality& quality);
double least_scaled_jacobian(const meshing::MixedQuality& quality);

struct FilledVolume {
  geometry::MixedMesh mesh;
  std::vector<bool> in_layers;  ///< tetrahedra that were prisms, the last ones; empty: none
  std::optional<meshing::BoundaryLayerReport> layers;
  std::optional<meshing::QuadraticReport> quadratic;
  /// The mesh's boundary, where the mesher that took over could not keep the surface.
  std::optional<geometry::FacedSurface> new_surface;
  std::vector<std::string> warnings;
};
/// The inside of a closed surface with faces; `reference` is the surface before remeshing, whose wall has the
/// nodes of the second order. Throws what fill_with_layers, tetrahedralize and make_quadratic throw.
FilledVolume fill_volume(const geometry::FacedSurface& surface, const geometry::FacedSurface& reference,
                         const VolumeOptions& options = {}, const core::TaskContext& task = core::no_task());

/// The triangles that belong to faces of kind `wall`, on all points of the surface.
geometry::TriMesh wall_of(const geometry::FacedSurface& surface);

/// A mesh of any origin, judged. The boundary must be closed, oriented and free of self-intersections as a
/// surface is; angles are those of the wall's triangles, since a layer's side is thin however good it is; a
/// wall of quadrilaterals alone has none.
/// Throws what mixed_quality throws.
MeshQuality judged(const geometry::MixedMesh& mesh, const core::TaskContext& task = core::no_task());
/// The same where it is known which tetrahedra belong to layers: of each tetrahedron.
MeshQuality judged(const geometry::MixedMesh& mesh, const std::vector<bool>& in_layers,
                   const core::TaskContext& task = core::no_task());

/// The file or folder of a format beside others: `mesh.vtu`, `openfoam`, `mesh-gmsh4.msh` (three formats have
/// the extension .msh), ...
std::string name_in_folder(io::MeshFormat format);

/// Writes mesh.vtu, the formats and the solver's case into an existing folder. Where tetrahedra belong to
/// layers, formats that can say so do (io::MeshExportOptions::layer_tetrahedra). Returns the writers'
/// warnings, each once.
std::vector<std::string> write_volume_mesh(const std::filesystem::path& folder,
                                           const geometry::MixedMesh& mesh,
                                           const std::vector<bool>& in_layers, const VolumeOptions& options,
                                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
