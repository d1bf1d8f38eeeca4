#include "input/edit_script.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/session/edit_json.h"

#include <iostream>
#include <iterator>
#include <utility>

namespace ostia::app {
namespace {

constexpr std::uint64_t largest_script = 1ULL << 30;

std::filesystem::path not_there_yet(std::filesystem::path path) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(path, ignored)))
    throw IoError("cannot make the case " + path.string() +
                  ": there is a file of that name already; choose another name");
  return path;
}

/// The case is closed when this returns.
lumen::LumenModel with_edits(session::CaseFile file, const EditScript& script,
                             std::vector<std::string>& notes, const core::TaskContext& task) {
  notes = apply_all(
      script, [&](const lumen::Edit& edit) { return file.apply(edit); }, task);
  return *file.model();
}

}  // namespace

EditScript read_edit_script(const std::filesystem::path& path) {
  EditScript script;
  if (path.empty()) return script;
  script.source = path == "-" ? "standard input" : path.string();
  const std::string text = path == "-" ? std::string(std::istreambuf_iterator<char>(std::cin), {})
                                       : core::read_file(path, largest_script);
  for (session::EditLine& line : session::edit_lines(text, script.source)) {
    script.edits.push_back(std::move(line.edit));
    script.names.push_back("line " + std::to_string(line.number));
  }
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

NewCase::NewCase(std::filesystem::path path) : target_(std::move(path)), staged_(not_there_yet(target_)) {}

template <class Call>
auto NewCase::named(const Call& call) const {
  try {
    return call();
  } catch (const ResourceError& error) {
    throw ResourceError("cannot make the case " + target_.string() + "; make room and try again (" +
                        error.what() + ")");
  }
}

lumen::LumenModel NewCase::make(const lumen::LumenModel& start, const EditScript& script,
                                const std::optional<session::ImageReference>& image,
                                std::vector<std::string>& notes, const core::TaskContext& task) {
  return named([&] {
    return with_edits(session::CaseFile::create(staged_.temporary(), start, image), script, notes, task);
  });
}

void NewCase::make(const session::FoundModel& found, const std::optional<session::ImageReference>& image) {
  named([&] { session::create_case(staged_.temporary(), found, image); });
}

void NewCase::make(const session::CarriedModel& carried,
                   const std::optional<session::ImageReference>& image) {
  named([&] { session::create_case(staged_.temporary(), carried, image); });
}

lumen::LumenModel NewCase::go_on(const session::CaseFile& from, const EditScript& script,
                                 std::vector<std::string>& notes, const core::TaskContext& task) {
  return named([&] {
    from.copy_to(staged_.temporary());
    return with_edits(session::CaseFile::open(staged_.temporary()), script, notes, task);
  });
}

lumen::EditOutcome NewCase::go_on(const session::CaseFile& from, const session::PluginEdits& step) {
  return named([&] {
    from.copy_to(staged_.temporary());
    return session::CaseFile::open(staged_.temporary()).apply_plugin(step);
  });
}

}  // namespace ostia::app
