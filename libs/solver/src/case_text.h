#pragma once
/// \file Small texts of which cases are made.

#include "ostia/geometry/vec.h"

#include <filesystem>
#include <string>

namespace ostia::solver {

/// `(x y z)`.
std::string foam_vector(const geometry::Vec3& v);
/// The head of one of OpenFOAM's files.
std::string foam_head(const std::string& type, const std::string& location, const std::string& object);
/// A file in a folder that is being made, with the folders above it.
void write_case_file(const std::filesystem::path& file, const std::string& text);
/// Throws InvalidInput when `folder` exists and holds anything.
void require_new_folder(const std::filesystem::path& folder);

}  // namespace ostia::solver
