#include "ostia/experiments/sensitivity.h"

#include "lumen/sensitivity_measure.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

/// What is asked of one image: options to figures.
template <class Options>
using Measure = std::function<LumenFigures(const Options&, std::size_t lumen)>;

template <class Options>
SettingRun run_setting(const Parameter<Options>& parameter, const Setting& setting,
                       const std::vector<KnownLumen>& lumina, const Measure<Options>& measure) {
  SettingRun run;
  run.setting = setting;
  for (std::size_t c = 0; c < lumina.size(); ++c) {
    Options options;
    try {
      parameter.apply(options, setting.value, lumina[c]);
      run.cases.push_back(measure(options, c));
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& e) {
      run.failure = lumina[c].name + ": " + e.what();
      run.cases.push_back({0.0, 0.0, 0.0, 0.0, -1});
    }
  }
  return run;
}

void judge(ParameterRun& run) {
  const std::vector<LumenFigures>& base = run.settings[run.standard].cases;
  bool failed = !run.settings[run.standard].failure.empty();
  for (const SettingRun& s : run.settings) {
    if (!s.setting.near) continue;
    failed |= !s.failure.empty();
    for (std::size_t c = 0; c < base.size(); ++c)
      if (base[c].volume_mm3 > 0.0)
        run.plateau = std::max(run.plateau, std::abs(s.cases[c].volume_mm3 / base[c].volume_mm3 - 1.0));
  }
  if (run.choice) {
    run.verdict = "choice";
    return;
  }
  run.on_plateau = !failed && run.plateau <= plateau_limit;
  run.verdict =
      failed ? "fails near the default"
             : (run.on_plateau ? "plateau, " : "slope, ") + core::fixed_text(100.0 * run.plateau, 1) + " %";
}

template <class Options>
std::vector<ParameterRun> run_all(const std::vector<Parameter<Options>>& parameters,
                                  const std::vector<KnownLumen>& lumina, const Measure<Options>& measure,
                                  const std::string& only, const core::TaskContext& task) {
  std::vector<ParameterRun> out;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const Parameter<Options>& parameter = parameters[p];
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(p) / static_cast<double>(parameters.size()));
    if (parameter.name.find(only) == std::string::npos) continue;
    task.set_stage(parameter.name);
    ParameterRun run;
    run.name = parameter.name;
    run.meaning = parameter.meaning;
    run.choice = parameter.choice;
    run.standard = parameter.standard;
    for (const Setting& setting : parameter.settings)
      run.settings.push_back(run_setting(parameter, setting, lumina, measure));
    judge(run);
    out.push_back(std::move(run));
  }
  task.set_progress(1.0);
  return out;
}

}  // namespace

SensitivityResult run_sensitivity(const std::vector<KnownLumen>& lumina, const SensitivityOptions& options,
                                  const std::string& only, const core::TaskContext& task) {
  if (lumina.empty()) throw InvalidInput("sensitivity: no lumen is given");
  if (!(options.section_step_mm >= 0.1 && options.section_step_mm <= 5.0))
    throw InvalidInput("sensitivity: section_step_mm must be in [0.1, 5]");
  SensitivityResult result;
  std::vector<TrueSections> truths;
  for (const KnownLumen& lumen : lumina) {
    truths.push_back(true_sections(lumen.truth, options.section_step_mm));
    result.lumina.push_back(lumen.name);
    result.truth.push_back(figures_of(truths.back(), truths.back().sections));
  }
  const Measure<segmentation::SegmentOptions> by_level_set = [&](const segmentation::SegmentOptions& how,
                                                                 std::size_t c) {
    return level_set_figures(lumina[c], truths[c], how);
  };
  const Measure<segmentation::LumenBoundaryOptions> by_rays =
      [&](const segmentation::LumenBoundaryOptions& how, std::size_t c) {
        return boundary_figures(lumina[c], truths[c], how);
      };
  result.level_set = run_all(segment_parameters(), lumina, by_level_set, only, task.sub(0.0, 0.8));
  result.boundary = run_all(boundary_parameters(), lumina, by_rays, only, task.sub(0.8, 1.0));
  return result;
}

}  // namespace ostia::experiments
