#pragma once
/// \file The writers behind mesh_export.h, one source each. Each writes into a file or an existing folder
/// that is invisible until export_mesh commits it, and throws IoError or ResourceError when that fails.

#include "mesh/prepared.h"

#include <filesystem>
#include <string>

namespace ostia::io {

void write_vtu(const PreparedMesh& mesh, const std::filesystem::path& file);
void write_stl_faces(const PreparedMesh& mesh, const std::filesystem::path& folder);
void write_openfoam(const PreparedMesh& mesh, const std::filesystem::path& folder);
void write_mesh_complete(const PreparedMesh& mesh, const std::filesystem::path& folder);
void write_gmsh2(const PreparedMesh& mesh, const std::filesystem::path& file);
void write_gmsh4(const PreparedMesh& mesh, const std::filesystem::path& file);
void write_fluent(const PreparedMesh& mesh, const std::filesystem::path& file);
void write_abaqus(const PreparedMesh& mesh, const std::filesystem::path& file);
void write_xdmf(const PreparedMesh& mesh, const std::filesystem::path& folder);
void write_exodus(const PreparedMesh& mesh, const std::filesystem::path& file);
void write_cgns(const PreparedMesh& mesh, const std::filesystem::path& file);

/// The volume's number where volumes and faces are numbered together: one more than the largest face id.
inline std::int32_t volume_id(const PreparedMesh& mesh) {
  std::int32_t largest = 0;
  for (const geometry::Face& face : mesh.mesh.faces) largest = std::max(largest, face.id);
  return largest + 1;
}

}  // namespace ostia::io
