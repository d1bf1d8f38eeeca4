#include "ostia/session/pressure_notes.h"

#include "case_file/same_bits.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

const hemodynamics::ConditionInput& input_named(const std::string& key) {
  const auto inputs = hemodynamics::condition_inputs();
  const auto found =
      std::find_if(inputs.begin(), inputs.end(), [&](const auto& one) { return one.key == key; });
  if (found == inputs.end()) throw InvalidInput("the pressures have no input \"" + key + "\"");
  return *found;
}

}  // namespace

std::string to_string(WhatIfKind kind) {
  return kind == WhatIfKind::open ? "open" : "narrow";
}

WhatIfKind what_if_kind(const std::string& text) {
  for (const WhatIfKind one : {WhatIfKind::open, WhatIfKind::narrow})
    if (to_string(one) == text) return one;
  throw InvalidInput("a stretch is to be \"" + text + "\"; it can be open or narrow");
}

void validate(const std::map<std::string, double>& inputs) {
  hemodynamics::validate(conditions_of({inputs, {}}));
}

void validate(const WhatIf& what_if) {
  const std::string stretch = "the stretch from " + core::shortest_text(what_if.from_mm) + " to " +
                              core::shortest_text(what_if.to_mm) + " mm";
  if (!(what_if.from_mm >= 0.0 && what_if.from_mm < what_if.to_mm && std::isfinite(what_if.to_mm)))
    throw InvalidInput(stretch + " is none; give its proximal end before its distal one");
  const bool open = what_if.kind == WhatIfKind::open;
  const double least = open ? 0.0 : 1.0, most = open ? 90.0 : 99.0;
  if (!(what_if.percent >= least && what_if.percent <= most))
    throw InvalidInput(stretch + " is to have a stenosis of " + core::shortest_text(what_if.percent) +
                       " %; " + (open ? "0 to 90 can be left of one" : "choose 1 to 99"));
}

hemodynamics::Conditions conditions_of(const PressureNotes& notes, hemodynamics::Conditions usual) {
  for (const auto& [key, value] : notes.inputs) {
    const hemodynamics::ConditionInput& input = input_named(key);
    if (input.value)
      usual.*input.value = value;
    else
      usual.*input.optional = value;
  }
  return usual;
}

bool same(const PressureNotes& a, const PressureNotes& b) {
  return std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(),
                    [](const auto& p, const auto& q) {
                      return p.first == q.first && same_bits(p.second, q.second);
                    }) &&
         std::equal(a.what_ifs.begin(), a.what_ifs.end(), b.what_ifs.begin(), b.what_ifs.end(),
                    [](const WhatIf& p, const WhatIf& q) {
                      return p.vessel == q.vessel && p.kind == q.kind && same_bits(p.from_mm, q.from_mm) &&
                             same_bits(p.to_mm, q.to_mm) && same_bits(p.percent, q.percent);
                    });
}

}  // namespace ostia::session
