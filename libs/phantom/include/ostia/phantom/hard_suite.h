#pragma once
/// \file The suite `hard`: patients and scans as mixed as those of a clinic, each drawn from its seed
/// (docs/experiments/hard.md).

#include "ostia/phantom/obstacles.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/scan_realism.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::phantom {

/// How a quantity is spread over the cases that have it.
enum class Spread {
  normal,      ///< `middle`: mean; `width`: deviation
  log_normal,  ///< `middle`: median; `width`: deviation of the logarithm
  uniform      ///< from `least` to `most`; middle and width are not asked
};
const char* word(Spread spread);  ///< "normal", "log-normal", "uniform"

/// A row of the suite's table: with the probability `share` a case has the quantity, whose value is drawn and
/// cut to [least, most]; else it has `without`.
struct HardQuantity {
  std::string name, unit;
  double share = 1.0, without = 0.0;
  Spread spread = Spread::uniform;
  double middle = 0.0, width = 0.0, least = 0.0, most = 0.0;
  std::string reason;  ///< what is usual
};

/// Factors of what the suite's difficulty is calibrated by, each in [0, 5].
struct HardStrength {
  double noise = 1.0, blur = 1.0, motion = 1.0, venous = 1.0;
  double contact = 1.0;  ///< of veins and lobes with the arteries
  double calcium = 1.0;  ///< length of long calcified stretches
  double fall = 1.0;     ///< of the contrast along the arteries
  double closed = 1.0;   ///< number of closed stretches
};
void validate(const HardStrength& strength);  ///< throws InvalidInput

/// What was drawn for a case.
struct HardDraw {
  double contrast_hu = 400.0;
  double venous = 0.0;                       ///< CaseVariant::venous
  double noise_hu = 25.0;                    ///< ScanOptions::noise_hu
  double noise_peak_per_mm = 0.2;            ///< ScanOptions::noise_peak_per_mm
  double psf_fwhm_mm = 0.7, slice_mm = 0.8;  ///< in the plane; of a slice, full width at half maximum
  double motion_mm = 0.0, stair_step_mm = 0.0;
  double beam_hardening = 0.0;
  double disease = 1.0, calcium = 1.0, stent_mm = 0.0;
  Anatomy anatomy = Anatomy::usual;
  ScanRealism realism;
  Obstacles obstacles;
};

/// The table, in the order of docs/experiments/hard.md.
std::vector<HardQuantity> hard_quantities();
/// The same values for the same seed and strength. Throws InvalidInput for a strength out of range.
HardDraw draw_hard(std::uint64_t seed, const HardStrength& strength = {});
/// The draw in the table's order.
std::vector<double> values_of(const HardDraw& draw);

/// `usual` with what its seed draws: disease, variant and scan. Preset, patient and what is annotated stay;
/// around a patient's arteries the anatomy is theirs.
CaseOptions hard_case(const CaseOptions& usual, const HardStrength& strength = {});

}  // namespace ostia::phantom
