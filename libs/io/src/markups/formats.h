#pragma once
/// \file Readers and writers of markups, by format.

#include "ostia/io/markups_file.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace ostia::io::markups {

inline constexpr std::size_t most_points = 1'000'000;
inline constexpr double most_mm = 1e9;

/// Throws InvalidInput: "cannot read FILE: what".
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what);
/// "1 point", "3 points".
std::string points_text(std::size_t count);

MarkupsFile read_json(const std::filesystem::path& path);
MarkupsFile read_fcsv(const std::filesystem::path& path);
MarkupsFile read_table(const std::filesystem::path& path);
std::string json_text(const std::vector<Markup>& markups);
std::string fcsv_text(const std::vector<Markup>& markups);

}  // namespace ostia::io::markups
