#pragma once
/// \file The whole chain of [Luboz] on one scan (3.3): denoised, segmented, thinned, reconstructed; how far
/// the surface of few quadrilaterals is from the isosurface.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_graph.h"
#include "ostia/imaging/volume.h"
#include "ostia/reconstruction/surface.h"
#include "ostia/segmentation/rival_growth.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::experiments {

using geometry::Vec3;

/// One way to reconstruct.
struct ChainMesh {
  int sides = 4;         ///< of a section before subdivision; even, in [4, 32]
  double spacing = 1.2;  ///< half the distance of sections, in radii; in [0.1, 10]
  int level = 0;         ///< in [0, 3]
};

struct ChainOptions {
  segmentation::RivalGrowthOptions growth;
  int diffusion_iterations = 5;  ///< flux-based, before all else, in [0, 1000]; 0: none
  double thinnest_mm = 2.0;      ///< vessels of a smaller diameter are ignored, as in the paper; in [0, 20]
  double curvature = 0.1;        ///< weight of the level set's minimal curvature, >= 0
  int iterations = 300;          ///< of the level set, at most; >= 0
  double prune_mm = 2.0, gap_mm = 2.0, sigma_mm = 0.4;  ///< of the skeleton ([Luboz] 3.1, but prune_mm)
  double knots_mm = 8.0;                                ///< of its smooth lines, > 0
  std::vector<ChainMesh> meshes{{4, 1.2, 0}, {4, 2.4, 0}, {4, 3.6, 0}, {4, 2.4, 1}, {8, 1.2, 0}, {8, 1.2, 1}};
  bool elliptic = true;  ///< sections are ellipses of the isosurface's; else circles of their areas
};
void validate(const ChainOptions& options);  ///< throws InvalidInput

struct ChainSurface {
  ChainMesh how;
  reconstruction::ReconstructedSurface made;
  std::size_t triangles = 0;           ///< two a quadrilateral
  double share = 0.0;                  ///< its triangles over the isosurface's
  evaluation::SurfaceDistances apart;  ///< from and to the isosurface, ends and joints included
  bool closed = false;
  std::size_t self_intersections = 0;
};

struct ChainResult {
  std::int64_t own_voxels = 0, rival_voxels = 0;
  double vessel_hu = 0.0, background_hu = 0.0;  ///< medians inside, and close by outside
  int iterations = 0;                           ///< of the level set
  geometry::TriMesh isosurface;
  std::int64_t lines = 0, components = 0, loops = 0;  ///< of the skeleton
  double length_mm = 0.0;                             ///< of all its lines
  geometry::VesselGraph network;                      ///< radii of circles with the isosurface's areas
  std::vector<ChainSurface> surfaces;                 ///< one an element of `meshes`, in their order
};

/// From places in the vessels wanted, and in those that touch them and are not: what belongs to which
/// (`grown_against`), the others replaced by what is around, a level set on the image's own edges from there,
/// its isosurface and skeleton, and the surfaces. LPS, mm. Deterministic. Throws what the steps throw.
ChainResult run_vessel_chain(const imaging::ImageVolume& scan, const std::vector<Vec3>& seeds,
                             const std::vector<Vec3>& rivals, const ChainOptions& options = {},
                             const core::TaskContext& task = core::no_task());

/// The surface nearest to the isosurface (RMS) of those with at most this share of its triangles; null where
/// there is none.
const ChainSurface* nearest_within(const ChainResult& result, double share);

}  // namespace ostia::experiments
