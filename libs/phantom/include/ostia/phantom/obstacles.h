#pragma once
/// \file What leads a search for arteries astray in a patient's body, beside noise and blur: the suite `hard`
/// draws it (docs/experiments/hard.md).

namespace ostia::phantom {

/// The defaults change nothing. The truth stays exact: what narrows a lumen is in its profile.
struct Obstacles {
  double calibre = 1.0;         ///< CoronaryOptions::calibre, in [0.5, 1.3]; not of patients' own trees
  double contrast_fall = -1.0;  ///< TissueHu::coronary_drop, in [0, 0.6]; below 0: drawn as usual
  /// How near veins come to arteries, in [0, 1]: 0 leaves 1.6 mm of fat between vein and outer wall, 1 none.
  double vein_closeness = 0.0;
  /// Share of the places, where auricles, atria and pulmonary trunk lie beside an artery, at which a lobe of
  /// them touches it, in [0, 1].
  double lobes = 0.0;
  double groove_fat = 1.0;    ///< thickness of the fat about the arteries over the usual one, in [0.1, 1]
  double calcified_mm = 0.0;  ///< length of long calcified stretches in all, in [0, 300]
  double closed = 0.0;        ///< number of closed stretches (rounded), in [0, 3]
  double filling = 1.0;       ///< Occlusion::filling behind them, in [0.1, 1]

  bool operator==(const Obstacles&) const = default;
};

void validate(const Obstacles& obstacles);  ///< throws InvalidInput, naming what lies outside its range

}  // namespace ostia::phantom
