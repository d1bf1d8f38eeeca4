#pragma once
/// \file A folder that is written anew takes the place of an old one.

#include <filesystem>
#include <string>

namespace ostia::io {

/// `staged` is about to take the place of the folder `path`. Where that holds anything else, such as a case's
/// settings, it would be lost: throws InvalidInput, which begins with `what`.
void require_nothing_lost(const std::filesystem::path& staged, const std::filesystem::path& path,
                          const std::string& what);

}  // namespace ostia::io
