#include "opening/opening.h"

#include "shell/desk.h"
#include "shell/file_dialogs.h"
#include "views/scene_widget.h"

#include "ostia/core/error.h"
#include "ostia/session/sample_case.h"

#include <QMessageBox>
#include <QPushButton>
#include <chrono>
#include <string>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

using session::ImageReference;

QString shown(const fs::path& path) {
  return QString::fromStdString(path.string());
}

fs::path path_of(const QString& text) {
  return fs::path(text.toStdString());
}

bool same_image(const ImageReference& a, const ImageReference& b) {
  return a.sha256 == b.sha256 && a.axes == b.axes;
}

std::int64_t now_s() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

Opening::Opening(Desk& desk)
    : QObject(&desk.window), desk_(desk), memory_(desk.bench), mark_(desk.state_folder) {}

void Opening::choose_file() {
  const QString chosen = ask_open_file(
      &desk_.window, tr("Open"),
      tr("Cases and images (*.ostia *.nrrd *.mhd *.mha *.nii *.nii.gz *.dcm *.zip);;All files (*)") +
          QStringLiteral(";;") + tr("Vessel trees (*.vtp *.vtk *.swc *.csv *.gxl *.xml *.dat)"));
  if (!chosen.isEmpty()) emit file_chosen(chosen);
}

void Opening::choose_folder() {
  const QString chosen = ask_folder(&desk_.window, tr("Open a folder of DICOM files"));
  if (!chosen.isEmpty()) open(path_of(chosen));
}

void Opening::open(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    desk_.cannot_open(tr("There is no file or folder %1.").arg(shown(path)), tr("This cannot be opened"));
    return;
  }
  const fs::path whole = fs::absolute(path);
  if (path.extension() == ".ostia")
    open_case(whole);
  else
    open_image({whole, {}});
}

void Opening::open_sample() {
  const fs::path folder = desk_.state_folder / "sample";
  desk_.jobs.run(
      "open", tr("Sample case"),
      [folder](const core::TaskContext& task) {
        return std::any(session::sample_case(folder, phantom::Preset::full, task));
      },
      [this](const std::any& result) {
        const auto sample = std::any_cast<session::SampleCase>(result);
        desk_.messages.guarded([&] {
          const auto opened = session::CaseFile::open(sample.case_file, session::OpenMode::read_only);
          if (const auto image = opened.image()) desk_.machine.remember_image(image->sha256, sample.image);
        });
        open_case(sample.case_file);
      },
      [this](const QString& message) { desk_.cannot_open(message, tr("The case cannot be opened")); });
}

void Opening::open_case(const fs::path& path, const QString& then_say) {
  desk_.jobs.cancel("first slice");
  if (desk_.bench.has_case() && path == desk_.case_path) {
    desk_.jobs.cancel("open");  // whoever changes their mind keeps what is there
    return;
  }
  const bool editable = session::can_be_edited(path);
  desk_.jobs.run(
      "open", tr("Opening the case"),
      [path, editable, state = desk_.state_folder,
       shown = desk_.bench.image().reference](const core::TaskContext&) {
        session::CaseFile file = session::CaseFile::open(
            path, editable ? session::OpenMode::read_write : session::OpenMode::read_only);
        OpenedCase opened;
        if (file.model()->vessels.empty() && file.image()) {
          opened.calcium_of = file.image();
          return std::any(opened);
        }
        if (const auto image = file.image(); image && !same_image(*image, shown))
          opened.image = read_beside(session::MachineState(state).find_image(image->sha256));
        opened.session = std::make_shared<session::Session>(std::move(file));
        opened.session->live().wall(
            SceneWidget::screen_cell_mm);  // made here, so that the window need not wait for it
        return std::any(opened);
      },
      [this, path, editable, then_say](const std::any& result) {
        const auto& opened = std::any_cast<const OpenedCase&>(result);
        if (opened.calcium_of) return show_calcium_case(*opened.calcium_of, path);
        show_case(std::move(*opened.session), path, opened.image);
        if (!editable)
          desk_.messages.say(
              tr("This case can be looked at and not changed: its file or folder is read-only. "
                 "Save it as another to edit it."));
        else if (!then_say.isEmpty())
          desk_.messages.say(then_say);
      },
      [this](const QString& message) { desk_.cannot_open(message, tr("The case cannot be opened")); });
}

void Opening::show_case(session::Session session, const fs::path& path, const ImageBeside& image_beside) {
  session::Workbench& bench = desk_.bench;
  const std::optional<ImageReference> image = session.file().image();
  const bool other_image = bench.image().volume && image && !same_image(*image, bench.image().reference);
  const bool shown_now = desk_.messages.guarded(
      [&] {
        keep_view();
        if (other_image) {
          bench.close_case();
          bench.close_image();
        }
        desk_.case_path = path;  // who is told of the session asks for it
        if (const auto author = desk_.machine.setting(author_setting)) session.file().set_author(*author);
        bench.set_session(std::move(session));
        desk_.machine.remember_case(
            {path, image ? image->pseudonym : std::string(), now_s(), image ? image->sha256 : std::string()});
        mark_.set(path);
      },
      true);
  if (!shown_now) return;
  memory_.restore();
  if (image && !bench.image().volume) open_image_of(*image, image_beside);
}

void Opening::show_calcium_case(const ImageReference& image, const fs::path& path) {
  desk_.messages.guarded([&] {
    desk_.machine.remember_case({path, image.pseudonym, now_s(), image.sha256});
  });
  emit calcium_case_chosen(QString::fromStdString(image.sha256), shown(path));
  if (!same_image(image, desk_.bench.image().reference)) {
    close_case();
    desk_.bench.close_image();
    open_image_of(image, {});
  }
}

void Opening::open_image_of(const ImageReference& image, const ImageBeside& beside) {
  const std::optional<session::KnownImage> known = desk_.machine.find_image(image.sha256);
  if (known && beside)
    load_file(known->path, beside);
  else if (known)
    open_image(*known);
  else
    image_missing(image);
}

void Opening::image_missing(const ImageReference& image, const QString& reason) {
  auto* box = new QMessageBox(
      QMessageBox::Question, tr("The image of this case"),
      (reason.isEmpty() ? reason : reason + "\n\n") +
          tr("The image that this case was made on (%1) is not where it was, or has never been opened on "
             "this computer. The case can be looked at without it.")
              .arg(QString::fromStdString(image.pseudonym)),
      QMessageBox::NoButton, &desk_.window);
  box->setAttribute(Qt::WA_DeleteOnClose);
  const QAbstractButton* file = box->addButton(tr("Find the file\u2026"), QMessageBox::AcceptRole);
  const QAbstractButton* folder = box->addButton(tr("Find the DICOM folder\u2026"), QMessageBox::AcceptRole);
  box->addButton(tr("Go on without"), QMessageBox::RejectRole);
  connect(box, &QMessageBox::buttonClicked, this, [this, file, folder](QAbstractButton* button) {
    QString chosen;
    if (button == file) chosen = ask_open_file(&desk_.window, tr("The image of this case"));
    if (button == folder) chosen = ask_folder(&desk_.window, tr("The image of this case"));
    if (!chosen.isEmpty()) open_image({path_of(chosen), {}});
  });
  box->open();
}

void Opening::save_as() {
  if (!desk_.bench.has_case()) return;
  const QString chosen = ask_save_file(&desk_.window, tr("Save the case as"), tr("Cases (*.ostia)"));
  if (chosen.isEmpty()) return;
  fs::path to = path_of(chosen);
  if (to.extension() != ".ostia") to += ".ostia";
  keep_view();
  if (!desk_.messages.guarded([&] { desk_.bench.session().file().copy_to(to); }, true)) return;
  // What was done between the copying and the copy's opening would stay behind in the other file.
  desk_.window.setEnabled(false);
  connect(&desk_.jobs, &Jobs::changed, this, &Opening::go_on, Qt::UniqueConnection);
  open_case(fs::absolute(to));
}

void Opening::go_on() {
  if (!desk_.jobs.running("open")) desk_.window.setEnabled(true);
}

fs::path unused_case_path(const fs::path& state_folder, const std::string& name) {
  const fs::path folder = state_folder / "cases";
  fs::create_directories(folder);
  std::error_code ignored;
  fs::path path;
  for (int number = 1; path.empty() || fs::exists(path, ignored); ++number)
    path = folder / (name + "-" + std::to_string(number) + ".ostia");
  return path;
}

void Opening::start_case(const ImageReference& image,
                         const std::function<session::CaseFile(const fs::path&)>& make) {
  desk_.messages.guarded(
      [&] {
        const fs::path path = unused_case_path(desk_.state_folder, image.pseudonym);
        show_case(session::Session(make(path)), path);
      },
      true);
}

void Opening::close_case() {
  keep_view();
  desk_.bench.close_case();
  desk_.case_path.clear();
  mark_.clear();
}

void Opening::keep_view() {
  emit leaving_case();
  try {
    memory_.keep();
  } catch (const Error& error) {
    // Nobody asked for it: a line, and the message is left to what was asked for.
    desk_.messages.say(QString::fromStdString(error.what()));
  }
}

void Opening::recover() {
  std::vector<fs::path> left = mark_.take_left();
  std::erase_if(left, [](const fs::path& path) {
    std::error_code ignored;
    return !fs::exists(path, ignored);
  });
  if (left.empty()) return;
  const int more = static_cast<int>(left.size()) - 1;
  desk_.messages.say(
      more == 0
          ? tr("The program ended without closing this case; it is opened where it was.")
          : tr("The program ended without closing this case and %n more, which are among the recent ones.",
               nullptr, more));
  open_case(left.front());
}

}  // namespace ostia::workstation
