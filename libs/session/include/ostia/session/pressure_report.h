#pragma once
/// \file Pressures and flows of a tree, computed and written (docs/methods/hemodynamics.md, schema ffr).

#include "ostia/hemodynamics/network_export.h"
#include "ostia/hemodynamics/uncertainty.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/session/case_report.h"
#include "ostia/session/pressure_notes.h"
#include "ostia/session/pressure_tree.h"
#include "ostia/session/pressure_wall.h"

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
  /// Also as if these were opened or narrowed (pressure_what_if.h).
  std::vector<WhatIf> what_ifs;
  std::vector<hemodynamics::NetworkFormat> exports;  ///< written beside: the hyperaemic state
  /// Also how sure it is: trees drawn about this one. Its walls' stations are of this tree, or there are
  /// none.
  std::optional<hemodynamics::UncertaintyOptions> uncertainty;
};

/// A tree with stretches of another calibre, against the same beds.
struct PressureAfter {
  hemodynamics::PreparedNetwork network;
  hemodynamics::FlowState rest, hyperaemia;
  hemodynamics::TreeReadings at_rest, under_hyperaemia;  ///< lesions are those of the tree as it is
};

struct PressureReport {
  PressureTree tree;
  PressureReportOptions options;
  hemodynamics::RestingFlow resting;
  std::optional<hemodynamics::PreparedNetwork> network;  ///< always there once made
  hemodynamics::FlowState rest, hyperaemia;
  hemodynamics::TreeReadings at_rest, under_hyperaemia;
  std::optional<PressureAfter> after;        ///< with the options' stretches; none: there are none
  std::optional<hemodynamics::Pulse> pulse;  ///< at rest; a place a lesion, where it is read
  /// Made by make_pressure_report, where it is asked for, and with_uncertainty.
  std::optional<hemodynamics::PressureUncertainty> uncertainty;
  std::optional<PressureWall> wall;  ///< of a case, where it was asked for (pressure_wall)
  std::vector<std::string> warnings;
};

/// Throws InvalidInput for conditions or options, NumericalError, Cancelled.
PressureReport make_pressure_report(PressureTree tree, const PressureReportOptions& options,
                                    const core::TaskContext& task = core::no_task());

/// The same report of the tree with other options: nothing is measured anew. Without the pulse. Throws as
/// make_pressure_report does.
PressureReport with_options(const PressureReport& report, const PressureReportOptions& options);

/// The same report with how sure it is. Throws as pressure_uncertainty does.
PressureReport with_uncertainty(const PressureReport& report, const hemodynamics::UncertaintyOptions& options,
                                const core::TaskContext& task = core::no_task());

/// A part of a vessel whose wall has moved.
struct MovedWall {
  std::int32_t vessel = 0;
  double from_mm = 0.0, to_mm = 0.0;
};
/// The report after an edit that moved walls alone: sections are measured, branches prepared, and pressures
/// solved from the former ones, where the edit changed something (update_pressure_tree). Without the pulse.
/// Vessels that own no part of the tree do not matter. Throws as update_pressure_tree and
/// make_pressure_report do.
PressureReport after_walls_moved(const PressureReport& report, const lumen::LumenModel& model,
                                 const analysis::SurfaceOfVessel& surface_of,
                                 const std::vector<MovedWall>& moved,
                                 const PressureTreeOptions& options = {});

/// How sure a report's pressures are, beside the report (a window asks for it from a thread of work). Throws
/// as hemodynamics::pressure_uncertainty does.
hemodynamics::PressureUncertainty uncertainty_of(const PressureReport& report,
                                                 const hemodynamics::UncertaintyOptions& options,
                                                 const core::TaskContext& task = core::no_task());

/// docs/schemas/ffr.schema.json.
std::string pressure_json(const PressureReport& report);

/// Of the pages that a person reads (pressure_document.h).
struct PressureDocumentOptions {
  ReportLanguage language = ReportLanguage::english;
  std::string date;  ///< as it is to stand there; empty: none
  std::optional<ImageReference> image;
};

/// ffr.json, conditions.json, pressure.html, pressure.pdf, lines.vtp (a line a branch, with FFR, pressures,
/// flow, area, wall shear, Reynolds' number), stations.csv, lesions.csv, outlets.csv and manifest.json into a
/// folder that appears whole or not at all. Throws IoError, ResourceError, Cancelled.
void write_pressure_report(const std::filesystem::path& folder, const PressureReport& report,
                           const pipeline::JobKey& key, double seconds,
                           const PressureDocumentOptions& pages = {});

}  // namespace ostia::session
