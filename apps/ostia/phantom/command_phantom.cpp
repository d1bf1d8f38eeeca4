#include "commands.h"
#include "phantom/patient_input.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/phantom/case_folder.h"
#include "ostia/pipeline/manifest.h"

#include <charconv>
#include <chrono>
#include <cstdio>

namespace ostia::app {
namespace {

using Clock = std::chrono::steady_clock;

void set_if(const std::optional<double>& given, double& value) {
  if (given) value = *given;
}

phantom::Preset preset_of(const std::string& name) {
  if (name == "tiny") return phantom::Preset::tiny;
  if (name == "small") return phantom::Preset::small;
  if (name == "full") return phantom::Preset::full;
  throw UsageError("the preset " + name + " is not known; it is tiny, small or full");
}

/// "name=value" each.
void set_realism(const std::vector<std::string>& given, phantom::ScanRealism& realism) {
  for (const std::string& one : given) {
    const std::size_t sign = one.find('=');
    const std::string name = one.substr(0, sign);
    const std::string text = sign == std::string::npos ? "" : one.substr(sign + 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      throw UsageError("--realism " + one + ": a name and a number are needed, as in tail=0.1");
    try {
      phantom::set_value(realism, name, value);
    } catch (const InvalidInput& wrong) {
      throw UsageError("--realism " + one + ": " + wrong.what());
    }
  }
}

phantom::SuiteOptions options_of(const PhantomCommand& command) {
  phantom::SuiteOptions options;
  options.first.seed = command.seed;
  options.first.preset = preset_of(command.preset);
  options.first.disease = command.disease;
  options.first.variant = {phantom::anatomy_of(command.anatomy), command.calcium, command.stent_mm,
                           command.contrast_hu, command.venous};
  phantom::ScanOptions& scan = options.first.scan;
  if (command.scanner == "measured") scan = phantom::measured_scan();
  set_realism(command.realism, scan.realism);
  set_if(command.noise_hu, scan.noise_hu);
  set_if(command.blur_mm, scan.psf_fwhm_mm);
  set_if(command.blur_z_mm, scan.psf_fwhm_z_mm);
  set_if(command.motion_mm, scan.motion_mm);
  set_if(command.stair_step_mm, scan.stair_step_mm);
  set_if(command.beam_hardening, scan.beam_hardening);
  set_if(command.contour_spacing_mm, options.first.contours.spacing_mm);
  // Surfaces of many phases: about a seventh of the triangles.
  constexpr double spacing_of_phases_mm = 0.4;
  if (command.phases > 1) options.first.surface_spacing_mm = spacing_of_phases_mm;
  set_if(command.surface_spacing_mm, options.first.surface_spacing_mm);
  if (command.contour_points > 0) options.first.contours.points = command.contour_points;
  options.hard = command.suite == "hard";
  options.cases = command.cases;
  options.phases = command.phases;
  options.truth_only = command.truth_only;
  options.report = !command.no_report;
  if (!command.formats.empty()) {
    options.mhd = options.nrrd = options.dicom = false;
    for (const std::string& one : command.formats) {
      if (one == "mhd") options.mhd = true;
      if (one == "nrrd") options.nrrd = true;
      if (one == "dicom") options.dicom = true;
    }
  }
  return options;
}

/// How the vessels move, where they do.
void print_motion(const phantom::SuiteRecord& record) {
  bool first = true;
  for (const phantom::CaseRecord& one : record.cases) {
    for (const phantom::VesselMotion& vessel : one.motion) {
      if (first) std::printf("case       vessel  displacement (largest), mm  speed (largest), mm/s\n");
      first = false;
      std::printf("%-10s %-6s  %12.1f (%7.1f)       %12.0f (%7.0f)\n", one.folder.c_str(),
                  vessel.vessel.c_str(), vessel.displacement_mm, vessel.largest_displacement_mm,
                  vessel.speed_mm_per_s, vessel.largest_speed_mm_per_s);
    }
  }
}

void print(const phantom::SuiteRecord& record) {
  std::printf("%zu %s, %d annotated sections: %.1f mm healthy, %.1f mm diseased\n", record.cases.size(),
              record.cases.size() == 1 ? "case" : "cases", record.sections(), record.healthy_mm(),
              record.diseased_mm());
  print_motion(record);
}

void print_suite(const std::filesystem::path& folder) {
  std::fputs(core::read_file(folder / "suite.json").c_str(), stdout);
}

std::vector<std::string> warnings_of(const phantom::SuiteRecord& record) {
  std::vector<std::string> out;
  for (const phantom::CaseRecord& one : record.cases)
    for (const std::string& warning : one.warnings) out.push_back(one.folder + ": " + warning);
  return out;
}

}  // namespace

ExitCode run_phantom(const PhantomCommand& command, const core::TaskContext& task) {
  const auto start = Clock::now();
  if (command.phases < 1 || command.phases > 100) {
    throw UsageError("--phases " + std::to_string(command.phases) +
                     ": 1 (the heart stands still in mid-diastole) to 100 phases of a beat can be made");
  }
  phantom::SuiteOptions options = options_of(command);
  phantom::validate(options);
  pipeline::require_free_folder(command.output);
  const bool of_patient = !command.tree.empty();
  pipeline::JobKey key{"phantom", {}, ""};
  if (of_patient) {
    options.first.patient =
        read_patient(command.tree, command.tree_rim_mm, command.seed, task.sub(0.0, 0.02));
    key.inputs["tree"] = options.first.patient->digest;
  }
  key.parameters = phantom::parameters_json(options);
  if (const auto code = pipeline::already_done(command.output, key)) {
    core::log_info("done already with the same parameters; nothing to do");
    if (command.json) print_suite(command.output);
    return *code;
  }
  const auto finish = [&](const std::filesystem::path& folder, const phantom::SuiteRecord& record) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    pipeline::write_manifest(folder, {key, ExitCode::ok, seconds, warnings_of(record), {}});
  };
  const phantom::SuiteRecord record = phantom::write_suite(command.output, options, finish, task);
  for (const std::string& warning : warnings_of(record)) core::log_warning(warning);
  task.set_progress(1.0);
  if (command.json)
    print_suite(command.output);
  else
    print(record);
  return ExitCode::ok;
}

}  // namespace ostia::app
