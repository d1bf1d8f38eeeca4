#pragma once
/// \file The journal: every command with the row changes that it made. Rows are added, never taken away.

#include "case_file/database.h"

#include "ostia/session/case_file.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ostia::session {

enum class StepState : std::uint8_t {
  done = 0,
  undone = 1,   ///< can be redone
  dropped = 2,  ///< undone, and another edit came after it
};

struct JournalStep {
  std::int64_t number = 0;
  std::string op, parameters;
  StepState state = StepState::done;
  std::vector<std::string> notes;
  std::string changeset;
};

/// Edit, annotation, or what is no step of undo ("case.begin", "undo", "redo").
StepKind kind_of(const std::string& op);

/// Transactions are the caller's.
class Journal {
 public:
  explicit Journal(const Database& database);

  /// The number given is the next one.
  std::int64_t append(JournalStep step);
  void replace(const JournalStep& step);
  void set_state(const JournalStep& step, StepState state);
  void drop_undone();
  std::optional<JournalStep> last_done();     ///< what undo takes back
  std::optional<JournalStep> first_undone();  ///< what redo brings again
  /// The same without their changesets, and so without the check of their sums; `verify` has seen those.
  std::optional<JournalEntry> next_undo();
  std::optional<JournalEntry> next_redo();
  std::vector<JournalEntry> entries();
  void set_author(std::string author) { author_ = std::move(author); }  ///< of what is appended from now on
  JournalStep step(std::int64_t number);
  /// Throws InvalidInput for a gap or a damaged row.
  void verify();

 private:
  Statement append_, replace_, set_state_, last_done_, first_undone_, next_undo_, next_redo_, entries_, step_,
      all_, last_, stamp_, stamps_;
  std::string author_;
  static JournalStep read(Statement& row);
};

}  // namespace ostia::session
