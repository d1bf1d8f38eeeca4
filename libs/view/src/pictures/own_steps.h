#pragma once
// The steps that one gesture makes, so that Escape can take back these and no others.

#include "ostia/session/workbench.h"

#include <cstdint>
#include <vector>

namespace ostia::view {

class OwnSteps {
 public:
  /// After each command of the gesture; merged ones are one step.
  void note(const session::Workbench& bench, const session::Session::Done& done) {
    if (!done.edited && done.annotations.empty()) return;  // no step came of it
    const auto last = bench.session().file().next_undo();
    if (last && (numbers_.empty() || numbers_.back() != last->number)) numbers_.push_back(last->number);
  }
  /// From the last one on, as far as nobody else made a step after it. Throws as Workbench::undo does.
  void take_back(session::Workbench& bench) {
    while (!numbers_.empty() && bench.has_case()) {
      const auto last = bench.session().file().next_undo();
      if (!last || last->number != numbers_.back()) return;
      numbers_.pop_back();
      bench.undo();
    }
  }

 private:
  std::vector<std::int64_t> numbers_;
};

}  // namespace ostia::view
