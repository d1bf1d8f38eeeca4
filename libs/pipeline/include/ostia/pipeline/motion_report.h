#pragma once
/// \file The measures of a beating tree as a folder. See docs/methods/motion-measures.md.

#include "ostia/analysis/motion_measures.h"
#include "ostia/core/task_context.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// `measures.json` (docs/schemas/motion-measures.schema.json): everything but what is along branches. What
/// was not measured is null.
std::string motion_measures_json(const analysis::TreeMotion& motion);

/// `measures.csv`: branch,percent,time_s,measure,value,unit,at_template; pairs of branches ("LAD | LCX") and
/// angles ("LAD proximal | D1") too. What was not measured is empty.
std::string motion_measures_csv(const analysis::TreeMotion& motion);

/// `along.csv`: branch,percent,s_mm and a column for each local measure with its unit; a branch's points at
/// the template (percent is "template") and at each time.
std::string motion_along_csv(const analysis::TreeMotion& motion);

/// A picture for each measure with all branches over the cycle, one with distances and one with angles; none
/// for what nothing is known of.
std::vector<ReportPicture> motion_pictures(const analysis::TreeMotion& motion);

/// Writes `measures.json`, both tables, `report.html`, `pictures/*.png` and `*.svg`, and `manifest.json` into
/// a folder that appears whole or not at all. Throws IoError, ResourceError, Cancelled.
void write_motion_report(const std::filesystem::path& folder, const analysis::TreeMotion& motion,
                         const JobKey& key, double seconds_before,
                         const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
