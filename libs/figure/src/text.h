#pragma once
/// \file Text that is safe to draw and to embed.

#include <string>
#include <string_view>
#include <vector>

namespace ostia::figure {

/// Valid UTF-8: each byte that is part of no character becomes U+FFFD; control characters but tab and newline
/// are dropped.
std::string clean_utf8(std::string_view text);
/// Whether a table's cell reads as a number, with or without a unit or sign behind it ("12.5", "-3 mm", "95
/// %").
bool looks_numeric(std::string_view cell);
/// Which columns hold numbers alone (empty cells and dashes aside).
std::vector<bool> numeric_columns(std::size_t columns, const std::vector<std::vector<std::string>>& rows);

}  // namespace ostia::figure
