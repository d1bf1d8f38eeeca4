#pragma once
/// \file Variants of the synthetic patient.

#include "ostia/phantom/anatomy.h"

#include <optional>

namespace ostia::phantom {

/// What differs from the usual patient (docs/methods/phantom-variants.md). The defaults change nothing.
struct CaseVariant {
  Anatomy anatomy = Anatomy::usual;
  double calcium = 1.0;               ///< as set_calcium has it, [0, 20]
  double stent_mm = 0.0;              ///< length of a stent in the proximal LAD, [0, 40]; 0: none
  std::optional<double> contrast_hu;  ///< of aorta, left heart and arteries, [80, 1000]; none: drawn
  /// Share of the arterial contrast above their own that veins, right heart and pulmonary arteries have, [0,
  /// 1].
  double venous = 0.0;
};

}  // namespace ostia::phantom
