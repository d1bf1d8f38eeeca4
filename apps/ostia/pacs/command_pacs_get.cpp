#include "output/told.h"
#include "pacs/pacs_server.h"

#include "ostia/core/log.h"
#include "ostia/imaging/dicom.h"

namespace ostia::app {

ExitCode run_pacs_get(const PacsGetCommand& o, const core::TaskContext& task) {
  const std::unique_ptr<pacs::Archive> archive = archive_at(o.at);
  const pacs::Fetched fetched = archive->fetch({o.study, o.series}, o.output, task.sub(0.0, 0.95));
  for (const std::string& warning : fetched.warnings) core::log_warning(warning);
  task.set_stage("looking through");
  const imaging::DicomFolder folder = imaging::scan_dicom(o.output, task.sub(0.95, 1.0));
  bool sound = folder.damaged.empty();
  for (const std::string& damage : folder.damaged) core::log_warning(damage);
  ToldJson series = ToldJson::array();
  for (const imaging::DicomSeries& one : folder.series) {
    for (const std::string& warning : one.warnings) core::log_warning(warning);
    for (const std::string& fault : one.faults) core::log_warning(fault);
    sound = sound && one.faults.empty();
    series.push_back({{"modality", one.modality},
                      {"phase", one.phase},
                      {"slices", one.files.size()},
                      {"readable", one.faults.empty()}});
  }
  task.set_progress(1.0);
  tell("pacs-get",
       {{"images", fetched.files.size()},
        {"announced", fetched.announced},
        {"duplicates", fetched.duplicates},
        {"series", std::move(series)}},
       counted(fetched.files.size(), "image") + ", all that the server lists", o.json);
  return sound ? ExitCode::ok : ExitCode::quality_failed;
}

}  // namespace ostia::app
