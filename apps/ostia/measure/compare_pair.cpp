#include "measure/compare_pair.h"

#include "input/case_image.h"
#include "input/input_digest.h"

#include "ostia/core/background_task.h"
#include "ostia/session/comparison_measures.h"

#include <nlohmann/json.hpp>

namespace ostia::app {

std::string comparison_parameters(const session::ComparisonOptions& options, session::MapBy by) {
  nlohmann::json parameters{
      {"anyway", options.anyway}, {"map", session::to_string(by)}, {"spreads", nlohmann::json::array()}};
  for (const auto& scope : options.change.repeatability.spreads)
    for (const analysis::DifferenceSpread& one : scope) parameters["spreads"].push_back({one.sd, one.share});
  return parameters.dump();
}

OpenedPair::OpenedPair(const PairPaths& paths)
    : paths_(paths),
      before_(session::CaseFile::open(paths.before, session::OpenMode::read_only)),
      after_(session::CaseFile::open(paths.after, session::OpenMode::read_only)) {}

pipeline::JobKey OpenedPair::job(const session::ComparisonOptions& options, session::MapBy by) const {
  pipeline::JobKey key{"compare",
                       {{"old", session::report_digest(before_)}, {"new", session::report_digest(after_)}},
                       comparison_parameters(options, by)};
  if (!paths_.before_image.empty()) key.inputs["old image"] = digest_of(paths_.before_image);
  if (!paths_.after_image.empty()) key.inputs["new image"] = digest_of(paths_.after_image);
  return key;
}

OpenedPair::Measured OpenedPair::measured(const session::CaseFile& file, const std::filesystem::path& image,
                                          const core::TaskContext& task) const {
  session::CaseMoment moment = session::moment_of(file);
  // Walls need no image: they are solved while it is read.
  core::BackgroundTask<analysis::SurfaceOfVessel> solving(
      [model = moment.model](const core::TaskContext& beside) {
        return session::solved_surfaces(*model, beside);
      });
  if (!image.empty()) {
    const pipeline::Source source = case_image(image, file, task.sub(0.0, 0.3));
    moment.image = source.image;
    if (source.technique) moment.tube_kv = source.technique->tube_kv;
  }
  task.set_stage("measuring");
  const analysis::SurfaceOfVessel surfaces = solving.get(task.sub(0.3, 0.5));
  return {session::measured_case(moment, surfaces, task.sub(0.5, 1.0)), moment.image};
}

session::Comparison OpenedPair::compared(const session::ComparisonOptions& options, session::MapBy by,
                                         const core::TaskContext& task) const {
  Measured before = measured(before_, paths_.before_image, task.sub(0.0, 0.4));
  Measured after = measured(after_, paths_.after_image, task.sub(0.4, 0.8));
  const session::MapOfImages laid =
      session::map_of_images(before.compared.tree.tree, after.compared.tree.tree, before.image.get(),
                             after.image.get(), by, task.sub(0.8, 0.96));
  task.set_stage("comparing");
  session::Comparison made =
      session::compare_cases(std::move(before.compared), std::move(after.compared), options, laid.map);
  if (!laid.why_not.empty()) made.warnings.push_back(laid.why_not);
  return made;
}

}  // namespace ostia::app
