#pragma once
/// \file What the parent and the child that runs a mesher exchange: two binary files in the machine's own
/// byte order.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace ostia::meshing {

struct MesherJob {
  std::int32_t mesher = tetgen;
  double max_radius_edge_ratio = 1.4;
  double min_dihedral_deg = 10.0;
  std::vector<geometry::Vec3> points;
  std::vector<double> sizes;  ///< bound on circumradii near each point, mm
  std::vector<geometry::Triangle> triangles;
  std::vector<std::int32_t> face_ids;  ///< one a triangle
  /// Bounds inside, at points of their own; none: they follow the surface's.
  std::vector<geometry::Vec3> field_points = {};
  std::vector<double> field_sizes = {};
  double field_gradation = 0.3;  ///< mm per mm

  static constexpr std::int32_t tetgen = 0, mesh3 = 1;
};
struct MesherResult {
  std::vector<geometry::Vec3> points;  ///< TetGen: the job's first; Mesh_3: the boundary's first
  std::vector<geometry::Tetrahedron> tetrahedra;
  std::vector<geometry::Triangle> boundary;  ///< Mesh_3 only: outward
  std::vector<std::int32_t> boundary_face_ids;
};

/// All throw IoError, or ResourceError when the disk is full; the readers InvalidInput for a file that is not
/// whole.
void write_job(const MesherJob& job, const std::filesystem::path& path);
MesherJob read_job(const std::filesystem::path& path);
void write_result(const MesherResult& result, const std::filesystem::path& path);
MesherResult read_result(const std::filesystem::path& path);

}  // namespace ostia::meshing
