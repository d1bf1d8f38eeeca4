#pragma once
/// \file Output names checked before the work begins.

#include <filesystem>
#include <string_view>
#include <vector>

namespace ostia::app {

/// Whether the path ends in one of `extensions`, in upper or lower case.
bool has_extension(const std::filesystem::path& path, const std::vector<std::string_view>& extensions);

/// Throws where a result could not be written when it is there: an extension that is not one of `extensions`,
/// a folder that is missing or closed. An empty path (an option left out) is fine.
void require_output(const std::filesystem::path& path, const std::vector<std::string_view>& extensions);

inline const std::vector<std::string_view> surface_outputs{".vtp", ".stl", ".ply"};
inline const std::vector<std::string_view> quad_outputs{".vtp", ".vtk", ".ply", ".obj", ".stl"};
inline const std::vector<std::string_view> image_outputs{".nrrd", ".mhd", ".mha", ".nii", ".nii.gz"};
inline const std::vector<std::string_view> aorta_outputs{".nrrd",   ".mhd", ".mha", ".nii",
                                                         ".nii.gz", ".vtp", ".stl", ".ply"};
inline const std::vector<std::string_view> line_outputs{".vtp", ".csv", ".mrk.json"};

}  // namespace ostia::app
