#pragma once
/// \file The second mesher: CGAL Mesh_3.

#include "mesher/mesher_job.h"

namespace ostia::meshing {

/// Meshes the inside anew, surface included: points on the surface, edges between faces of different ids kept
/// as curves, sizes as the job's. Throws GeometryError when nothing comes out.
MesherResult run_mesh3(const MesherJob& job);

}  // namespace ostia::meshing
