#pragma once
/// \file Pressures and flows of a tree, computed and written (docs/methods/hemodynamics.md, schema ffr).

#include "ostia/pipeline/manifest.h"
#include "ostia/session/pressure_tree.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

struct PressureReportOptions {
  hemodynamics::Conditions conditions;
  hemodynamics::FlowModel model;  ///< blood is the conditions'
  hemodynamics::ReadingOptions reading;
  bool pulse = false;  ///< also over the beat: resting Pd/Pa and iFR
  hemodynamics::PulseOptions pulse_options;
  bool unusual = false;  ///< inputs beyond physiology are taken
};

struct PressureReport {
  PressureTree tree;
  PressureReportOptions options;
  hemodynamics::RestingFlow resting;
  std::optional<hemodynamics::PreparedNetwork> network;  ///< always there once made
  hemodynamics::FlowState rest, hyperaemia;
  hemodynamics::TreeReadings at_rest, under_hyperaemia;
  std::optional<hemodynamics::Pulse> pulse;  ///< at rest; a place a lesion, where it is read
  std::vector<std::string> warnings;
};

/// Throws InvalidInput for conditions or options, NumericalError, Cancelled.
PressureReport make_pressure_report(PressureTree tree, const PressureReportOptions& options,
                                    const core::TaskContext& task = core::no_task());

/// docs/schemas/ffr.schema.json.
std::string pressure_json(const PressureReport& report);

/// ffr.json, conditions.json, lines.vtp (a line a branch, with FFR, pressures, flow, area, wall shear,
/// Reynolds' number), stations.csv, lesions.csv, outlets.csv and manifest.json into a folder that appears
/// whole or not at all. Throws IoError, ResourceError, Cancelled.
void write_pressure_report(const std::filesystem::path& folder, const PressureReport& report,
                           const pipeline::JobKey& key, double seconds);

}  // namespace ostia::session
