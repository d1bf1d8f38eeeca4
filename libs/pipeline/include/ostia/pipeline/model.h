#pragma once
/// \file The straight way from an image to a mesh ([Antiga] 2-6), without a person.

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/meshing/clip.h"
#include "ostia/meshing/flow_extension.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/pipeline/lumen_axes.h"
#include "ostia/pipeline/source.h"
#include "ostia/pipeline/volume_mesh.h"
#include "ostia/segmentation/segment.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

struct ModelOptions {
  std::vector<segmentation::BranchSeeds> branches;  ///< needed for an image
  std::optional<geometry::Vec3>
      source;  ///< masks and surfaces: where the centerlines begin; left out: an open end
  std::vector<geometry::Vec3> targets;                ///< ... and end; left out: the other open ends
  SideBranches side_branches = SideBranches::closed;  ///< of masks and surfaces
  segmentation::SegmentOptions segment;
  std::optional<geometry::TaubinOptions> smoothing;  ///< of the segmentation's surface; none unless asked for
  centerline::CenterlineOptions centerline;
  meshing::ClipOptions clip;  ///< its inset_radii is set from the one below
  /// How far inside its end a vessel is cut, in radii; left out: 0.4 for an image, whose ends were made flat
  /// by the seeds, else 1.
  std::optional<double> inset_radii;
  std::optional<meshing::FlowExtensionOptions> extensions;  ///< beyond the cut ends; none unless asked for
  meshing::SizingOptions sizing;
  meshing::RemeshOptions remesh;
  VolumeOptions volume;
  meshing::QualityBounds bounds;  ///< of the surface
  meshing::MixedBounds volume_bounds;
  meshing::ShapeBounds shape_bounds;
};

/// Throws InvalidInput for what no input could be meshed with: told before anything is computed.
void validate(const ModelOptions& options);

/// How long a stage took.
struct StageTime {
  std::string name;
  double seconds = 0.0;
};

/// The surface that a centerline and a mesh can be made of, in one part or, where that may be, in several.
/// Throws GeometryError that counts the faults and says where they are.
void require_sound_surface(const geometry::TriMesh& surface, const std::string& what,
                           bool several_parts = false);

/// A sentence for a person: what helps where walls still cross each other after mending, as commands to type
/// with IN and OUT for the files. It depends on whose walls they are: two parts', or one's with itself.
std::string cure_of_crossings(const geometry::TriMesh& surface);

/// From surface and centerlines to the mesh: cut, capped, remeshed, filled.
struct MeshedLumen {
  centerline::CenterlineResult
      centerlines;                 ///< of the cut lumen: from its inlet's centre to its outlets' centres
  geometry::FacedSurface surface;  ///< closed, remeshed, named faces
  geometry::MixedMesh mesh;
  std::vector<bool> in_layers;  ///< FilledVolume::in_layers
  meshing::RemeshReport remeshing;
  MeshQuality quality;  ///< `surface` is that of the member above
  std::vector<std::string> warnings;
  std::vector<StageTime> stages;
};
/// `tree` says where the ends are; sizes follow the centerlines of the cut lumen, whose radii no closed end
/// narrows, led on through flow extensions where there are any.
MeshedLumen mesh_lumen(const geometry::TriMesh& lumen, const geometry::VesselTree& tree,
                       const ModelOptions& options, const core::TaskContext& task = core::no_task());
/// The same of a surface that came from outside: where triangles stay flat a warning, and every error, offers
/// the command that smooths a rough wall.
MeshedLumen mesh_surface(const geometry::TriMesh& surface, const geometry::VesselTree& tree,
                         const ModelOptions& options, const core::TaskContext& task = core::no_task());
/// mesh_lumen about axes that are known and run inside the lumen, those of a case: none are extracted, and
/// `centerlines` has the axes alone. The wall's distance from them decides sizes (SizeMeasure::distance), so
/// that radii that are older than the wall do no harm.
MeshedLumen mesh_lumen_about(const geometry::TriMesh& lumen, const geometry::VesselTree& axes,
                             const ModelOptions& options, const core::TaskContext& task = core::no_task());

/// Everything that came of one input.
struct Model {
  Source source;
  std::vector<segmentation::BranchDiagnostics> branches;  ///< images only
  std::vector<std::string> left_out;                      ///< branches that could not be followed, and why
  geometry::TriMesh lumen;                                ///< of the segmentation, or as given
  MeshedLumen meshed;
  std::vector<std::string> warnings;  ///< of all stages
  std::vector<StageTime> stages;
};

/// How its ends are cut: see ModelOptions::inset_radii.
meshing::ClipOptions clip_of(const Source& source, const ModelOptions& options);

/// A model up to its mesh, and the lumen's axes from end to end.
struct LumenWithAxes {
  Model model;  ///< without `meshed`
  geometry::VesselTree axes;
  std::vector<meshing::PlacedPlane> stubs;  ///< where side branches are to be cut off
};
/// The stages before meshing, and those after: build_model has both. Throws what the stages throw; nothing
/// is written. `found` gets the lumen as soon as it is there, for when a later stage fails.
LumenWithAxes build_lumen(Source source, const ModelOptions& options,
                          const core::TaskContext& task = core::no_task(),
                          geometry::TriMesh* found = nullptr);
Model mesh_model(LumenWithAxes lumen, const ModelOptions& options,
                 const core::TaskContext& task = core::no_task());

/// Runs all stages. Throws what they throw; nothing is written.
Model build_model(Source source, const ModelOptions& options,
                  const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
