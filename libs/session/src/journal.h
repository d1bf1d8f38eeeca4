#pragma once
/// \file The journal: every command with the row changes that it made. Rows are added, never taken away.

#include "database.h"

#include "ostia/session/case_file.h"

#include <optional>
#include <string>
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

/// Is it a command that changed the model (not "case.begin", "undo", "redo")?
bool is_edit(const std::string& op);

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
  JournalStep step(std::int64_t number);
  std::vector<JournalStep> all();
  /// Throws InvalidInput for a gap or a damaged row.
  void verify();

 private:
  Statement append_, replace_, set_state_, last_done_, first_undone_, step_, all_, last_;
  static JournalStep read(Statement& row);
};

}  // namespace ostia::session
