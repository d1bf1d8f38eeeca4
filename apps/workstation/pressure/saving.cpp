#include "pressure/saving.h"

#include "pressure/live.h"
#include "shell/desk.h"
#include "shell/language.h"
#include "shell/new_folder.h"
#include "shell/open_file.h"

#include "ostia/lumen/lumen_model.h"
#include "ostia/session/pressure_report.h"

#include <QDate>

namespace ostia::workstation {
namespace fs = std::filesystem;

PressureSaving::PressureSaving(Desk& desk, Pressures& pressures)
    : QObject(&desk.window), desk_(desk), pressures_(pressures) {}

void PressureSaving::save(const fs::path& case_file) {
  const std::shared_ptr<const session::PressureReport> report = pressures_.board().now();
  if (!report) return;
  const fs::path folder = free_folder_beside(case_file, "pressure");
  session::PressureDocumentOptions pages;
  pages.language = session::report_language(language_in_use().toStdString());
  pages.date = QDate::currentDate().toString(Qt::ISODate).toStdString();
  pages.image = desk_.bench.session().file().image();
  desk_.jobs.run(
      "pressure_report", tr("Report of the pressures"),
      [report, folder, pages, model = desk_.bench.session().file().model()](const core::TaskContext&) {
        const pipeline::JobKey key{"ffr",
                                   {{"model", lumen::digest(*model)}},
                                   hemodynamics::conditions_json(report->options.conditions)};
        session::write_pressure_report(folder, *report, key, 0.0, pages);
        return std::any(true);
      },
      [this, folder](const std::any&) {
        const QString path = QString::fromStdString(folder.string());
        desk_.jobs.leave("pressure_report", tr("The pressures are in %1").arg(path), path, tr("Open the PDF"),
                         [this, folder] { open_with_desktop(desk_, folder / "pressure.pdf"); });
        emit saved(path);
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The report could not be made"));
      });
}

}  // namespace ostia::workstation
