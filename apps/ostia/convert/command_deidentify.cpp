#include "convert/deidentify.h"

#include "ostia/core/log.h"
#include "ostia/dicom/deidentify.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>

namespace ostia::app {

ExitCode run_deidentify(const DeidentifyCommand& o, const core::TaskContext& task) {
  core::redact_in_logs(o.input.string(), "images");
  dicom::DeidentifyOptions options;
  options.patient = o.patient;
  const dicom::DeidentifyReport report = dicom::deidentify(o.input, o.output, options, task);
  for (const std::string& warning : report.warnings) core::log_warning(warning);
  task.set_progress(1.0);
  if (o.json)
    std::fputs(dicom::deidentify_json(report).c_str(), stdout);
  else
    std::printf("%zu images, %zu files left out, %zu kinds of attributes changed\n", report.files,
                report.left_out.size(), report.tags.size());
  return ExitCode::ok;
}

void define_deidentify(CLI::App& app, DeidentifyCommand& c,
                       std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* deidentify =
      app.add_subcommand("deidentify", "Copies of DICOM images that do not say whose they are (PS3.15)");
  deidentify->footer("Example:\n  ostia deidentify CT/ -o anonymous");
  deidentify->fallthrough();
  deidentify->add_option("INPUT", c.input, "DICOM folder, looked through to its depth, or file")->required();
  deidentify
      ->add_option("-o,--output", c.output,
                   "Folder that is made: the images, and deidentified.json with what was changed")
      ->required();
  deidentify->add_option("--patient", c.patient, "Name and number that the copies have");
  deidentify->add_flag("--json", c.json, "deidentified.json on standard output");
  deidentify->callback([&] { run = [&](const core::TaskContext& task) { return run_deidentify(c, task); }; });
}

}  // namespace ostia::app
