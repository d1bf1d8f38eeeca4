#pragma once
/// \file Files of edits, applied with the line named that is refused; cases that are written whole or not at
/// all.

#include "ostia/core/files.h"
#include "ostia/core/task_context.h"
#include "ostia/session/carry.h"
#include "ostia/session/case_file.h"
#include "ostia/session/found_model.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ostia::app {

struct EditScript {
  std::vector<lumen::Edit> edits;
  std::vector<std::string> names;  ///< of each edit in messages: "line 3"
  std::string source;              ///< the file's name, in messages
};
/// "-" is standard input, an empty path an empty script. Throws InvalidInput naming file and line.
EditScript read_edit_script(const std::filesystem::path& path);
/// The edits of a case that are not undone.
EditScript edits_of_case(const session::CaseFile& file, const std::filesystem::path& path);

/// `apply` takes one edit. Returns what the person should know; an edit that is refused is thrown with its
/// file and line.
std::vector<std::string> apply_all(const EditScript& script,
                                   const std::function<lumen::EditOutcome(const lumen::Edit&)>& apply,
                                   const core::TaskContext& task);

/// The model after a script, in memory.
lumen::LumenModel edited(lumen::LumenModel model, const EditScript& script, std::vector<std::string>& notes,
                         const core::TaskContext& task);

/// A case under construction, invisible until `commit`. Throws IoError where a file of that name is there
/// already: a case is nobody's to overwrite.
class NewCase {
 public:
  explicit NewCase(std::filesystem::path path);
  lumen::LumenModel make(const lumen::LumenModel& start, const EditScript& script,
                         const std::optional<session::ImageReference>& image, std::vector<std::string>& notes,
                         const core::TaskContext& task);
  /// A copy of a case, its journal included, with the script's edits after those that it has.
  lumen::LumenModel go_on(const session::CaseFile& from, const EditScript& script,
                          std::vector<std::string>& notes, const core::TaskContext& task);
  /// The same with a plug-in's edits, one step.
  lumen::EditOutcome go_on(const session::CaseFile& from, const session::PluginEdits& step);
  void make(const session::FoundModel& found, const std::optional<session::ImageReference>& image);
  void make(const session::CarriedModel& carried, const std::optional<session::ImageReference>& image);
  void commit() { staged_.commit(); }

 private:
  /// What a call throws of a full disk, with the name that was asked for and not the hidden one.
  template <class Call>
  auto named(const Call& call) const;
  std::filesystem::path target_;
  core::StagedFile staged_;
};

}  // namespace ostia::app
