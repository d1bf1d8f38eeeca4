#include "opening.h"

#include "main_window.h"

#include "ostia/core/error.h"
#include "ostia/session/sample_case.h"

#include <QFileDialog>
#include <QMessageBox>
#include <QPushButton>
#include <chrono>
#include <string>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

using session::ImageReference;

constexpr const char* open_case_key = "open_case";  // set while a case is open: still there after a crash

QString shown(const fs::path& path) {
  return QString::fromStdString(path.string());
}

fs::path path_of(const QString& text) {
  return fs::path(text.toStdString());
}

std::int64_t now_s() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

Opening::Opening(MainWindow& window) : QObject(&window), window_(window) {}

fs::path Opening::state_folder() const {
  return window_.state_folder();
}

void Opening::choose_file() {
  const QString chosen = QFileDialog::getOpenFileName(
      &window_, tr("Open"), {},
      tr("Cases and images (*.ostia *.nrrd *.mhd *.mha *.nii *.nii.gz *.dcm *.zip);;All files (*)"));
  if (!chosen.isEmpty()) open(path_of(chosen));
}

void Opening::choose_folder() {
  const QString chosen = QFileDialog::getExistingDirectory(&window_, tr("Open a folder of DICOM files"));
  if (!chosen.isEmpty()) open(path_of(chosen));
}

void Opening::open(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    window_.complain(tr("There is no file or folder %1.").arg(shown(path)));
    return;
  }
  const fs::path whole = fs::absolute(path);
  if (path.extension() == ".ostia")
    open_case(whole);
  else
    open_image(whole);
}

void Opening::open_sample() {
  const fs::path folder = state_folder() / "sample";
  window_.jobs().run(
      "open", tr("Sample case"),
      [folder](const core::TaskContext& task) {
        return std::any(session::sample_case(folder, phantom::Preset::full, task));
      },
      [this](const std::any& result) {
        const auto sample = std::any_cast<session::SampleCase>(result);
        window_.guarded([&] {
          const auto opened = session::CaseFile::open(sample.case_file, session::OpenMode::read_only);
          if (const auto image = opened.image())
            window_.machine().remember_image(image->sha256, sample.image);
        });
        open_case(sample.case_file);
      },
      [this](const QString& message) { window_.complain(message); });
}

void Opening::open_case(const fs::path& path) {
  if (window_.bench().has_case() && path == case_path_) return;
  window_.jobs().run(
      "open", tr("Opening the case"),
      [path, state = state_folder(),
       shown = window_.bench().image().reference.sha256](const core::TaskContext&) {
        session::CaseFile file = session::CaseFile::open(path);
        OpenedCase opened;
        if (const auto image = file.image(); image && image->sha256 != shown)
          opened.image = read_beside(session::MachineState(state).find_image(image->sha256));
        opened.session = std::make_shared<session::Session>(std::move(file));
        opened.session->live().wall(
            SceneWidget::screen_cell_mm);  // made here, so that the window need not wait for it
        return std::any(opened);
      },
      [this, path](const std::any& result) {
        const auto& opened = std::any_cast<const OpenedCase&>(result);
        show_case(std::move(*opened.session), path, opened.image);
      },
      [this](const QString& message) { window_.complain(message, tr("The case cannot be opened")); });
}

void Opening::show_case(session::Session session, const fs::path& path, const ImageBeside& image_beside) {
  session::Workbench& bench = window_.bench();
  const std::optional<ImageReference> image = session.file().image();
  const bool other_image = bench.image().volume && image && bench.image().reference.sha256 != image->sha256;
  const bool shown_now = window_.guarded(
      [&] {
        remember_view();
        if (other_image) {
          bench.close_case();
          bench.close_image();
        }
        bench.set_session(std::move(session));
        case_path_ = path;
        window_.machine().remember_case({path, image ? image->pseudonym : std::string(), now_s()});
        window_.machine().set_setting(open_case_key, path.string());
      },
      true);
  if (!shown_now) return;
  restore_view();
  if (image && !bench.image().volume) open_image_of(*image, image_beside);
}

void Opening::open_image_of(const ImageReference& image, const ImageBeside& beside) {
  const std::optional<fs::path> known = window_.machine().find_image(image.sha256);
  if (known && beside)
    load_file(*known, beside);
  else if (known)
    open_image(*known);
  else
    image_missing(image);
}

void Opening::image_missing(const ImageReference& image) {
  auto* box = new QMessageBox(
      QMessageBox::Question, tr("The image of this case"),
      tr("The image that this case was made on (%1) is not where it was, or has never been opened on "
         "this computer. The case can be looked at without it.")
          .arg(QString::fromStdString(image.pseudonym)),
      QMessageBox::NoButton, &window_);
  box->setAttribute(Qt::WA_DeleteOnClose);
  const QAbstractButton* file = box->addButton(tr("Find the file\u2026"), QMessageBox::AcceptRole);
  const QAbstractButton* folder = box->addButton(tr("Find the DICOM folder\u2026"), QMessageBox::AcceptRole);
  box->addButton(tr("Go on without"), QMessageBox::RejectRole);
  connect(box, &QMessageBox::buttonClicked, this, [this, file, folder](QAbstractButton* button) {
    QString chosen;
    if (button == file) chosen = QFileDialog::getOpenFileName(&window_, tr("The image of this case"));
    if (button == folder) chosen = QFileDialog::getExistingDirectory(&window_, tr("The image of this case"));
    if (!chosen.isEmpty()) open_image(path_of(chosen));
  });
  box->open();
}

void Opening::save_as() {
  if (!window_.bench().has_case()) return;
  const QString chosen =
      QFileDialog::getSaveFileName(&window_, tr("Save the case as"), {}, tr("Cases (*.ostia)"));
  if (chosen.isEmpty()) return;
  fs::path to = path_of(chosen);
  if (to.extension() != ".ostia") to += ".ostia";
  remember_view();
  if (window_.guarded([&] { window_.bench().session().file().copy_to(to); }, true))
    open_case(fs::absolute(to));
}

void Opening::start_case(const lumen::LumenModel& model) {
  const session::OpenImage& image = window_.bench().image();
  const fs::path folder = state_folder() / "cases";
  window_.guarded(
      [&] {
        fs::create_directories(folder);
        std::error_code ignored;
        fs::path path;
        for (int number = 1; path.empty() || fs::exists(path, ignored); ++number)
          path = folder / (image.reference.pseudonym + "-" + std::to_string(number) + ".ostia");
        session::CaseFile made = session::CaseFile::create(path, model, image.reference);
        show_case(session::Session(std::move(made)), path);
      },
      true);
}

void Opening::close_case() {
  remember_view();
  window_.bench().close_case();
  case_path_.clear();
  window_.guarded([&] { window_.machine().set_setting(open_case_key, ""); });
}

void Opening::recover() {
  const std::optional<std::string> last = window_.machine().setting(open_case_key);
  std::error_code ignored;
  if (!last || last->empty() || !fs::exists(*last, ignored)) return;
  window_.say(tr("The program ended without closing this case; it is opened where it was."));
  open_case(*last);
}

void Opening::remember_view() {
  session::Workbench& bench = window_.bench();
  if (!bench.has_case()) return;
  try {
    session::CaseFile& file = bench.session().file();
    file.set_setting("view.vessel", std::to_string(bench.vessel.get()));
    file.set_setting("view.cursor_mm", QString::number(bench.cursor_mm.get(), 'g', 8).toStdString());
    file.set_setting("view.theta_deg", QString::number(bench.theta_deg.get(), 'g', 8).toStdString());
  } catch (const Error& error) {
    // Nobody asked for it: a line, and the message is left to what was asked for.
    window_.say(QString::fromStdString(error.what()));
  }
}

void Opening::restore_view() {
  session::Workbench& bench = window_.bench();
  const session::CaseFile& file = bench.session().file();
  const auto number = [&](const char* key) -> std::optional<double> {
    const std::optional<std::string> text = file.setting(key);
    if (!text) return std::nullopt;
    bool good = false;
    const double value = QString::fromStdString(*text).toDouble(&good);
    return good ? std::optional(value) : std::nullopt;
  };
  if (const auto vessel = number("view.vessel"); vessel && bench.axis(static_cast<std::int32_t>(*vessel)))
    bench.vessel.set(static_cast<std::int32_t>(*vessel));
  if (const auto cursor = number("view.cursor_mm")) bench.cursor_mm.set(*cursor);
  if (const auto theta = number("view.theta_deg")) bench.theta_deg.set(*theta);
}

}  // namespace ostia::workstation
