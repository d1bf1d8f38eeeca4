#include "ostia/session/session.h"

#include "ostia/session/model_changes.h"

#include <optional>
#include <utility>

namespace ostia::session {

Session::Session(CaseFile file) : file_(std::move(file)), live_(file_.model()) {}

Session Session::open(const std::filesystem::path& path, OpenMode mode) {
  return Session(CaseFile::open(path, mode));
}

/// The screen follows before the commit; when the commit fails, it goes back to what is stored.
template <class Command>
std::optional<Session::Done> Session::followed(const Command& command) {
  std::optional<lumen::LumenModel> ahead;
  Done done;
  try {
    std::optional<StepOutcome> outcome = command([&](const lumen::EditOutcome& edit) {
      done.change = live_.follow(edit);
      ahead = edit.model;
    });
    if (!outcome) return std::nullopt;
    done.outcome = std::move(outcome->edit);
    done.edited = outcome->edited;
    done.annotations = std::move(outcome->annotations);
    return done;
  } catch (...) {
    if (ahead) {
      const auto stored = file_.model();
      try {
        live_.follow({*stored, changes_between(*ahead, *stored), {}});
      } catch (const std::exception&) {
        live_ = lumen::LiveModel(stored);
      }
    }
    throw;
  }
}

SolvedWalls Session::solved_walls() const {
  SolvedWalls walls;
  for (const auto& one : file_.model()->vessels) walls[one->vessel] = live_.surface(one->vessel);
  return walls;
}

Session::Done Session::apply(const lumen::Edit& edit) {
  const auto before = file_.annotations();
  return *followed([&](const CaseFile::Check& check) {
    lumen::EditOutcome outcome = file_.apply(edit, check);
    return std::optional(
        StepOutcome{std::move(outcome), true, changes_between(*before, *file_.annotations())});
  });
}

Session::Done Session::apply_merged(const lumen::Edit& edit) {
  return *followed([&](const CaseFile::Check& check) {
    return std::optional(StepOutcome{file_.apply_merged(edit, check), true, {}});
  });
}

Session::Done Session::apply_plugin(const PluginEdits& step) {
  const auto before = file_.annotations();
  return *followed([&](const CaseFile::Check& check) {
    lumen::EditOutcome outcome = file_.apply_plugin(step, check);
    return std::optional(
        StepOutcome{std::move(outcome), !step.edits.empty(), changes_between(*before, *file_.annotations())});
  });
}

Session::Done Session::annotate(const AnnotationCommand& command) {
  const AnnotationChange change = file_.annotate(command);
  return {{*file_.model(), {}, {}}, {}, false, change};
}

Session::Done Session::annotate_merged(const AnnotationCommand& command, std::int64_t drag) {
  const AnnotationChange change = file_.annotate_merged(command, drag);
  return {{*file_.model(), {}, {}}, {}, false, change};
}

std::optional<Session::Done> Session::undo() {
  return followed([&](const CaseFile::Check& check) { return file_.undo(check); });
}

std::optional<Session::Done> Session::redo() {
  return followed([&](const CaseFile::Check& check) { return file_.redo(check); });
}

std::optional<Session::Done> Session::go_to_step(std::int64_t number) {
  return followed([&](const CaseFile::Check& check) { return file_.go_to_step(number, check); });
}

}  // namespace ostia::session
