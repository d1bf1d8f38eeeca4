#include "ostia/session/case_file.h"

#include "case_file/annotation_rows.h"
#include "case_file/case_open.h"
#include "case_file/case_schema.h"
#include "case_file/journal.h"
#include "case_file/model_store.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/image_axes.h"
#include "ostia/session/annotation_json.h"
#include "ostia/session/edit_json.h"
#include "ostia/session/model_changes.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

using lumen::Edit;
using lumen::EditOutcome;
using lumen::LumenModel;

std::int64_t sum_of_pair(const std::string& kind, const std::string& a, const std::string& b) {
  return static_cast<std::int64_t>(Checksum().add(kind).add(a).add(b).value());
}

void check_reference(const ImageReference& image) {
  const auto hexadecimal = [](unsigned char c) { return std::isdigit(c) || (c >= 'a' && c <= 'f'); };
  if (image.sha256.size() != 64 || !std::all_of(image.sha256.begin(), image.sha256.end(), hexadecimal))
    throw InvalidInput("the image's SHA-256 must be 64 hexadecimal digits");
  if (!image.axes.empty()) imaging::validate_axes(image.axes);
}

bool is_path(const std::string& value) {
  return value.starts_with("/") || value.starts_with("~") || value.starts_with("\\\\") ||
         value.starts_with("file:") || value.find(":\\") == 1 || value.find(":/") == 1;
}

void require_no_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path, ignored)))
    throw IoError("cannot make the case " + path.string() + ": there is a file already; choose another name");
}

std::string begin_parameters(const std::string& content) {
  return R"({"v":1,"op":"case.begin","model":")" + content + "\"}";
}

std::string step_parameters(const std::string& op, std::int64_t number) {
  return R"({"v":1,"op":")" + op + R"(","step":)" + std::to_string(number) + "}";
}

/// The content that "case.begin" points to.
std::string content_of(const JournalStep& begin) {
  constexpr std::string_view before = R"("model":")";
  const std::size_t at = begin.parameters.find(before);
  if (begin.op != "case.begin" || at == std::string::npos)
    throw InvalidInput("the case is damaged: its journal has no beginning");
  return begin.parameters.substr(at + before.size(), 64);
}

void write_case(Database& database, const LumenModel& model, const std::optional<ImageReference>& image) {
  Transaction transaction(database);
  create_schema(database);
  ModelStore(database).write(model);
  const std::string content = packed(model), name = core::sha256(content);
  Statement(database, "INSERT INTO content VALUES(?1, ?2, ?3)")
      .with(name, static_cast<std::int64_t>(content.size()), Blob{content})
      .run();
  if (image)
    Statement(database, "INSERT INTO image VALUES(1, ?1, ?2, ?3)")
        .with(image->sha256, image->pseudonym, sum_of_pair("image", image->sha256, image->pseudonym))
        .run();
  if (image && !image->axes.empty())
    Statement(database, "INSERT INTO image_axes VALUES(1, ?1, ?2)")
        .with(image->axes, sum_of_pair("image_axes", image->sha256, image->axes))
        .run();
  Journal(database).append({0, "case.begin", begin_parameters(name), StepState::done, {}, {}});
  transaction.commit();
}

/// What a drag of annotations is about; nothing for what cannot be dragged.
struct DragTarget {
  std::int64_t drag = 0;
  bool of_vessel = false;
  std::int32_t id = 0;  ///< of the measurement or the vessel
  bool operator==(const DragTarget&) const = default;
};

std::optional<DragTarget> target_of(const AnnotationCommand& command, std::optional<std::int64_t> drag) {
  if (!drag) return std::nullopt;
  if (const auto* add = std::get_if<MeasureAdd>(&command))
    return DragTarget{*drag, false, add->measurement.id};
  if (const auto* change = std::get_if<MeasureChange>(&command))
    return DragTarget{*drag, false, change->measurement.id};
  if (const auto* mark = std::get_if<MarkVessel>(&command)) return DragTarget{*drag, true, mark->mark.vessel};
  return std::nullopt;
}

/// The command of a merged step: what began as a new measurement stays one.
AnnotationCommand as_op(const std::string& op, const AnnotationCommand& command) {
  const auto* change = std::get_if<MeasureChange>(&command);
  if (change && op == op_name(MeasureAdd{})) return MeasureAdd{change->measurement};
  return command;
}

/// A step to be taken back or brought again.
struct Leg {
  JournalStep step;
  bool back = true;
};

std::optional<Leg> leg_of(std::optional<JournalStep> step, bool back) {
  if (!step) return std::nullopt;
  return Leg{std::move(*step), back};
}

}  // namespace

bool mergeable(const Edit& last, const Edit& next) {
  if (last.index() != next.index()) return false;
  const auto same_place = [](const geometry::Vec3& a, const geometry::Vec3& b) { return a == b; };
  if (const auto* a = std::get_if<lumen::WallDrag>(&last)) {
    const auto& b = std::get<lumen::WallDrag>(next);
    return a->vessel == b.vessel && same_place(a->from, b.from) && a->reach_mm == b.reach_mm;
  }
  if (const auto* a = std::get_if<lumen::AxisMove>(&last)) {
    const auto& b = std::get<lumen::AxisMove>(next);
    return a->vessel == b.vessel && same_place(a->from, b.from) && a->reach_mm == b.reach_mm;
  }
  if (const auto* a = std::get_if<lumen::WallPush>(&last)) {
    const auto& b = std::get<lumen::WallPush>(next);
    return a->vessel == b.vessel && a->radius_mm == b.radius_mm && a->path.size() <= b.path.size() &&
           std::equal(a->path.begin(), a->path.end(), b.path.begin(), same_place);
  }
  return false;
}

struct CaseFile::Impl {
  // In this order: the statements go before the database closes, and the mark last.
  std::shared_ptr<OpenFileMark> mark;
  Database database;
  OpenMode mode;
  ModelStore store;
  AnnotationRows notes;
  Journal steps;
  Statement find_image, find_axes, find_setting, put_setting, find_content;
  std::shared_ptr<const LumenModel> model;
  std::uint64_t checksum = 0;
  std::shared_ptr<const LumenModel> before_last;  // of the last step, if it was made just now
  std::shared_ptr<const Annotations> annotations;
  std::optional<DragTarget> last_target;  // of the last step, if it was an annotation in a drag just now
  bool can_redo = false;

  Impl(OpenedCase opened, OpenMode how)
      : mark(std::move(opened.mark)),
        database(std::move(opened.database)),
        mode(how),
        store(database),
        notes(database),
        steps(database),
        find_image(database, "SELECT sha256, pseudonym, checksum FROM image"),
        find_axes(database, "SELECT axes, checksum FROM image_axes"),
        find_setting(database, "SELECT value, checksum FROM setting WHERE key = ?1"),
        put_setting(database,
                    "INSERT INTO setting VALUES(?1, ?2, ?3) ON CONFLICT(key) DO UPDATE SET "
                    "value = excluded.value, checksum = excluded.checksum"),
        find_content(database, "SELECT zlib FROM content WHERE sha256 = ?1") {}

  void load() {
    model = std::make_shared<const LumenModel>(store.read(checksum));
    annotations = std::make_shared<const Annotations>(notes.read());
    steps.verify();
    can_redo = steps.first_undone().has_value();
    image();
    starting_model();
    for (Statement all(database, "SELECT key, value, checksum FROM setting"); all.step();)
      if (sum_of_pair("setting", all.text(0), all.text(1)) != all.integer(2))
        throw InvalidInput("the case is damaged: a setting is not what was written");
  }

  std::optional<ImageReference> image() {
    if (!find_image.with().step()) return std::nullopt;
    ImageReference image{find_image.text(0), find_image.text(1)};
    const std::int64_t sum = find_image.integer(2);
    find_image.reset();
    if (sum != sum_of_pair("image", image.sha256, image.pseudonym))
      throw InvalidInput("the case is damaged: its image's reference is not what was written");
    if (!find_axes.with().step()) return image;
    image.axes = find_axes.text(0);
    const std::int64_t sum_of_axes = find_axes.integer(1);
    find_axes.reset();
    if (sum_of_axes != sum_of_pair("image_axes", image.sha256, image.axes))
      throw InvalidInput("the case is damaged: its image's axes are not what was written");
    imaging::validate_axes(image.axes);
    return image;
  }

  LumenModel starting_model() {
    const std::string name = content_of(steps.step(1));
    if (!find_content.with(name).step())
      throw InvalidInput("the case is damaged: its starting model is missing");
    const std::string content(find_content.bytes(0));
    find_content.reset();
    if (core::sha256(content) != name)
      throw InvalidInput("the case is damaged: its starting model is not what was written");
    return unpacked(content);
  }

  void require_writable() const {
    if (mode == OpenMode::read_only)
      throw CaseIsReadOnly("the case " + database.shown() +
                           " is open for reading only; open it for editing, or edit a copy of it");
  }

  /// The model after the step, in rows, journal and memory; all or nothing.
  void commit(const LumenModel& after, const std::function<void(const Recording&)>& journalled) {
    std::uint64_t sum = checksum;
    auto next = std::make_shared<const LumenModel>(after);
    Transaction transaction(database);
    {
      const Recording recording(database);
      store.write_change(*model, *next, sum);
      journalled(recording);
    }
    transaction.commit();
    model = std::move(next);
    checksum = sum;
    can_redo = false;
    last_target.reset();
  }

  EditOutcome apply(const Edit& edit, const Check& check) {
    const std::string parameters = to_json(edit);
    EditOutcome outcome = lumen::apply(*model, edit);
    if (check) check(outcome);
    auto before = model;
    auto next = std::make_shared<const Annotations>(following(*annotations, edit, *model, outcome.model));
    commit(outcome.model, [&](const Recording& recording) {
      if (!changes_between(*annotations, *next).empty()) notes.write_change(*annotations, *next);
      if (can_redo) steps.drop_undone();
      steps.append(
          {0, lumen::op_name(edit), parameters, StepState::done, outcome.notes, recording.changeset()});
    });
    before_last = std::move(before);
    annotations = std::move(next);
    return outcome;
  }

  /// The edits in a row on a copy in memory; nothing of them is seen before the commit.
  EditOutcome apply_plugin(const PluginEdits& step, const Check& check) {
    EditOutcome outcome{*model, {}, {}};
    if (step.edits.empty()) return outcome;
    const std::string parameters = to_json(step);
    Annotations noted = *annotations;
    for (std::size_t i = 0; i < step.edits.size(); ++i) {
      try {
        EditOutcome next = lumen::apply(outcome.model, step.edits[i]);
        noted = following(noted, step.edits[i], outcome.model, next.model);
        outcome.model = std::move(next.model);
        outcome.notes.insert(outcome.notes.end(), next.notes.begin(), next.notes.end());
      } catch (const InvalidInput& error) {
        throw InvalidInput("edit " + std::to_string(i + 1) + " of " + std::to_string(step.edits.size()) +
                           " (" + lumen::op_name(step.edits[i]) +
                           ") is refused, and none was made: " + error.what());
      }
    }
    outcome.changes = changes_between(*model, outcome.model);
    if (check) check(outcome);
    auto next = std::make_shared<const Annotations>(std::move(noted));
    commit(outcome.model, [&](const Recording& recording) {
      if (!changes_between(*annotations, *next).empty()) notes.write_change(*annotations, *next);
      if (can_redo) steps.drop_undone();
      steps.append(
          {0, std::string(plugin_op), parameters, StepState::done, outcome.notes, recording.changeset()});
    });
    before_last.reset();  // what comes next goes on from none of these edits
    annotations = std::move(next);
    return outcome;
  }

  EditOutcome apply_merged(const Edit& edit, const Check& check) {
    std::optional<JournalStep> last;
    if (before_last) last = steps.last_done();
    if (!last || !mergeable(edit_of_json(last->parameters), edit)) return apply(edit, check);
    last->parameters = to_json(edit);
    EditOutcome outcome = lumen::apply(*before_last, edit);
    outcome.changes = changes_between(*model, outcome.model);
    if (check) check(outcome);
    commit(outcome.model, [&](const Recording& recording) {
      last->changeset = joined(database, last->changeset, recording.changeset());
      last->notes = outcome.notes;
      steps.replace(*last);
    });
    return outcome;
  }

  AnnotationChange annotate(AnnotationCommand command, std::optional<std::int64_t> drag) {
    if (auto* add = std::get_if<MeasureAdd>(&command)) add->measurement.id = annotations->next_measurement_id;
    auto next = std::make_shared<const Annotations>(annotated(*annotations, command, *model));
    AnnotationChange change = changes_between(*annotations, *next);
    if (change.empty()) return change;
    const std::optional<DragTarget> target = target_of(command, drag);
    std::optional<JournalStep> last;
    if (target && target == last_target) last = steps.last_done();
    Transaction transaction(database);
    {
      const Recording recording(database);
      notes.write_change(*annotations, *next);
      if (last) {
        last->parameters = to_json(as_op(last->op, command));
        last->changeset = joined(database, last->changeset, recording.changeset());
        steps.replace(*last);
      } else {
        if (can_redo) steps.drop_undone();
        steps.append({0, op_name(command), to_json(command), StepState::done, {}, recording.changeset()});
      }
    }
    transaction.commit();
    annotations = std::move(next);
    can_redo = false;
    before_last.reset();
    last_target = target;
    return change;
  }

  void go(const Leg& leg, Touched& touched) {
    const std::string changeset = leg.back ? inverse(database, leg.step.changeset) : leg.step.changeset;
    apply_changeset(database, changeset);
    add_touched(database, changeset, touched);
    steps.set_state(leg.step, leg.back ? StepState::undone : StepState::done);
    const std::string op = leg.back ? "undo" : "redo";
    steps.append({0, op, step_parameters(op, leg.step.number), StepState::done, {}, {}});
  }

  /// Goes the legs that `next_leg` gives until it gives none, in one transaction.
  std::optional<StepOutcome> travel(const std::function<std::optional<Leg>()>& next_leg, const Check& check) {
    require_writable();
    Transaction transaction(database);
    Touched touched;
    bool any = false;
    for (auto leg = next_leg(); leg; leg = next_leg(), any = true) go(*leg, touched);
    if (!any) return std::nullopt;
    std::uint64_t sum = checksum;
    StepOutcome outcome;
    outcome.edited = touched.model;
    outcome.edit.model = touched.model ? store.read_again(*model, touched, sum) : *model;
    auto next_annotations = annotations;
    if (touched.annotations) next_annotations = std::make_shared<const Annotations>(notes.read());
    if (touched.annotations) outcome.annotations = changes_between(*annotations, *next_annotations);
    if (touched.model) outcome.edit.changes = changes_between(*model, outcome.edit.model);
    if (touched.model && check) check(outcome.edit);
    const bool redo = steps.first_undone().has_value();
    auto next = touched.model ? std::make_shared<const LumenModel>(outcome.edit.model) : model;
    transaction.commit();
    model = std::move(next);
    annotations = std::move(next_annotations);
    checksum = sum;
    can_redo = redo;
    before_last.reset();
    last_target.reset();
    return outcome;
  }

  std::optional<StepOutcome> one_step(bool back, const Check& check) {
    bool gone = false;
    return travel(
        [&]() -> std::optional<Leg> {
          if (std::exchange(gone, true)) return std::nullopt;
          return leg_of(back ? steps.last_done() : steps.first_undone(), back);
        },
        check);
  }

  /// The steps between, each once: those to take back from the newest on, or those to bring again.
  std::vector<std::int64_t> steps_between(std::int64_t number, bool& back) {
    std::vector<std::int64_t> done_after, undone_before;
    bool known = false;
    for (const JournalEntry& entry : steps.entries()) {
      if (entry.dropped || entry.kind == StepKind::travel) continue;
      known = known || entry.number == number;
      if (!entry.undone && entry.number > number) done_after.insert(done_after.begin(), entry.number);
      if (entry.undone && entry.number <= number) undone_before.push_back(entry.number);
    }
    if (!known)
      throw InvalidInput("there is no step " + std::to_string(number) +
                         " to go to; choose one that is done or can be redone");
    back = undone_before.empty();
    return back ? done_after : undone_before;
  }

  std::optional<StepOutcome> go_to_step(std::int64_t number, const Check& check) {
    bool back = true;
    const std::vector<std::int64_t> between = steps_between(number, back);
    std::size_t next = 0;
    return travel(
        [&]() -> std::optional<Leg> {
          if (next == between.size()) return std::nullopt;
          return Leg{steps.step(between[next++]), back};
        },
        check);
  }
};

CaseFile::CaseFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CaseFile::~CaseFile() = default;
CaseFile::CaseFile(CaseFile&&) noexcept = default;
CaseFile& CaseFile::operator=(CaseFile&&) noexcept = default;

CaseFile CaseFile::create(const fs::path& path, const LumenModel& model,
                          const std::optional<ImageReference>& image) {
  if (const auto fault = lumen::find_fault(model))
    throw InvalidInput("cannot make a case of the model: " + *fault);
  if (image) check_reference(*image);
  require_no_file(path);
  core::StagedFile staged(path);
  try {
    Database database = new_database(staged.temporary(), journal_kind_for(path));
    database.rename(path.string());
    write_case(database, model, image);
  } catch (...) {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-journal"})
      fs::remove(fs::path(staged.temporary().string() + suffix), ignored);
    throw;
  }
  staged.commit();
  return open(path);
}

CaseFile CaseFile::open(const fs::path& path, OpenMode mode) {
  auto impl = std::make_unique<Impl>(open_case(path, mode), mode);
  try {
    impl->load();
  } catch (const InvalidInput& e) {
    throw InvalidInput("cannot open the case " + path.string() + ": " + e.what());
  }
  return CaseFile(std::move(impl));
}

void CaseFile::copy_to(const fs::path& path) const {
  require_no_file(path);
  core::write_file(path, impl_->database.content());
}

std::shared_ptr<const LumenModel> CaseFile::model() const {
  return impl_->model;
}
std::shared_ptr<const LumenModel> CaseFile::starting_model() const {
  return std::make_shared<const LumenModel>(impl_->starting_model());
}
std::shared_ptr<const Annotations> CaseFile::annotations() const {
  return impl_->annotations;
}
std::optional<ImageReference> CaseFile::image() const {
  return impl_->image();
}

void CaseFile::check_image(const ImageReference& found) const {
  const auto own = image();
  if (!own || own->sha256 == found.sha256) return;
  throw InvalidInput("the image is not the one of the case: the case was made with " + own->pseudonym +
                     " (SHA-256 " + own->sha256.substr(0, 12) + "...), this is " +
                     found.sha256.substr(0, 12) + "...; choose the image that the case was made with");
}

EditOutcome CaseFile::apply(const Edit& edit, const Check& check) {
  impl_->require_writable();
  return impl_->apply(edit, check);
}

EditOutcome CaseFile::apply_merged(const Edit& edit, const Check& check) {
  impl_->require_writable();
  return impl_->apply_merged(edit, check);
}

EditOutcome CaseFile::apply_plugin(const PluginEdits& step, const Check& check) {
  impl_->require_writable();
  return impl_->apply_plugin(step, check);
}

AnnotationChange CaseFile::annotate(const AnnotationCommand& command) {
  impl_->require_writable();
  return impl_->annotate(command, std::nullopt);
}

AnnotationChange CaseFile::annotate_merged(const AnnotationCommand& command, std::int64_t drag) {
  impl_->require_writable();
  return impl_->annotate(command, drag);
}

std::optional<StepOutcome> CaseFile::undo(const Check& check) {
  return impl_->one_step(true, check);
}
std::optional<StepOutcome> CaseFile::redo(const Check& check) {
  return impl_->one_step(false, check);
}
std::optional<StepOutcome> CaseFile::go_to_step(std::int64_t number, const Check& check) {
  return impl_->go_to_step(number, check);
}
std::optional<JournalEntry> CaseFile::next_undo() const {
  return impl_->steps.next_undo();
}
std::optional<JournalEntry> CaseFile::next_redo() const {
  return impl_->steps.next_redo();
}

std::vector<JournalEntry> CaseFile::journal() const {
  return impl_->steps.entries();
}

std::vector<Edit> CaseFile::edits() const {
  std::vector<Edit> edits;
  for (const JournalEntry& entry : impl_->steps.entries())
    if (entry.kind == StepKind::edit && !entry.undone) {
      if (entry.op != plugin_op) {
        edits.push_back(edit_of_json(entry.parameters));
        continue;
      }
      const PluginEdits step = plugin_edits_of_json(entry.parameters);
      edits.insert(edits.end(), step.edits.begin(), step.edits.end());
    }
  return edits;
}

void CaseFile::set_author(const std::string& name) {
  constexpr std::size_t most_bytes = 200;
  if (name.size() > most_bytes || name.find_first_of("\r\n") != std::string::npos)
    throw InvalidInput("a name for the list of steps is one line of at most 200 bytes; choose a shorter one");
  impl_->steps.set_author(name);
}

bool CaseFile::editable() const {
  return impl_->mode == OpenMode::read_write;
}

void CaseFile::set_setting(const std::string& key, const std::string& value) {
  set_settings({{key, value}});
}

void CaseFile::set_settings(const std::map<std::string, std::string>& values) {
  impl_->require_writable();
  for (const auto& [key, value] : values)
    if (is_path(value))
      throw InvalidInput("the setting \"" + key +
                         "\" is a path; a case holds none, so that it can be given away");
  Transaction transaction(impl_->database);
  for (const auto& [key, value] : values)
    impl_->put_setting.with(key, value, sum_of_pair("setting", key, value)).run();
  transaction.commit();
}

std::optional<std::string> CaseFile::setting(const std::string& key) const {
  Statement& find = impl_->find_setting;
  if (!find.with(key).step()) return std::nullopt;
  const std::string value = find.text(0);
  find.reset();
  return value;
}

}  // namespace ostia::session
