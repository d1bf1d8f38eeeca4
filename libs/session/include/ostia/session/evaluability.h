#pragma once
/// \file How far a model's vessels can be judged from its image (docs/methods/evaluability.md).

#include "ostia/analysis/evaluability.h"
#include "ostia/analysis/lumen_profile.h"
#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/session/annotation.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ostia::session {

/// One vessel, its own part from where it leaves its parent to its end.
struct VesselEvaluability {
  std::int32_t vessel = 0;
  std::vector<analysis::WallEvidence> evidence;       ///< where it runs by itself
  std::vector<analysis::EvaluableStretch> stretches;  ///< by the program alone; empty without evidence
};

struct VesselEvaluabilityOptions {
  double step_mm = 0.5;  ///< between sections, [0.1, 2]
  analysis::EvaluabilityOptions grades;
};

/// Standard deviation of the noise within 20 mm of the tree, HU (imaging::noise_level_hu); of the whole image
/// where there is too little tissue, and 0 where there is none at all.
double noise_about(const lumen::LumenModel& model, const imaging::ImageVolume& image);

/// `noise_hu` as noise_about gives it. No stretches for a vessel of which less than 2 mm run by themselves.
/// `surface_of` is asked from the calling thread. The same for any number of threads. Throws InvalidInput for
/// bad options or a vessel that is not there, and Cancelled.
VesselEvaluability vessel_evaluability(const lumen::LumenModel& model,
                                       const analysis::SurfaceOfVessel& surface_of, std::int32_t vessel,
                                       const imaging::ImageVolume& image, double noise_hu,
                                       const VesselEvaluabilityOptions& options = {},
                                       const core::TaskContext& task = core::no_task());

/// The program's stretches with the reader's word (null: no mark) on top. Where the program has none, the
/// reader's alone: what lies between on `whole` is not evaluable, since nothing is known of it.
std::vector<analysis::EvaluableStretch> judged_over(const std::vector<analysis::EvaluableStretch>& by_program,
                                                    const VesselMark* mark,
                                                    const analysis::EvaluableStretch& whole);

/// How good a scan is for its arteries, by what is written of such scans (SCCT 2016, Abbara et al.).
enum class ScanGrade { good, fair, poor };
std::string to_string(ScanGrade grade);  ///< "good", "fair", "poor"
struct ScanQuality {
  geometry::Vec3 voxel_mm = geometry::Vec3::Zero();
  double noise_hu = 0.0, lumen_hu = 0.0, contrast_hu = 0.0;  ///< medians over the vessels' sections
  double cnr = 0.0;                                          ///< contrast over noise
  double blur_mm = 0.0;                                      ///< median deviation of the edges' blur
  double evaluable_share = 0.0, limited_share = 0.0, not_evaluable_share = 0.0;  ///< of the vessels' length
  ScanGrade grade = ScanGrade::good;
  std::vector<std::string> reasons;  ///< why it is less than good: "noise of 62 HU; up to 30 is usual"
};
ScanQuality scan_quality(const imaging::Geometry& grid, double noise_hu,
                         const std::vector<VesselEvaluability>& vessels);

/// Which of LAD, LCX and RCA have none of their standard segments, in words: "RCA: not found", "left coronary
/// artery (LM, LAD, LCX): not found", with the vessels without a coronary artery's name that it may be. A
/// vessel that is hardly an artery is none, and is named: `unlikely`, by vessel its probability.
std::vector<std::string> arteries_not_found(const lumen::LumenModel& model,
                                            const std::map<std::int32_t, double>& unlikely = {});

}  // namespace ostia::session
