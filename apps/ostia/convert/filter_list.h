#pragma once
/// \file What `ostia filter --list` prints.

#include <string>

namespace ostia::app {

/// A line a filter and a line a parameter.
std::string filters_text();
/// filters.schema.json.
std::string filters_json();

}  // namespace ostia::app
