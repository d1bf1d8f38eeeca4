#pragma once
/// \file Features of high-risk plaque, each with what was measured and where (docs/methods/cad-rads.md).

#include "ostia/analysis/plaque.h"
#include "ostia/analysis/stenosis.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace ostia::analysis {

enum class PlaqueFeature { low_attenuation, positive_remodelling, spotty_calcium, napkin_ring };
inline constexpr std::array plaque_features{PlaqueFeature::low_attenuation,
                                            PlaqueFeature::positive_remodelling,
                                            PlaqueFeature::spotty_calcium, PlaqueFeature::napkin_ring};
/// "low attenuation", "positive remodelling", "spotty calcium", "napkin ring".
std::string to_string(PlaqueFeature feature);
PlaqueFeature plaque_feature(const std::string& text);  ///< of to_string; throws InvalidInput
std::string unit_of(PlaqueFeature feature);             ///< of its value: "mm3", "" (a ratio), "mm", "deg"

/// Ascending.
enum class FeatureConfidence { low, moderate, high };
std::string to_string(FeatureConfidence confidence);  ///< "low", "moderate", "high"

struct HighRiskOptions {
  /// Plaque of low attenuation (PlaqueOptions::low_attenuation_hu) in one piece from here on, [0.05, 50] mm^3
  double least_low_mm3 = 1.0;
  double least_remodelling = 1.1;  ///< outer diameter over that at the places of reference is above, [1, 2]
  double spot_mm = 3.0;            ///< a spot of calcium is smaller in every direction, [0.5, 10]
  double least_spot_mm3 = 0.2;     ///< and no smaller than this, [0.01, 10]
  double ring_deg = 60.0;          ///< of the circumference that a napkin ring takes at least, [10, 360]
  double ring_mm = 1.0;            ///< of the vessel's length, [0.25, 10]
};
void validate(const HighRiskOptions& options);  ///< throws InvalidInput

struct PlaqueFeatureFinding {
  PlaqueFeature feature = PlaqueFeature::low_attenuation;
  bool known = false;    ///< it could be measured
  bool present = false;  ///< `value` is beyond `bound`
  /// Volume of the largest piece of low attenuation; outer diameter at the throat over that at the places of
  /// reference; the largest side of the largest spot, else of the smallest piece of calcium (0: none); the
  /// largest arc of a napkin ring.
  double value = 0.0;
  double bound = 0.0;                               ///< of the options
  std::optional<double> s_mm = {}, theta_deg = {};  ///< where
  /// By how far the value is from the bound; a napkin ring is moderate at most.
  FeatureConfidence confidence = FeatureConfidence::low;
};

/// All four of a lesion, in the order of `plaque_features`. `maps`: of the profile's slabs, none or all.
/// Without maps, or where the lesion is not within the profile, what needs them is not known. Throws
/// InvalidInput for bad options or maps of another profile.
std::vector<PlaqueFeatureFinding> plaque_features_of(const PlaqueProfile& plaque,
                                                     const std::vector<PlaqueMap>& maps,
                                                     const Stenosis& lesion,
                                                     const HighRiskOptions& options = {});

/// From how many features on a plaque is of high risk (Cury et al. 2022).
inline constexpr int least_high_risk_features = 2;

}  // namespace ostia::analysis
