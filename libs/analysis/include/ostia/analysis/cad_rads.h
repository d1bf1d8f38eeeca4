#pragma once
/// \file CAD-RADS 2.0 as it is written: category, plaque burden and modifiers (Cury et al. 2022;
/// docs/methods/cad-rads.md). Categories by themselves are in stenosis.h.

#include "ostia/analysis/plaque_burden.h"
#include "ostia/analysis/stenosis.h"

#include <string>

namespace ostia::analysis {

/// What a test for ischaemia said (FFR from CT, stress perfusion on CT).
enum class Ischaemia { not_tested, negative, borderline, positive };
std::string to_string(Ischaemia ischaemia);    ///< "not tested", "negative", "borderline", "positive"
Ischaemia ischaemia(const std::string& text);  ///< of to_string; throws InvalidInput
/// By the FFR from CT behind a lesion, in hundredths: positive to 0.75, borderline to 0.80, negative above.
/// Throws InvalidInput outside [0, 1.2].
Ischaemia ischaemia_of_ffr(double ffr_ct);

struct CadRadsStatement {
  PatientCategory category;
  PlaqueBurden burden = PlaqueBurden::none;
  bool high_risk_plaque = false;
  Ischaemia ischaemia = Ischaemia::not_tested;
  bool stent = false, graft = false;
  bool exception = false;  ///< what is no atherosclerosis: dissection, anomalous origin, aneurysm, ...
};
/// "4A/P3/HRP/I+": category, burden (none: left out), then N, HRP, I+ (I-, I±), S, G, E.
std::string to_string(const CadRadsStatement& statement);

/// Which investigation the table of CAD-RADS for stable chest pain names next, in our words: "none",
/// "functional assessment can be considered", ...
std::string further_investigation(const PatientCategory& category);

}  // namespace ostia::analysis
