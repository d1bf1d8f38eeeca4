#pragma once
/// \file What a board has found of vessels, after their tree has become another.

#include "ostia/session/workbench.h"

#include <cmath>
#include <cstdint>
#include <map>

namespace ostia::session {

/// Known: with `length_mm`, its vessel's when it was found, and `stale`. What stands at abscissas of a way
/// that is gone or has another length by now is forgotten. All else stays until it is found anew, since what
/// lies beside a vessel may be other than it was; a tree with other names alone changes nothing.
template <class Known>
void keep_known(std::map<std::int32_t, Known>& known, const Workbench& bench, const ModelEvent& event) {
  constexpr double same_length_mm = 0.1;
  std::erase_if(known, [&](const auto& one) {
    const auto axis = bench.axis(one.first);
    return !axis || !(std::abs(axis->length() - one.second.length_mm) <= same_length_mm);
  });
  if (event.change.vessels.empty()) return;
  for (auto& one : known) one.second.stale = true;
}

}  // namespace ostia::session
