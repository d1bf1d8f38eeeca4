#pragma once
/// \file What a command says when it is done: one line for a person, or one JSON object.

#include "ostia/pipeline/reached.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace ostia::app {

using ToldJson = nlohmann::ordered_json;

/// On standard output: `facts` with "v" and "kind" in front and the warnings that the command has given
/// behind, or `line`.
void tell(const std::string& kind, const ToldJson& facts, const std::string& line, bool as_json);

/// An array of objects with place, reached, missing_mm.
ToldJson json_of(const std::vector<pipeline::UnreachedPlace>& places);

/// "1,234 triangles" without the comma; the noun's plural has an s.
std::string counted(std::size_t count, const std::string& noun);

}  // namespace ostia::app
