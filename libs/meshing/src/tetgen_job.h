#pragma once
/// \file What the parent and the TetGen child exchange: two small binary files in the machine's own byte
/// order.

#include "ostia/geometry/tri_mesh.h"

#include <filesystem>
#include <vector>

namespace ostia::meshing {

struct TetgenJob {
  double max_radius_edge_ratio = 1.4;
  double min_dihedral_deg = 10.0;
  std::vector<geometry::Vec3> points;
  std::vector<double> sizes;  ///< bound on circumradii near each point, mm
  std::vector<geometry::Triangle> triangles;
};
struct TetgenResult {
  std::vector<geometry::Vec3> points;  ///< the job's first
  std::vector<geometry::Tetrahedron> tetrahedra;
};

/// All throw IoError, or ResourceError when the disk is full; the readers InvalidInput for a file that is not
/// whole.
void write_job(const TetgenJob& job, const std::filesystem::path& path);
TetgenJob read_job(const std::filesystem::path& path);
void write_result(const TetgenResult& result, const std::filesystem::path& path);
TetgenResult read_result(const std::filesystem::path& path);

}  // namespace ostia::meshing
