#include "measuring/reporting.h"

#include "measuring/report_dialog.h"
#include "measuring/report_notes_dialog.h"
#include "shell/desk.h"
#include "shell/file_dialogs.h"
#include "shell/language.h"
#include "shell/new_folder.h"
#include "shell/open_file.h"
#include "views/picture_widget.h"
#include "views/raster_image.h"

#include "ostia/io/centerline_file.h"
#include "ostia/session/doubts.h"

#include <QDate>
#include <QMessageBox>
#include <QPixmap>
#include <QPointer>
#include <QPushButton>
#include <memory>
#include <optional>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

/// What a report is made of, held while the person goes on.
struct Snapshot {
  std::shared_ptr<const lumen::LumenModel> model;
  std::shared_ptr<const session::Annotations> annotations;
  std::vector<session::JournalEntry> journal;
  std::shared_ptr<const imaging::ImageVolume> image;
  session::ReportOptions options;
  std::vector<session::KeyImage> pinned;
  pipeline::JobKey job;
  imaging::ShownIdentity named;
};

void write(const Snapshot& from, const fs::path& folder, const core::TaskContext& task) {
  task.set_stage("walls");
  const analysis::SurfaceOfVessel surface_of = session::solved_surfaces(*from.model, task.sub(0.0, 0.1));
  task.set_stage("measuring");
  const session::CaseReport report =
      session::make_case_report(*from.model, surface_of, *from.annotations, from.journal, from.image.get(),
                                from.options, task.sub(0.1, 0.3));
  task.set_stage("pictures");
  std::vector<session::KeyImage> images =
      session::key_images(report, *from.model, surface_of, from.image.get(), task.sub(0.3, 0.8));
  images.insert(images.end(), from.pinned.begin(), from.pinned.end());
  pipeline::JobKey job = from.job;
  session::add_further(job, from.pinned);  // not before: it packs them
  session::write_case_report(folder, report, images, job, 0.0, task.sub(0.8, 1.0), from.named);
}

}  // namespace

Reporting::Reporting(Desk& desk) : QObject(&desk.window), desk_(desk) {
  other_case_ = desk.bench.case_changed.observe([this] {
    ++cases_;
    pinned_.clear();
  });
}

void Reporting::make_report(const fs::path& case_file) {
  make_report_in(free_folder_beside(case_file, "report"));
}

void Reporting::ask_and_make(const fs::path& case_file) {
  const std::optional<session::ImageReference> image = desk_.bench.session().file().image();
  const imaging::ShownIdentity whose =
      image ? desk_.identity.of_image(image->sha256) : imaging::ShownIdentity{};
  if (whose.anonymous()) return make_report(case_file);
  auto* dialog = new ReportDialog(whose, &desk_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, [this, dialog, whose, case_file, of_case = cases_] {
    if (of_case != cases_) return;
    make_report_in(free_folder_beside(case_file, "report"),
                   dialog->names_patient() ? whose : imaging::ShownIdentity{});
  });
  dialog->open();
}

session::ReportOptions Reporting::options_now() const {
  session::ReportOptions options;
  options.image = desk_.bench.session().file().image();
  options.certainty = session::kept_certainty(desk_.bench.session().file());
  options.date = QDate::currentDate().toString(Qt::ISODate).toStdString();
  options.theta_deg = desk_.bench.theta_deg.get();
  options.level_hu = desk_.bench.grey.get().level_hu;
  options.window_hu = desk_.bench.grey.get().width_hu;
  options.language = session::report_language(language_in_use().toStdString());
  return options;
}

void Reporting::say_in_report() {
  const session::CaseFile& file = desk_.bench.session().file();
  const auto dialog = QPointer<ReportNotesDialog>(new ReportNotesDialog(desk_));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  desk_.jobs.run(
      "report_findings", tr("Findings of the report"),
      [model = file.model(), notes = file.annotations(), image = desk_.bench.image().volume,
       options = options_now()](const core::TaskContext& task) {
        task.set_stage("walls");
        const analysis::SurfaceOfVessel surface_of = session::solved_surfaces(*model, task.sub(0.0, 0.3));
        task.set_stage("measuring");
        return std::any(std::make_shared<const session::CaseReport>(session::make_case_report(
            *model, surface_of, *notes, {}, image.get(), options, task.sub(0.3, 1.0))));
      },
      [dialog](const std::any& found) {
        if (dialog) dialog->show_findings(std::any_cast<std::shared_ptr<const session::CaseReport>>(found));
      },
      [dialog](const QString& message) {
        if (dialog) dialog->show_failure(message);
      });
  connect(dialog.data(), &QDialog::finished, this, [this] { desk_.jobs.cancel("report_findings"); });
  dialog->open();
}

void Reporting::make_report_in(const fs::path& folder, const imaging::ShownIdentity& named) {
  session::Workbench& bench = desk_.bench;
  const session::CaseFile& file = bench.session().file();
  Snapshot from;
  from.model = file.model();
  from.annotations = file.annotations();
  from.journal = file.journal();
  from.image = bench.image().volume;
  from.options = options_now();
  from.pinned = pinned_;
  for (std::size_t i = 0; i < from.pinned.size(); ++i)
    from.pinned[i].name = "pinned-" + std::to_string(i + 1);
  from.job = session::report_job(file, from.image != nullptr, from.options, {}, !named.anonymous());
  from.named = named;
  desk_.jobs.run(
      "report", tr("Report"),
      [from, folder](const core::TaskContext& task) {
        write(from, folder, task);
        return std::any(true);
      },
      [this, folder, of_case = cases_, used = pinned_.size()](const std::any&) {
        // What was pinned meanwhile waits for the next report.
        if (of_case == cases_)
          pinned_.erase(pinned_.begin(), pinned_.begin() + static_cast<std::ptrdiff_t>(used));
        show_made(folder);
        emit report_made(QString::fromStdString(folder.string()));
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The report could not be made"));
      });
}

void Reporting::show_made(const fs::path& folder) {
  const QString path = QString::fromStdString(folder.string());
  auto* box = new QMessageBox(QMessageBox::Information, tr("Report"), tr("The report is in %1.").arg(path),
                              QMessageBox::Close, &desk_.window);
  box->setObjectName("report_made");
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  for (const auto& [text, name] :
       {std::pair(tr("Open the PDF"), "report.pdf"), {tr("Open the HTML"), "report.html"}}) {
    QPushButton* button = box->addButton(text, QMessageBox::ActionRole);
    button->setObjectName(QStringLiteral("report_made.") + name);
    connect(button, &QPushButton::clicked, this,
            [this, folder, name = std::string(name)] { open_with_desktop(desk_, folder / name); });
  }
  box->open();
}

void Reporting::pin(PictureWidget& view) {
  const QImage shown = view.picture_of_nobody();
  pinned_.push_back({"",
                     tr("Pinned by the reader: %1")
                         .arg(view.toolTip().isEmpty() ? view.accessibleName() : view.toolTip())
                         .toStdString(),
                     figure::picture_of(raster_of(shown), shown.width() / view.devicePixelRatioF())});
  desk_.messages.say(tr("This view will be key image %1 of the next report.").arg(pinned_.size()));
}

void Reporting::add_pages(const std::vector<session::KeyImage>& pages) {
  pinned_.insert(pinned_.end(), pages.begin(), pages.end());
  desk_.messages.say(tr("%n page(s) more in the next report.", nullptr, static_cast<int>(pages.size())));
}

void Reporting::export_centerlines() {
  const QString chosen =
      ask_save_file(&desk_.window, tr("Export the centerlines"), tr("Centerlines (*.vtp)"));
  if (chosen.isEmpty()) return;
  desk_.messages.guarded(
      [&] {
        io::write_centerlines(chosen.toStdString(), desk_.bench.session().file().model()->tree);
        desk_.messages.say(tr("The centerlines are in %1.").arg(chosen));
      },
      true);
}

}  // namespace ostia::workstation
