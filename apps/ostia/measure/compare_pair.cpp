#include "measure/compare_pair.h"

#include "input/case_image.h"
#include "input/input_digest.h"

#include "ostia/core/background_task.h"
#include "ostia/session/case_report.h"
#include "ostia/session/vessel_fat.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace ostia::app {

std::string comparison_parameters(const session::ComparisonOptions& options) {
  nlohmann::json parameters{{"anyway", options.anyway}, {"spreads", nlohmann::json::array()}};
  for (const auto& scope : options.change.repeatability.spreads)
    for (const analysis::DifferenceSpread& one : scope) parameters["spreads"].push_back({one.sd, one.share});
  return parameters.dump();
}

OpenedPair::OpenedPair(const PairPaths& paths)
    : paths_(paths),
      before_(session::CaseFile::open(paths.before, session::OpenMode::read_only)),
      after_(session::CaseFile::open(paths.after, session::OpenMode::read_only)) {}

pipeline::JobKey OpenedPair::job(const session::ComparisonOptions& options) const {
  pipeline::JobKey key{"compare",
                       {{"old", session::report_digest(before_)}, {"new", session::report_digest(after_)}},
                       comparison_parameters(options)};
  if (!paths_.before_image.empty()) key.inputs["old image"] = digest_of(paths_.before_image);
  if (!paths_.after_image.empty()) key.inputs["new image"] = digest_of(paths_.after_image);
  return key;
}

session::ComparedCase OpenedPair::measured(const session::CaseFile& file, const std::filesystem::path& image,
                                           const core::TaskContext& task) const {
  session::ReportOptions options;
  options.image = file.image();
  const auto model = file.model();
  // Walls need no image: they are solved while it is read.
  core::BackgroundTask<analysis::SurfaceOfVessel> solving(
      [model](const core::TaskContext& beside) { return session::solved_surfaces(*model, beside); });
  pipeline::Source source;
  if (!image.empty()) source = case_image(image, file, task.sub(0.0, 0.3));
  task.set_stage("measuring");
  const analysis::SurfaceOfVessel surfaces = solving.get(task.sub(0.3, 0.5));
  const session::CaseReport report = session::make_case_report(
      *model, surfaces, *file.annotations(), file.journal(), source.image.get(), options, task.sub(0.5, 0.9));
  std::optional<session::CaseFat> fat;
  if (source.image) {
    session::CaseFatOptions how;
    if (source.technique) how.tube_kv = source.technique->tube_kv;
    fat = session::case_fat(*model, surfaces, *source.image, how, task.sub(0.9, 1.0));
  }
  return session::compared_case(*model, report, fat ? &*fat : nullptr);
}

session::Comparison OpenedPair::compared(const session::ComparisonOptions& options,
                                         const core::TaskContext& task) const {
  session::ComparedCase before = measured(before_, paths_.before_image, task.sub(0.0, 0.48));
  session::ComparedCase after = measured(after_, paths_.after_image, task.sub(0.48, 0.96));
  task.set_stage("comparing");
  return session::compare_cases(std::move(before), std::move(after), options);
}

}  // namespace ostia::app
