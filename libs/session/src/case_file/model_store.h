#pragma once
/// \file The model in the tables of a case: all of it, what an edit changes, what a changeset changed.

#include "case_file/model_rows.h"

#include <memory>
#include <set>
#include <string>

namespace ostia::session {

/// What rows a changeset touches.
struct Touched {
  bool annotations = false;        ///< any of theirs
  bool model = false;              ///< any of the model's
  bool tree = false;               ///< nodes, segments or vessels
  std::set<std::int32_t> vessels;  ///< whose samples or own rows
};
void add_touched(const Database& database, const std::string& changeset, Touched& touched);

/// Records row changes of model and annotations from its making on.
class Recording {
 public:
  explicit Recording(const Database& database);
  ~Recording() { sqlite3session_delete(session_); }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  std::string changeset() const;

 private:
  const Database* database_;
  sqlite3_session* session_ = nullptr;
};

/// One changeset after another as one.
std::string joined(const Database& database, const std::string& first, const std::string& then);
std::string inverse(const Database& database, const std::string& changeset);
/// Throws InvalidInput where rows are not what the changeset says.
void apply_changeset(const Database& database, const std::string& changeset);

/// Reads and writes; transactions are the caller's.
class ModelStore {
 public:
  explicit ModelStore(const Database& database) : rows_(database) {}

  void write(const lumen::LumenModel& model);
  /// Rows that differ; `checksum` is the stored one of `before` and becomes that of `after`. Throws Error for
  /// a model that could not be opened again.
  void write_change(const lumen::LumenModel& before, const lumen::LumenModel& after, std::uint64_t& checksum);
  /// Throws InvalidInput for a model with a fault or another checksum than its rows'.
  lumen::LumenModel read(std::uint64_t& checksum);
  /// After a changeset: reads what it touched; the rest is shared with `before`.
  lumen::LumenModel read_again(const lumen::LumenModel& before, const Touched& touched,
                               std::uint64_t& checksum);

 private:
  ModelRows rows_;
};

}  // namespace ostia::session
