#pragma once
/// \file What `ostia mesh` says when it is done.

#include <filesystem>

namespace ostia::app {

/// The folder's quality.json on standard output, or one line of it: elements, their least angles, volume, and
/// whether the gate has passed.
void tell_mesh(const std::filesystem::path& folder, bool as_json);

}  // namespace ostia::app
