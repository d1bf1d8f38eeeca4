#include "edit_script.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/session/edit_json.h"

#include <algorithm>

namespace ostia::app {
namespace {

/// Which line of the file each edit stands in: blank lines are skipped.
std::vector<std::size_t> lines_of_edits(const std::filesystem::path& path) {
  const std::string text = core::read_file(path);
  std::vector<std::size_t> lines;
  std::size_t number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    ++number;
    if (std::string_view(text).substr(from, to - from).find_first_not_of(" \t\r") != std::string::npos)
      lines.push_back(number);
    from = to + 1;
  }
  return lines;
}

std::filesystem::path not_there_yet(std::filesystem::path path) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(path, ignored)))
    throw IoError("cannot make the case " + path.string() +
                  ": there is a file of that name already; choose another name");
  return path;
}

}  // namespace

EditScript read_edit_script(const std::filesystem::path& path) {
  EditScript script;
  if (path.empty()) return script;
  script.source = path.string();
  script.edits = session::read_edits(path);
  for (const std::size_t line : lines_of_edits(path)) script.names.push_back("line " + std::to_string(line));
  script.names.resize(script.edits.size());
  return script;
}

EditScript edits_of_case(const session::CaseFile& file, const std::filesystem::path& path) {
  EditScript script;
  script.source = path.string();
  script.edits = file.edits();
  for (std::size_t i = 0; i < script.edits.size(); ++i)
    script.names.push_back("edit " + std::to_string(i + 1));
  return script;
}

std::vector<std::string> apply_all(const EditScript& script,
                                   const std::function<lumen::EditOutcome(const lumen::Edit&)>& apply,
                                   const core::TaskContext& task) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < script.edits.size(); ++i) {
    task.throw_if_cancelled();
    const std::string where = script.source + ": " + script.names[i] + ": ";
    try {
      for (const std::string& note : apply(script.edits[i]).notes) {
        notes.push_back(script.names[i] + ": " + note);
        core::log_info(notes.back());
      }
    } catch (const InvalidInput& error) {
      throw InvalidInput(where + error.what());
    } catch (const NumericalError& error) {
      throw NumericalError(where + error.what());
    }
    task.set_progress(static_cast<double>(i + 1) / static_cast<double>(script.edits.size()));
  }
  return notes;
}

lumen::LumenModel edited(lumen::LumenModel model, const EditScript& script, std::vector<std::string>& notes,
                         const core::TaskContext& task) {
  notes = apply_all(
      script,
      [&](const lumen::Edit& edit) {
        lumen::EditOutcome outcome = lumen::apply(model, edit);
        model = outcome.model;
        return outcome;
      },
      task);
  return model;
}

NewCase::NewCase(std::filesystem::path path) : staged_(not_there_yet(std::move(path))) {}

lumen::LumenModel NewCase::make(const lumen::LumenModel& start, const EditScript& script,
                                const std::optional<session::ImageReference>& image,
                                std::vector<std::string>& notes, const core::TaskContext& task) {
  session::CaseFile file = session::CaseFile::create(staged_.temporary(), start, image);
  notes = apply_all(
      script, [&](const lumen::Edit& edit) { return file.apply(edit); }, task);
  return *file.model();
}

}  // namespace ostia::app
