#pragma once
/// \file Lesions of a vessel: narrowings, and plaque that narrows little or nothing
/// (docs/methods/lesions.md).

#include "ostia/analysis/plaque.h"
#include "ostia/analysis/stenosis.h"

#include <optional>
#include <vector>

namespace ostia::analysis {

struct PlaqueStretchOptions {
  /// A section has plaque from this area of it on: what trials call a plaque on CT (Chang et al. 2018).
  /// [0.05, 20] mm^2
  double least_area_mm2 = 1.0;
  double least_length_mm = 2.0;  ///< of a stretch, [0.25, 50]
  double gap_mm = 1.0;           ///< without plaque that does not part a stretch, [0, 10]
  /// Plaque that goes on from a narrowing is a lesion by itself from this length on, [0.25, 50]
  double least_beside_mm = 5.0;
};
void validate(const PlaqueStretchOptions& options);  ///< throws InvalidInput

/// A stretch of a vessel with plaque.
struct PlaqueStretch {
  double from_mm = 0.0, to_mm = 0.0;
};
/// From proximal to distal. Throws InvalidInput for bad options.
std::vector<PlaqueStretch> plaque_stretches(const PlaqueProfile& plaque,
                                            const PlaqueStretchOptions& options = {});

/// A narrowing, or plaque beside the narrowings.
struct Lesion {
  /// Of plaque: at the narrowest place of its stretch, the percents no less than 0; the places of reference
  /// are the stretch's ends.
  Stenosis stenosis;
  bool narrows = true;  ///< found by its narrowing; false: by its plaque alone
  /// Of the lesion's stretch, where the outer wall is known there.
  std::optional<PlaqueVolumes> plaque;

  bool has_plaque() const { return !narrows || (plaque && plaque->plaque_mm3() > 0.0); }
  /// CAD-RADS 2.0 by its percent; plaque without narrowing is 1 (Cury et al. 2022).
  CadRads category() const;
  /// What counts towards the patient's category: plaque has at least 1 %.
  double graded_percent() const;
};

/// All of a vessel, from proximal to distal: what find_stenoses gives, and of the stretches of `plaque`
/// (null: not known) what the narrowings leave, where that is long enough. Only sections that are found say
/// how narrow a plaque's stretch is; where none is, it is left out. Throws InvalidInput as find_stenoses and
/// plaque_stretches do.
std::vector<Lesion> find_lesions(const LumenProfile& profile, const ReferenceLine& reference,
                                 const PlaqueProfile* plaque, const StenosisOptions& narrowings = {},
                                 const PlaqueStretchOptions& plaques = {});

}  // namespace ostia::analysis
