#pragma once
/// \file Edits as JSON lines (`edits.jsonl`, docs/schemas/edit.schema.json).

#include "ostia/lumen/edit.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::session {

/// One line without its end: {"v":1,"op":"cpr.stroke","vessel":7,"points":[[x,y,z],...],...}. Numbers are
/// written so that they are read back to the last bit.
std::string to_json(const lumen::Edit& edit);
/// Throws InvalidInput naming the field, what is wrong with it and what is allowed.
lumen::Edit edit_of_json(std::string_view line);
/// Throws InvalidInput naming file and line. Blank lines are skipped.
std::vector<lumen::Edit> read_edits(const std::filesystem::path& path);
void write_edits(const std::filesystem::path& path, const std::vector<lumen::Edit>& edits);

}  // namespace ostia::session
