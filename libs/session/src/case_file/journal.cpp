#include "case_file/journal.h"

#include "case_file/case_damage.h"
#include "case_file/model_blob.h"

#include "ostia/core/error.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>

namespace ostia::session {
namespace {

#define OSTIA_JOURNAL_COLUMNS "number, op, parameters, state, notes, changeset, checksum"
#define OSTIA_JOURNAL_HEAD "number, op, parameters, state, notes"
#define OSTIA_JOURNAL_STEPS "op NOT IN ('case.begin', 'undo', 'redo')"

std::string notes_json(const std::vector<std::string>& notes) {
  return nlohmann::json(notes).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::string> notes_of(const std::string& text) {
  try {
    return nlohmann::json::parse(text).get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception&) {
    damaged("the journal has notes that cannot be read");
  }
}

std::int64_t sum_of(const JournalStep& step, const std::string& notes) {
  Checksum sum;
  sum.add("journal").add(step.number).add(step.op).add(step.parameters);
  sum.add(static_cast<std::int64_t>(step.state)).add(notes).add(step.changeset);
  return static_cast<std::int64_t>(sum.value());
}

std::int64_t sum_of_stamp(std::int64_t number, std::int64_t time_s, const std::string& author) {
  Checksum sum;
  sum.add("step_stamp").add(number).add(time_s).add(author);
  return static_cast<std::int64_t>(sum.value());
}

/// The clock or, for what is to be the same each time it is made, what SOURCE_DATE_EPOCH says.
std::int64_t seconds_now() {
  if (const char* fixed = std::getenv("SOURCE_DATE_EPOCH"); fixed && *fixed) {
    char* end = nullptr;
    const long long seconds = std::strtoll(fixed, &end, 10);
    if (*end == 0 && seconds > 0) return seconds;
  }
  using std::chrono::system_clock;
  return std::chrono::duration_cast<std::chrono::seconds>(system_clock::now().time_since_epoch()).count();
}

StepState state_of(std::int64_t state) {
  if (state < 0 || state > 2) damaged("a step of the journal is in an unknown state");
  return static_cast<StepState>(state);
}

JournalEntry read_head(Statement& row) {
  JournalEntry entry;
  entry.number = row.integer(0);
  entry.op = row.text(1);
  entry.kind = kind_of(entry.op);
  entry.parameters = row.text(2);
  const StepState state = state_of(row.integer(3));
  entry.undone = state != StepState::done;
  entry.dropped = state == StepState::dropped;
  entry.notes = notes_of(row.text(4));
  return entry;
}

}  // namespace

StepKind kind_of(const std::string& op) {
  if (op == "case.begin") return StepKind::begin;
  if (op == "undo" || op == "redo") return StepKind::travel;
  return is_annotation_op(op) ? StepKind::annotation : StepKind::edit;
}

Journal::Journal(const Database& db)
    : append_(db, "INSERT INTO journal(" OSTIA_JOURNAL_COLUMNS ") VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7)"),
      replace_(db,
               "UPDATE journal SET op = ?2, parameters = ?3, state = ?4, notes = ?5, changeset = ?6, "
               "checksum = ?7 WHERE number = ?1"),
      set_state_(db, "UPDATE journal SET state = ?2, changeset = ?3, checksum = ?4 WHERE number = ?1"),
      last_done_(db, "SELECT " OSTIA_JOURNAL_COLUMNS " FROM journal WHERE state = 0 AND " OSTIA_JOURNAL_STEPS
                     " ORDER BY number DESC LIMIT 1"),
      first_undone_(db,
                    "SELECT " OSTIA_JOURNAL_COLUMNS " FROM journal WHERE state = 1 ORDER BY number LIMIT 1"),
      next_undo_(db, "SELECT " OSTIA_JOURNAL_HEAD " FROM journal WHERE state = 0 AND " OSTIA_JOURNAL_STEPS
                     " ORDER BY number DESC LIMIT 1"),
      next_redo_(db, "SELECT " OSTIA_JOURNAL_HEAD " FROM journal WHERE state = 1 ORDER BY number LIMIT 1"),
      entries_(db, "SELECT " OSTIA_JOURNAL_HEAD
                   ", coalesce(time_s, 0), coalesce(author, '') "
                   "FROM journal LEFT JOIN step_stamp USING(number) ORDER BY number"),
      step_(db, "SELECT " OSTIA_JOURNAL_COLUMNS " FROM journal WHERE number = ?1"),
      all_(db, "SELECT " OSTIA_JOURNAL_COLUMNS " FROM journal ORDER BY number"),
      last_(db, "SELECT max(number) FROM journal"),
      stamp_(db, "INSERT INTO step_stamp VALUES(?1, ?2, ?3, ?4)"),
      stamps_(db, "SELECT number, time_s, author, checksum FROM step_stamp") {}

JournalStep Journal::read(Statement& row) {
  JournalStep step;
  step.number = row.integer(0);
  step.op = row.text(1);
  step.parameters = row.text(2);
  step.state = state_of(row.integer(3));
  const std::string notes = row.text(4);
  step.changeset = std::string(row.bytes(5));
  if (sum_of(step, notes) != row.integer(6))
    damaged("step " + std::to_string(step.number) + " of the journal is not what was written");
  step.notes = notes_of(notes);
  return step;
}

std::int64_t Journal::append(JournalStep step) {
  last_.with().step();
  step.number = last_.integer(0) + 1;
  last_.reset();
  const std::string notes = notes_json(step.notes);
  append_
      .with(step.number, step.op, step.parameters, static_cast<std::int64_t>(step.state), notes,
            Blob{step.changeset}, sum_of(step, notes))
      .run();
  const std::int64_t now = seconds_now();
  stamp_.with(step.number, now, author_, sum_of_stamp(step.number, now, author_)).run();
  return step.number;
}

void Journal::replace(const JournalStep& step) {
  const std::string notes = notes_json(step.notes);
  replace_
      .with(step.number, step.op, step.parameters, static_cast<std::int64_t>(step.state), notes,
            Blob{step.changeset}, sum_of(step, notes))
      .run();
}

void Journal::set_state(const JournalStep& step, StepState state) {
  JournalStep changed = step;
  changed.state = state;
  if (state == StepState::dropped) changed.changeset.clear();
  set_state_
      .with(step.number, static_cast<std::int64_t>(state), Blob{changed.changeset},
            sum_of(changed, notes_json(changed.notes)))
      .run();
}

void Journal::drop_undone() {
  while (const auto step = first_undone()) set_state(*step, StepState::dropped);
}

namespace {

template <class Read>
auto one(Statement& statement, const Read& read) -> std::optional<decltype(read(statement))> {
  if (!statement.step()) return std::nullopt;
  struct Reset {
    Statement& statement;
    ~Reset() { statement.reset(); }
  } reset{statement};
  return read(statement);
}

}  // namespace

std::optional<JournalStep> Journal::last_done() {
  return one(last_done_.with(), read);
}
std::optional<JournalStep> Journal::first_undone() {
  return one(first_undone_.with(), read);
}

JournalStep Journal::step(std::int64_t number) {
  if (auto found = one(step_.with(number), read)) return *found;
  damaged("the journal has no step " + std::to_string(number));
}

std::optional<JournalEntry> Journal::next_undo() {
  return one(next_undo_.with(), read_head);
}
std::optional<JournalEntry> Journal::next_redo() {
  return one(next_redo_.with(), read_head);
}

std::vector<JournalEntry> Journal::entries() {
  std::vector<JournalEntry> entries;
  Statement& row = entries_.with();
  while (row.step()) {
    entries.push_back(read_head(row));
    entries.back().time_s = row.integer(5);
    entries.back().author = row.text(6);
  }
  return entries;
}

void Journal::verify() {
  Statement& row = all_.with();
  std::int64_t number = 0;
  bool undone = false;
  while (row.step()) {
    const JournalStep step = read(row);
    if (step.number != ++number) damaged("the journal has no step " + std::to_string(number));
    if ((step.op == "case.begin") != (number == 1)) damaged("the journal does not begin where it should");
    const StepKind kind = kind_of(step.op);
    if (kind != StepKind::edit && kind != StepKind::annotation) continue;
    if (undone && step.state == StepState::done) damaged("a step of the journal follows one that was undone");
    undone = undone || step.state == StepState::undone;
  }
  if (number == 0) damaged("the journal is empty");
  for (Statement& stamp = stamps_.with(); stamp.step();)
    if (sum_of_stamp(stamp.integer(0), stamp.integer(1), stamp.text(2)) != stamp.integer(3))
      damaged("the time of step " + std::to_string(stamp.integer(0)) + " is not what was written");
}

}  // namespace ostia::session
