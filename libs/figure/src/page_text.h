#pragma once
/// \file Text in lines of a width.

#include <string>
#include <vector>

namespace ostia::figure {

/// The text, redacted and valid, in lines no wider than `width_px`: broken between words, and within one that
/// is wider itself. A newline begins another line; at least one line, which may be empty.
std::vector<std::string> wrapped(const std::string& text, double size_px, bool bold, double width_px);
/// The widest word of a text, px: what its column needs so that no word is broken.
double widest_word(const std::string& text, double size_px, bool bold);
/// The text, or as much of it as fits with an ellipsis.
std::string cut_to(const std::string& text, double size_px, bool bold, double width_px);

}  // namespace ostia::figure
