#pragma once
/// \file Edits as JSON lines (`edits.jsonl`, docs/schemas/edit.schema.json).

#include "ostia/lumen/edit.h"

#include <cstddef>
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
/// An edit and the line of the file it stands in, from 1.
struct EditLine {
  std::size_t number = 0;
  lumen::Edit edit;
};
/// The edits of a text, one a line; blank lines are skipped. Throws InvalidInput naming the text and the
/// line.
std::vector<EditLine> edit_lines(std::string_view text, const std::string& name);
/// The same of a file. Throws IoError where it cannot be read.
std::vector<lumen::Edit> read_edits(const std::filesystem::path& path);
void write_edits(const std::filesystem::path& path, const std::vector<lumen::Edit>& edits);

}  // namespace ostia::session
