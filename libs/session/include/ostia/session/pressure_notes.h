#pragma once
/// \file What a case keeps of its pressures: inputs that a person gave, and stretches that are looked at as
/// if they were otherwise. The model's lumen knows nothing of either.

#include "ostia/hemodynamics/conditions.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ostia::session {

enum class WhatIfKind {
  open,    ///< as a stent would: no section is narrower than its reference calibre, less what is left
  narrow,  ///< to a throat in the middle, round, as a cosine
};
std::string to_string(WhatIfKind kind);            ///< "open", "narrow"
WhatIfKind what_if_kind(const std::string& text);  ///< of to_string; throws InvalidInput

/// A stretch of a vessel with another calibre, for the computed pressures alone.
struct WhatIf {
  std::int32_t vessel = 0;
  double from_mm = 0.0, to_mm = 0.0;  ///< abscissas of the vessel from its root
  WhatIfKind kind = WhatIfKind::open;
  /// Diameter stenosis against the reference calibre: what an opened stretch keeps, [0, 90]; what a narrowed
  /// one has at its throat, [1, 99].
  double percent = 0.0;
  bool operator==(const WhatIf&) const = default;
};

struct PressureNotes {
  /// By key of hemodynamics::condition_inputs(): those that a person gave; all others have usual values.
  std::map<std::string, double> inputs;
  std::vector<WhatIf> what_ifs;  ///< one after the other
};

/// Throws InvalidInput for a key that is not known, values beyond physiology or that do not fit each other.
void validate(const std::map<std::string, double>& inputs);
/// Throws InvalidInput for what is no stretch or no percent.
void validate(const WhatIf& what_if);

/// Usual values with what was given in their place.
hemodynamics::Conditions conditions_of(const PressureNotes& notes, hemodynamics::Conditions usual = {});

bool same(const PressureNotes& a, const PressureNotes& b);  ///< to the last bit

}  // namespace ostia::session
