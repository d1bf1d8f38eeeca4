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
Session::Done Session::followed(const Command& command) {
  std::optional<lumen::LumenModel> ahead;
  Done done;
  try {
    done.outcome = command([&](const lumen::EditOutcome& outcome) {
      done.change = live_.follow(outcome);
      ahead = outcome.model;
    });
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

Session::Done Session::apply(const lumen::Edit& edit) {
  return followed([&](const CaseFile::Check& check) { return file_.apply(edit, check); });
}

Session::Done Session::apply_merged(const lumen::Edit& edit) {
  return followed([&](const CaseFile::Check& check) { return file_.apply_merged(edit, check); });
}

std::optional<Session::Done> Session::undo() {
  bool any = true;
  Done done = followed([&](const CaseFile::Check& check) {
    auto outcome = file_.undo(check);
    any = outcome.has_value();
    return any ? std::move(*outcome) : lumen::EditOutcome{};
  });
  return any ? std::optional(std::move(done)) : std::nullopt;
}

std::optional<Session::Done> Session::redo() {
  bool any = true;
  Done done = followed([&](const CaseFile::Check& check) {
    auto outcome = file_.redo(check);
    any = outcome.has_value();
    return any ? std::move(*outcome) : lumen::EditOutcome{};
  });
  return any ? std::optional(std::move(done)) : std::nullopt;
}

}  // namespace ostia::session
