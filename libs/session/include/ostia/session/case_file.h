#pragma once
/// \file The case file: one SQLite database with the model, what a person noted beside it, the journal of
/// commands, and their changesets (docs/reference/case-file.md).

#include "ostia/core/error.h"
#include "ostia/lumen/edit.h"
#include "ostia/session/annotation.h"
#include "ostia/session/edit_json.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// The image a case belongs to. No path, name or UID is stored: where the file lies is kept in a table of
/// this machine.
struct ImageReference {
  std::string sha256;     ///< of the file, or of a series' files in order
  std::string pseudonym;  ///< "case-3f2a"
  /// How its axes run where a person said so and not its file (imaging::given_axes), "LPS"; empty: as read.
  std::string axes{};
};

enum class StepKind {
  begin,       ///< "case.begin"
  edit,        ///< of the model: undo and redo go through these
  annotation,  ///< of measurements and marks: and through these, in one order
  travel,      ///< "undo", "redo"
};

/// A line of the journal.
struct JournalEntry {
  std::int64_t number = 0;  ///< 1, 2, ...
  std::string op;           ///< "case.begin", "cpr.stroke", "measure.add", "undo", "redo", ...
  std::string parameters;   ///< JSON
  bool undone = false;
  bool dropped = false;  ///< undone, and another command came after it: it cannot be redone
  StepKind kind = StepKind::edit;
  std::vector<std::string> notes;
  std::int64_t time_s = 0;  ///< when it was done, seconds since 1970 (UTC); 0: an older program has not said
  std::string author{};     ///< who did it, in the words of CaseFile::set_author; empty: not said
};

/// What steps taken back or brought again changed.
struct StepOutcome {
  /// The model after them, and what views draw anew; without changes where none of the steps was an edit.
  lumen::EditOutcome edit;
  bool edited = false;  ///< the model changed
  AnnotationChange annotations;
};

enum class OpenMode {
  read_write,
  read_only,  ///< a snapshot in memory; the file is not changed, and may lie in a read-only folder
};

/// Does `next` continue `last` (a drag or push still going on), so that both are one step? The same vessel
/// and place of departure; a push whose path begins with the former one.
bool mergeable(const lumen::Edit& last, const lumen::Edit& next);

/// Whether file and folder may be written by this user: where not, a case can be opened for reading only.
bool can_be_edited(const std::filesystem::path& path);

/// A change of a case that was opened for reading only.
class CaseIsReadOnly : public IoError {
 public:
  using IoError::IoError;
};

/// An open case. Every command is one transaction: model, journal and changeset together, durable when the
/// call returns. One process writes at a time. Not safe from several threads at once. Whatever a command
/// throws, the case is what it was: InvalidInput (the edit), ResourceError (disk or memory full), IoError
/// (CaseIsReadOnly where it was opened so; the file cannot be written).
class CaseFile {
 public:
  /// Makes a new case from a model (journal entry "case.begin" points to it whole, so that a replay starts
  /// from it). Throws InvalidInput for a model with a fault or axes that are none, IoError where there is a
  /// file already.
  static CaseFile create(const std::filesystem::path& path, const lumen::LumenModel& model,
                         const std::optional<ImageReference>& image = {});
  /// Throws InvalidInput (not a case, truncated, damaged, of a newer version: which, and the way out),
  /// IoError (missing, read-only, locked by another window).
  static CaseFile open(const std::filesystem::path& path, OpenMode mode = OpenMode::read_write);
  ~CaseFile();
  CaseFile(CaseFile&&) noexcept;
  CaseFile& operator=(CaseFile&&) noexcept;

  /// Who does the steps from here on; nobody before, and the system's account is never asked. Kept with each
  /// step in the case, and in no export. Throws InvalidInput for more than 200 bytes or an end of a line.
  void set_author(const std::string& name);

  bool editable() const;  ///< false where it was opened for reading only

  /// Another case with the same content, journal and all. Throws IoError where there is a file already,
  /// ResourceError (disk or memory full).
  void copy_to(const std::filesystem::path& path) const;

  std::shared_ptr<const lumen::LumenModel> model() const;
  std::shared_ptr<const lumen::LumenModel> starting_model() const;  ///< that of "case.begin"
  std::shared_ptr<const Annotations> annotations() const;
  std::optional<ImageReference> image() const;
  /// Throws InvalidInput where the image is not the one that the case was made with, its axes apart: an image
  /// that was read anew is to be given those of `image()`.
  void check_image(const ImageReference& found) const;

  /// Runs between the computing of a change and its commit; what it throws refuses the change.
  using Check = std::function<void(const lumen::EditOutcome&)>;

  /// Applies an edit and commits it. Redo steps are dropped.
  lumen::EditOutcome apply(const lumen::Edit& edit, const Check& check = {});
  /// The same, but an edit that `mergeable` says continues the last one replaces it: the edit is applied to
  /// the model before that one, and both are one step of undo. The changes are those from the present model.
  lumen::EditOutcome apply_merged(const lumen::Edit& edit, const Check& check = {});

  /// Applies a plug-in's edits one after the other and commits them as one step, or none of them:
  /// InvalidInput then names the edit. Without edits there is no step and nothing changes.
  lumen::EditOutcome apply_plugin(const PluginEdits& step, const Check& check = {});

  /// Runs a command on measurements or marks (`annotated` says what is refused) and commits it, a step like
  /// an edit; redo steps are dropped. A new measurement's id is the one in the change. A command that changes
  /// nothing is no step.
  AnnotationChange annotate(const AnnotationCommand& command);
  /// The same within a drag, or while a color or note is chosen: commands of one `drag` number, without any
  /// other command between them, on the same measurement (added or changed) or the same vessel's mark are one
  /// step. The number is not stored; a new one for each press of the mouse button begins another step.
  AnnotationChange annotate_merged(const AnnotationCommand& command, std::int64_t drag);

  /// The inverse changeset of the last step that is not undone, edit or annotation; nothing when there is
  /// none. The check runs only where the model changes.
  std::optional<StepOutcome> undo(const Check& check = {});
  std::optional<StepOutcome> redo(const Check& check = {});
  /// Undoes or redoes until `number` is the last step that is done (1, "case.begin": none is), all at once or
  /// not at all; nothing where that is so already. The journal has a line for each. Throws InvalidInput for a
  /// number that is no step, or of one that was dropped.
  std::optional<StepOutcome> go_to_step(std::int64_t number, const Check& check = {});
  std::optional<JournalEntry> next_undo() const;  ///< what undo would take back; its number is where one is
  std::optional<JournalEntry> next_redo() const;

  std::vector<JournalEntry> journal() const;
  std::vector<lumen::Edit> edits() const;  ///< those not undone, in order, without annotations: what a replay
                                           ///< applies; those of a plug-in's step one by one

  /// Small texts of the interface. A value that is a path is refused: a case holds none.
  void set_setting(const std::string& key, const std::string& value);
  /// All of them or none.
  void set_settings(const std::map<std::string, std::string>& values);
  std::optional<std::string> setting(const std::string& key) const;

 private:
  struct Impl;
  explicit CaseFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::session
