#pragma once
/// \file The meshes in a folder that export_mesh has made.

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// The mesh of one tree.
struct ExportedMesh {
  std::string name;  ///< of the folder that the tree has to itself; empty where there is one tree
  std::filesystem::path file;
};

/// A file: itself. A folder of export_mesh: its mesh.vtu, or with several trees (left and right artery) that
/// of each, by name. None where there is no such file. Never throws for what it may not read.
std::vector<ExportedMesh> exported_meshes(const std::filesystem::path& path);

}  // namespace ostia::pipeline
