#pragma once
/// \file The files of a cohort's page.

#include <cstddef>
#include <string>
#include <string_view>

namespace ostia::cohort {

inline constexpr const char* page_folder = "page";
inline constexpr std::size_t shown_digest_digits = 16;

/// A page that is opened from the disk may load scripts, and nothing else: data are calls of a function of
/// the page. `value` is JSON.
inline std::string page_data(std::string_view name, std::string_view value) {
  return "Cohort." + std::string(name) + "(" + std::string(value) + ");\n";
}

}  // namespace ostia::cohort
