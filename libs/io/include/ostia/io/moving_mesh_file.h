#pragma once
/// \file Meshes that move: the list of their times for ParaView, and OpenFOAM's points by time.

#include "ostia/geometry/mixed_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

struct MeshAtTime {
  double seconds = 0.0;
  std::string file;  ///< relative to the list
};

/// A ParaView data file (.pvd): one mesh a time. Throws IoError, ResourceError.
void write_pvd(const std::filesystem::path& path, const std::vector<MeshAtTime>& times);

/// Of a time in OpenFOAM's folders: "0", "0.04".
std::string openfoam_time(double seconds);

/// Into the case folder that export_mesh has written as OpenFOAM: `<time>/polyMesh/points` and
/// `<time>/pointDisplacement` from the mesh's own points. Metres. Throws InvalidInput for another number of
/// points, IoError, ResourceError.
void write_openfoam_points(const std::filesystem::path& case_folder, double seconds,
                           const geometry::MixedMesh& mesh, const std::vector<geometry::Vec3>& points);

/// `system/controlDict` with the times' step and end, so that OpenFOAM's tools and ParaView read the folder.
void write_openfoam_times(const std::filesystem::path& case_folder, double step_seconds, double end_seconds);

}  // namespace ostia::io
