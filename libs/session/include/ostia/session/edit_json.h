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
/// Edits that a plug-in gave: one step of a case's journal.
struct PluginEdits {
  std::string name, version;  ///< of the plug-in, as a person reads them; one line each
  std::vector<lumen::Edit> edits;
};
/// What the journal says of such a step.
inline constexpr std::string_view plugin_op = "plugin";
/// {"v":1,"op":"plugin","name":...,"version":...,"edits":[...]}.
std::string to_json(const PluginEdits& step);
/// Throws InvalidInput as edit_of_json does, with the edit's number.
PluginEdits plugin_edits_of_json(std::string_view line);
/// "Widen the wall 1.0" of such a line; empty for what is none.
std::string plugin_named_in(std::string_view line);

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
