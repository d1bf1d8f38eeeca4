#pragma once
/// \file A case being edited: what is stored and what is solved for the screen, kept together.

#include "ostia/lumen/live_model.h"
#include "ostia/session/case_file.h"

#include <cstdint>
#include <map>
#include <memory>

namespace ostia::session {

/// The solved walls of a model by vessel, shared with work in other threads.
using SolvedWalls = std::map<std::int32_t, std::shared_ptr<const lumen::ImplicitSurface>>;

/// An open case with its model solved. An edit is computed, solved, and then committed; what cannot be solved
/// (NumericalError, InvalidInput) is refused and leaves case and screen as they were. Annotations need no
/// solving. Not safe from several threads at once.
class Session {
 public:
  /// Solves the model: throws as lumen::solve does.
  explicit Session(CaseFile file);
  static Session open(const std::filesystem::path& path, OpenMode mode = OpenMode::read_write);

  /// What a command did, and with it what a window has to bring up to date.
  struct Done {
    lumen::EditOutcome outcome;  ///< the model now; without changes where `edited` is false
    lumen::LiveChange change;    ///< of the solved walls
    bool edited = false;         ///< the model changed
    AnnotationChange annotations;
  };
  Done apply(const lumen::Edit& edit);
  Done apply_merged(const lumen::Edit& edit);
  Done apply_plugin(const PluginEdits& step);  ///< CaseFile::apply_plugin, solved once for all its edits
  Done annotate(const AnnotationCommand& command);
  Done annotate_merged(const AnnotationCommand& command, std::int64_t drag);
  std::optional<Done> undo();
  std::optional<Done> redo();
  /// CaseFile::go_to_step, solved once for all its steps.
  std::optional<Done> go_to_step(std::int64_t number);

  const CaseFile& file() const { return file_; }
  CaseFile& file() { return file_; }
  const lumen::LiveModel& live() const { return live_; }
  lumen::LiveModel& live() { return live_; }
  SolvedWalls solved_walls() const;  ///< as they are now

 private:
  template <class Command>
  std::optional<Done> followed(const Command& command);
  CaseFile file_;
  lumen::LiveModel live_;
};

}  // namespace ostia::session
