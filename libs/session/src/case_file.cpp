#include "ostia/session/case_file.h"

#include "case_open.h"
#include "case_schema.h"
#include "journal.h"
#include "model_store.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
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
  Journal(database).append({0, "case.begin", begin_parameters(name), StepState::done, {}, {}});
  transaction.commit();
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
  Journal steps;
  Statement find_image, find_setting, put_setting, find_content;
  std::shared_ptr<const LumenModel> model;
  std::uint64_t checksum = 0;
  std::shared_ptr<const LumenModel> before_last;  // of the last step, if it was made just now
  bool can_redo = false;

  Impl(OpenedCase opened, OpenMode how)
      : mark(std::move(opened.mark)),
        database(std::move(opened.database)),
        mode(how),
        store(database),
        steps(database),
        find_image(database, "SELECT sha256, pseudonym, checksum FROM image"),
        find_setting(database, "SELECT value, checksum FROM setting WHERE key = ?1"),
        put_setting(database,
                    "INSERT INTO setting VALUES(?1, ?2, ?3) ON CONFLICT(key) DO UPDATE SET "
                    "value = excluded.value, checksum = excluded.checksum"),
        find_content(database, "SELECT zlib FROM content WHERE sha256 = ?1") {}

  void load() {
    model = std::make_shared<const LumenModel>(store.read(checksum));
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
    const ImageReference image{find_image.text(0), find_image.text(1)};
    const std::int64_t sum = find_image.integer(2);
    find_image.reset();
    if (sum != sum_of_pair("image", image.sha256, image.pseudonym))
      throw InvalidInput("the case is damaged: its image's reference is not what was written");
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
      throw IoError("the case " + database.shown() +
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
  }

  EditOutcome apply(const Edit& edit, const Check& check) {
    const std::string parameters = to_json(edit);
    EditOutcome outcome = lumen::apply(*model, edit);
    if (check) check(outcome);
    auto before = model;
    commit(outcome.model, [&](const Recording& recording) {
      if (can_redo) steps.drop_undone();
      steps.append(
          {0, lumen::op_name(edit), parameters, StepState::done, outcome.notes, recording.changeset()});
    });
    before_last = std::move(before);
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

  EditOutcome step_back_or_forth(const JournalStep& step, bool back, const Check& check) {
    const std::string changeset = back ? inverse(database, step.changeset) : step.changeset;
    Transaction transaction(database);
    apply_changeset(database, changeset);
    std::uint64_t sum = 0;
    EditOutcome outcome;
    outcome.model = store.read_again(*model, touched_by(database, changeset), sum);
    outcome.changes = changes_between(*model, outcome.model);
    if (check) check(outcome);
    steps.set_state(step, back ? StepState::undone : StepState::done);
    const std::string op = back ? "undo" : "redo";
    steps.append({0, op, step_parameters(op, step.number), StepState::done, {}, {}});
    const bool redo = steps.first_undone().has_value();
    auto next = std::make_shared<const LumenModel>(outcome.model);
    transaction.commit();
    model = std::move(next);
    checksum = sum;
    can_redo = redo;
    before_last.reset();
    return outcome;
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

std::optional<EditOutcome> CaseFile::undo(const Check& check) {
  impl_->require_writable();
  const auto step = impl_->steps.last_done();
  if (!step) return std::nullopt;
  return impl_->step_back_or_forth(*step, true, check);
}

std::optional<EditOutcome> CaseFile::redo(const Check& check) {
  impl_->require_writable();
  const auto step = impl_->steps.first_undone();
  if (!step) return std::nullopt;
  return impl_->step_back_or_forth(*step, false, check);
}

std::vector<JournalEntry> CaseFile::journal() const {
  std::vector<JournalEntry> entries;
  for (JournalStep& step : impl_->steps.all())
    entries.push_back({step.number, std::move(step.op), std::move(step.parameters),
                       step.state != StepState::done, std::move(step.notes)});
  return entries;
}

std::vector<Edit> CaseFile::edits() const {
  std::vector<Edit> edits;
  for (const JournalStep& step : impl_->steps.all())
    if (is_edit(step.op) && step.state == StepState::done) edits.push_back(edit_of_json(step.parameters));
  return edits;
}

void CaseFile::set_setting(const std::string& key, const std::string& value) {
  impl_->require_writable();
  if (is_path(value))
    throw InvalidInput("the setting \"" + key +
                       "\" is a path; a case holds none, so that it can be given away");
  Transaction transaction(impl_->database);
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
