#pragma once
/// \file How far a vessel can be judged from its image, stretch by stretch (docs/methods/evaluability.md).

#include "ostia/analysis/wall_evidence.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::analysis {

/// Ascending: what comes later is worse.
enum class Evaluability { evaluable, limited, not_evaluable };
std::string to_string(Evaluability grade);           ///< "evaluable", "limited", "not evaluable"
Evaluability evaluability(const std::string& text);  ///< of to_string; throws InvalidInput

/// Why a stretch is less than evaluable.
enum class EvaluabilityReason { outside_image, coarse_voxels, faint, no_clear_edge, calcium, blurred };
/// "the image ends", "voxels too coarse for its calibre", "hardly brighter than the noise", "no clear edge",
/// "calcium hides the lumen", "the edge is blurred".
std::string to_string(EvaluabilityReason reason);

/// From where on a stretch is limited, and from where on not evaluable. Figures are medians over the window;
/// docs/methods/evaluability.md says what they were chosen by.
struct EvaluabilityOptions {
  double window_mm = 5.0;  ///< of vessel, [1, 20]
  /// Calibre over the coarsest spacing of the voxels; below is coarse.
  double limited_voxels = 2.5, least_voxels = 1.25;
  double limited_cnr = 6.0, least_cnr = 3.0;  ///< contrast over noise
  double limited_clear = 0.7, least_clear = 0.45;
  double limited_calcium = 0.4, most_calcium = 0.8;
  /// Deviation of the edge's blur, mm, and as a share of the calibre.
  double limited_blur_mm = 0.6, limited_blur_share = 0.45, most_blur_share = 0.7;
};
void validate(const EvaluabilityOptions& options);  ///< throws InvalidInput

/// A part of a vessel of one grade.
struct EvaluableStretch {
  double from_mm = 0.0, to_mm = 0.0;
  Evaluability grade = Evaluability::evaluable;
  std::vector<EvaluabilityReason> reasons;  ///< each once, in the order of the enumeration
  bool by_person = false;
};

/// Stretches from `from_mm` to `to_mm`, one after the other without a gap; what lies before and behind the
/// evidence has the grade of its end. `voxel_mm`: the coarsest spacing. A narrow or shut section is judged by
/// the calibre that the vessel has within 10 mm of it, so that a narrowing is no reason by itself. Empty
/// where there is no evidence. Throws InvalidInput for bad options.
std::vector<EvaluableStretch> evaluable_stretches(const std::vector<WallEvidence>& evidence, double from_mm,
                                                  double to_mm, double voxel_mm, double noise_hu,
                                                  const EvaluabilityOptions& options = {});

/// The same stretches with a person's word instead of the program's where there is one; later ones win.
std::vector<EvaluableStretch> overruled(const std::vector<EvaluableStretch>& stretches,
                                        const std::vector<EvaluableStretch>& by_person);

/// The worst within a part, with its reasons; nothing where no stretch reaches into it.
std::optional<EvaluableStretch> worst_within(const std::vector<EvaluableStretch>& stretches, double from_mm,
                                             double to_mm);
/// Share of the stretches' length with a grade, [0, 1]; 0 of nothing.
double share_of(const std::vector<EvaluableStretch>& stretches, Evaluability grade);

}  // namespace ostia::analysis
