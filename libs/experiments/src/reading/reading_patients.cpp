#include "motion/heart_field.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/experiments/reading.h"
#include "ostia/lumen/live_model.h"
#include "ostia/phantom/hard_suite.h"
#include "ostia/session/found_model.h"

namespace ostia::experiments {
namespace {

phantom::CasePlan plan_of_reading(std::uint64_t seed, const ReadingPatients& options) {
  phantom::CaseOptions patient;
  patient.seed = seed;
  patient.preset = phantom::Preset::small;
  if (options.hard) {
    patient = phantom::hard_case(patient);
  } else {
    patient.scan.noise_hu = options.noise_hu;
    patient.scan.motion_mm = options.motion_mm;
  }
  return plan_on_heart_field(patient, options.voxel_mm);
}

/// Null, with the reason, where nothing is found.
std::shared_ptr<const lumen::LumenModel> found_tree(const imaging::ImageVolume& image, std::string& refusal,
                                                    const core::TaskContext& task) {
  try {
    auto model = std::make_shared<const lumen::LumenModel>(session::found_model(image, {}, task).model);
    const lumen::LiveModel solved(model);  // a wall with a hole is no start
    return model;
  } catch (const GeometryError& error) {
    refusal = error.what();
  } catch (const InvalidInput& error) {
    refusal = error.what();
  }
  return nullptr;
}

ReadingRun read_automatic(const phantom::CasePlan& plan, const imaging::ImageVolume& image,
                          const ReadingOptions& options, const core::TaskContext& task) {
  std::string refusal;
  const auto start = found_tree(image, refusal, task.sub(0.0, 0.5));
  ReadingRun run = read_tree(plan.tree, image, start, options, task.sub(0.5, 1.0));
  run.automatic = true;
  run.search_refusal = refusal;
  const HandTimes& t = options.times;
  run.actions.insert(run.actions.begin(),
                     {ReadingAct::search, {}, 0, t.think_s + t.home_s + 3.0 * t.key_s, refusal});
  return run;
}

}  // namespace

void validate(const ReadingPatients& options) {
  if (options.patients < 1 || options.patients > 200)
    throw InvalidInput("reading experiment: 1 to 200 patients, not " + std::to_string(options.patients));
  if (!(options.voxel_mm >= 0.35 && options.voxel_mm <= 2.0))
    throw InvalidInput("reading experiment: voxels of 0.35 to 2 mm, not " +
                       core::trimmed_text(options.voxel_mm, 3));
  if (!(options.noise_hu >= 0.0 && options.noise_hu <= 500.0))
    throw InvalidInput("reading experiment: noise of 0 to 500 HU, not " +
                       core::trimmed_text(options.noise_hu, 1));
  if (!(options.motion_mm >= 0.0 && options.motion_mm <= 10.0))
    throw InvalidInput("reading experiment: motion of 0 to 10 mm, not " +
                       core::trimmed_text(options.motion_mm, 2));
  validate(options.reader);
}

std::vector<ReadingRun> read_patients(const ReadingPatients& options, const core::TaskContext& task) {
  validate(options);
  std::vector<ReadingRun> runs;
  const auto count = static_cast<double>(options.patients);
  for (int patient = 0; patient < options.patients; ++patient) {
    const core::TaskContext part = task.sub(patient / count, (patient + 1) / count);
    part.throw_if_cancelled();
    const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(patient);
    const std::string name = "seed " + std::to_string(seed);
    task.set_stage(name + ": scan");
    const phantom::CasePlan plan = plan_of_reading(seed, options);
    const imaging::ImageVolume image = phantom::scan_case(plan, part.sub(0.0, 0.4)).image;
    ReadingOptions reader = options.reader;
    reader.seed = seed;
    task.set_stage(name + ": from the tree that is found");
    runs.push_back(read_automatic(plan, image, reader, part.sub(0.4, 0.7)));
    task.set_stage(name + ": from nothing");
    runs.push_back(read_tree(plan.tree, image, nullptr, reader, part.sub(0.7, 1.0)));
    runs.back().patient = runs[runs.size() - 2].patient = name;
  }
  return runs;
}

}  // namespace ostia::experiments
