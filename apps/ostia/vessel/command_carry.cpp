#include "input/case_image.h"
#include "input/edit_script.h"
#include "options/model_options.h"
#include "output/outputs.h"
#include "vessel/carry.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/pipeline/source.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>

namespace ostia::app {
namespace {

void print_carried(const session::CarriedCase& made) {
  for (const session::CarriedVessel& one : made.carried.vessels) {
    std::string notes;
    for (const std::string& note : one.notes) notes += (notes.empty() ? "" : "; ") + note;
    std::printf("%-6s %-9s %7.1f mm (was %.1f)  pulled %.2f mm, at most %.2f  %s\n", one.name.c_str(),
                session::to_string(one.how).c_str(), one.after_mm, one.before_mm, one.shift_mm,
                one.largest_shift_mm, notes.c_str());
  }
  for (const session::CameVessel& one : made.came)
    std::printf("%-6s came: %.1f mm, probability %.0f %%\n", one.name.c_str(), one.length_mm,
                100.0 * one.probability);
  for (const std::string& one : made.carried.not_carried) std::printf("not carried: %s\n", one.c_str());
  std::printf("%.0f %% of the tree followed; the scans lie %s on each other\n",
              100.0 * made.carried.followed_share, registration::name_of(made.registration.quality.verdict));
}

}  // namespace

ExitCode run_carry(const CarryCommand& c, const core::TaskContext& task) {
  require_output(c.output, {".ostia"});
  session::validate(c.options);
  NewCase made(c.output);
  const session::CaseFile before = session::CaseFile::open(c.before, session::OpenMode::read_only);
  const pipeline::Source was = case_image(c.before_image, before, task.sub(0.0, 0.1));
  task.set_stage("reading");
  const pipeline::Source is = pipeline::load_ct(c.after.input, source_options(c.after), task.sub(0.1, 0.2));
  for (const std::string& warning : is.warnings) core::log_warning(warning);
  if (was.sha256 == is.sha256)
    throw InvalidInput(c.after.input.string() +
                       ": it is the image that the case was made with; give the later scan");
  const session::CarriedCase carried = session::carry_case(*before.model(), *before.annotations(), *was.image,
                                                           *is.image, c.options, task.sub(0.2, 0.98));
  for (const std::string& warning : carried.warnings) core::log_warning(warning);
  task.throw_if_cancelled();
  made.make(carried.carried, session::ImageReference{is.sha256, is.pseudonym});
  made.commit();
  task.set_progress(1.0);
  if (c.json)
    std::fputs(session::carried_json(carried).c_str(), stdout);
  else
    print_carried(carried);
  return carried.well() ? ExitCode::ok : ExitCode::quality_failed;
}

void define_carry(CLI::App& app, CarryCommand& c, std::function<ExitCode(const core::TaskContext&)>& run,
                  const std::function<void(CLI::App&, InputOptions&)>& add_dicom) {
  CLI::App* carry = app.add_subcommand(
      "carry", "A checked tree carried onto a later scan of the same patient: a case to be checked");
  carry->footer(
      "Example:\n  ostia carry old.ostia --old-image CT-old/ --new-image CT-new/ -o new.ostia\n"
      "Exit code 4: it was made, and a person should look: a vessel was left out or could not be followed, "
      "or "
      "the scans lie doubtfully on each other.");
  carry->fallthrough();
  carry->add_option("OLD", c.before, "Case of the former scan (.ostia)")->required();
  carry->add_option("--old-image", c.before_image, "The CT that OLD was made with: DICOM folder or image")
      ->required();
  carry->add_option("--new-image", c.after.input, "The later CT, likewise")->required();
  add_dicom(*carry, c.after);
  carry->add_option("-o,--output", c.output, "Case of the later scan, .ostia")->required();
  carry->add_option("--reach", c.options.reach_mm,
                    "mm that the image may pull an axis from where the former one lies, 0.5 to 10");
  carry->add_flag(
      "!--no-search", c.options.search,
      "Do not search the later scan for its own vessels: the images alone say where to begin, and "
      "nothing of what came");
  carry->add_flag("--anyway", c.options.anyway,
                  "Carry it between scans that are hardly of one patient, too (exit code 4)");
  carry->add_flag("--json", c.json, "One JSON object on standard output");
  carry->callback([&] { run = [&](const core::TaskContext& task) { return run_carry(c, task); }; });
}

}  // namespace ostia::app
