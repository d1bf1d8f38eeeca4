#include "input/case_image.h"
#include "measure/report.h"
#include "options/validators.h"

#include "ostia/core/background_task.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/private_folder.h"
#include "ostia/session/case_report.h"
#include "ostia/session/doubts.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <optional>
#include <vector>

namespace ostia::app {
namespace {

using Clock = std::chrono::steady_clock;

void print(const std::filesystem::path& folder, bool as_json) {
  const std::string json = core::read_file(folder / "report.json");
  if (as_json)
    std::fputs(json.c_str(), stdout);
  else
    std::printf("report.html, report.pdf, report.json, four tables as CSV and the key images\n");
}

void print(const session::CaseReport& report) {
  std::printf("CAD-RADS %s: %s\n%zu lesions in %zu vessels\n", analysis::to_string(report.statement).c_str(),
              analysis::description(report.category).c_str(), report.stenoses.size(), report.vessels.size());
  if (report.quality) {
    std::printf("image quality: %s\n", session::to_string(report.quality->grade).c_str());
    for (const std::string& reason : report.quality->reasons) std::printf("  %s\n", reason.c_str());
  }
  for (const std::string& one : report.not_judged) std::printf("not judged: %s\n", one.c_str());
}

constexpr std::uint64_t most_text_bytes = 1ULL << 20, most_score_bytes = 64ULL << 20;

/// "agatston" of the object, or of its "total".
double agatston_in(const std::filesystem::path& path) {
  const auto json = nlohmann::json::parse(core::read_file(path, most_score_bytes), nullptr, false);
  if (json.is_object()) {
    const auto& holder = json.contains("agatston") || !json.contains("total") ? json : json["total"];
    if (holder.is_object() && holder.contains("agatston") && holder["agatston"].is_number())
      return holder["agatston"].get<double>();
  }
  throw InvalidInput(path.string() +
                     ": no calcium score; give JSON with a number \"agatston\", by itself or in \"total\"");
}

std::string impression_in(const std::filesystem::path& path) {
  std::string text = core::read_file(path, most_text_bytes);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  if (text.empty())
    throw InvalidInput(path.string() + ": the impression is empty; leave the option out for a draft");
  return text;
}

/// What the options say and the case does not, and the signature, as steps of the case.
std::vector<session::AnnotationCommand> signing_steps(const session::CaseFile& file, const ReportCommand& o,
                                                      const session::ReportOptions& options,
                                                      const std::string& image_sha256) {
  const lumen::LumenModel& model = *file.model();
  session::Annotations after = *file.annotations();
  std::vector<session::AnnotationCommand> steps;
  const auto add = [&](const session::AnnotationCommand& step) {
    after = session::annotated(after, step, model);  // refuses before anything is kept
    steps.push_back(step);
  };
  if (!options.impression.empty() && options.impression != after.report.impression)
    add(session::SetReportImpression{options.impression});
  if (options.agatston && options.agatston != after.report.modifiers.agatston) {
    session::ReportModifiers modifiers = after.report.modifiers;
    modifiers.agatston = options.agatston;
    add(session::SetReportModifiers{modifiers});
  }
  const std::string digest = session::report_content_digest(model, after, image_sha256);
  if (!after.report.versions.empty() && after.report.versions.back().digest == digest)
    throw InvalidInput("nothing has changed since version " + std::to_string(after.report.versions.size()) +
                       " of the report was signed; leave --sign out to make it again");
  add(session::SignReport{{o.date, o.signer, o.changes, digest}});
  return steps;
}

/// Signs a copy, of which the report is made: the case itself is signed when the report stands, so that there
/// is no signature of a report that never came to be. Nobody else writes into the case until then.
class Signing {
 public:
  Signing(const ReportCommand& o, const session::ReportOptions& options, const std::string& image_sha256)
      : file_(session::CaseFile::open(o.input)), steps_(signing_steps(file_, o, options, image_sha256)) {
    file_.copy_to(copy());
    session::CaseFile signed_copy = session::CaseFile::open(copy());
    for (const session::AnnotationCommand& step : steps_) signed_copy.annotate(step);
  }
  session::CaseFile signed_case() const {
    return session::CaseFile::open(copy(), session::OpenMode::read_only);
  }
  void keep() {
    for (const session::AnnotationCommand& step : steps_) file_.annotate(step);
  }

 private:
  std::filesystem::path copy() const { return folder_.path() / "case.ostia"; }
  core::PrivateFolder folder_;
  session::CaseFile file_;
  std::vector<session::AnnotationCommand> steps_;
};

/// A report that says it is signed does not stand without the signature.
void keep_or_remove(Signing& signing, const std::filesystem::path& report) {
  try {
    signing.keep();
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove_all(report, ignored);
    throw;
  }
}

session::ReportOptions options_of_report(const ReportCommand& o) {
  session::ReportOptions options;
  options.date = o.date;
  options.theta_deg = o.theta_deg;
  options.level_hu = o.level_hu;
  options.window_hu = o.window_hu;
  options.language = session::report_language(o.language);
  options.form = session::report_template(o.form);
  if (!o.calcium.empty()) options.agatston = agatston_in(o.calcium);
  if (!o.impression.empty()) options.impression = impression_in(o.impression);
  session::validate(options);
  return options;
}

}  // namespace

ExitCode run_report(const ReportCommand& o, const core::TaskContext& task) {
  const auto start = Clock::now();
  session::ReportOptions options = options_of_report(o);
  pipeline::require_free_folder(o.output);
  std::optional opened(session::CaseFile::open(o.input, session::OpenMode::read_only));
  options.image = opened->image();
  options.certainty = session::kept_certainty(*opened);
  // Walls need no image: they are solved while it is read.
  core::BackgroundTask<analysis::SurfaceOfVessel> solving(
      [model = opened->model()](const core::TaskContext& beside) {
        return session::solved_surfaces(*model, beside);
      });
  pipeline::Source source;
  if (!o.image.empty()) source = case_image(o.image, *opened, task.sub(0.0, 0.15));
  if (source.image && !options.image) options.image = {source.sha256, source.pseudonym};
  options.technique = source.technique;
  std::optional<Signing> signing;
  if (!o.signer.empty()) {
    opened.reset();  // one at a time has a case open for writing
    signing.emplace(o, options, source.image ? options.image->sha256 : std::string());
    opened.emplace(signing->signed_case());
  }
  const session::CaseFile& file = *opened;
  const pipeline::JobKey job = session::report_job(file, source.image != nullptr, options);
  if (const auto code = pipeline::already_done(o.output, job)) {
    core::log_info("done already with the same case and parameters; nothing to do");
    if (signing) signing->keep();  // an earlier run ended between report and signature
    print(o.output, o.json);
    return *code;
  }
  task.set_stage("solving");
  const lumen::LumenModel& model = *file.model();
  const analysis::SurfaceOfVessel surfaces = solving.get(task.sub(0.15, 0.3));
  const session::CaseReport report = session::make_case_report(
      model, surfaces, *file.annotations(), file.journal(), source.image.get(), options, task.sub(0.3, 0.5));
  for (const std::string& warning : report.warnings) core::log_warning(warning);
  const std::vector<session::KeyImage> images =
      session::key_images(report, model, surfaces, source.image.get(), task.sub(0.5, 0.85));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  session::write_case_report(o.output, report, images, job, seconds, task.sub(0.85, 1.0));
  if (signing) keep_or_remove(*signing, o.output);
  task.set_progress(1.0);
  if (!o.json) print(report);
  print(o.output, o.json);
  return ExitCode::ok;
}

void define_report(CLI::App& app, ReportCommand& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* report = app.add_subcommand(
      "report", "A case's report: key images, segments, stenoses with CAD-RADS, measurements, edit log");
  report->footer("Example:\n  ostia report heart.ostia --image heart.nrrd -o report");
  report->fallthrough();
  report->add_option("CASE", c.input, "Case (.ostia)")->required();
  report->add_option("--image", c.image,
                     "The CT that the case was made with: DICOM folder or image; left out: key images show "
                     "the model alone");
  report
      ->add_option("-o,--output", c.output,
                   "Folder that is made: report.html, report.pdf, report.json, tables, images")
      ->required();
  report->add_option("--date", c.date, "Date as it is to stand in the report; left out: none");
  report->add_option("--theta", c.theta_deg,
                     "Angle of the first reformation, degrees; the second is at + 90");
  report->add_option("--level", c.level_hu, "Centre of the grey window, HU");
  report->add_option("--window", c.window_hu, "Width of the grey window, HU")->check(above_zero());
  report
      ->add_option("--language", c.language,
                   "Of report.html, report.pdf and the key images: en or de; the other files are the same")
      ->check(CLI::IsMember({"en", "de"}));
  report
      ->add_option("--template", c.form,
                   "How much report.html and report.pdf hold: full, or short (first page, impression, "
                   "stenoses, segments)")
      ->check(CLI::IsMember({"full", "short"}));
  report->add_option("--calcium", c.calcium,
                     "JSON with an Agatston score (\"agatston\"), for the plaque burden by calcium");
  report->add_option("--impression", c.impression,
                     "Text file: the impression, in place of the case's own or a draft of the findings");
  CLI::Option* signer = report->add_option(
      "--sign", c.signer,
      "Who signs this version of the report; kept in the case, with the impression's text; needs --date "
      "YYYY-MM-DD");
  report->add_option("--change", c.changes, "What changed since the last version that was signed, one line")
      ->needs(signer);
  report->add_flag("--json", c.json, "report.json on standard output");
  report->callback([&] { run = [&](const core::TaskContext& task) { return run_report(c, task); }; });
}

}  // namespace ostia::app
