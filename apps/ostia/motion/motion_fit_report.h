#pragma once
/// \file What `ostia motion fit` tells of a motion.

#include "evaluate/evaluate.h"

#include "ostia/core/error.h"
#include "ostia/pipeline/motion_fit.h"
#include "ostia/pipeline/motion_images.h"

#include <string>
#include <vector>

namespace ostia::app {

/// report.json; with how each phase was found where it comes from an image.
Json motion_fit_report(const pipeline::MotionFit& fit, const std::vector<pipeline::ImagePhase>& images);
std::string motion_fit_table(const Json& report);  ///< report.csv
/// Gaps are as they are; all else that was bridged, inverted or intersects is for a person to look at.
ExitCode verdict_of(const pipeline::MotionFit& fit);
void print_motion_fit(const Json& report);

}  // namespace ostia::app
