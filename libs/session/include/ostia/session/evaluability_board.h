#pragma once
/// \file How far the workbench's vessels can be judged: what is known, and the work that finds it out.

#include "ostia/session/evaluability.h"
#include "ostia/session/workbench.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::session {

/// A vessel to be looked at, on a model that no longer changes.
struct EvaluabilityWork {
  std::shared_ptr<const lumen::LumenModel> model;
  SolvedWalls walls;
  std::shared_ptr<const imaging::ImageVolume> image;
  std::int32_t vessel = 0;
  std::optional<double> noise_hu;  ///< nothing: not known yet

  struct Found {
    VesselEvaluability vessel;
    double noise_hu = 0.0;
  };
  Found found(const core::TaskContext& task = core::no_task()) const;  ///< any thread
};

/// Watches the workbench. After an edit what was known of a vessel is kept until it is found anew, so that
/// nothing flickers, also where other vessels come or go; another image or case begins afresh. One thread.
class EvaluabilityBoard {
 public:
  explicit EvaluabilityBoard(Workbench& bench);
  EvaluabilityBoard(const EvaluabilityBoard&) = delete;
  EvaluabilityBoard& operator=(const EvaluabilityBoard&) = delete;

  Property<bool> shown{true};  ///< over pictures and profile
  Signal<> changed;            ///< stretches are others, by the program or by the reader

  /// Of a vessel's own part, the reader's word over the program's; empty where nothing is known.
  std::vector<analysis::EvaluableStretch> stretches(std::int32_t vessel) const;
  /// The selected vessel first; nothing where all is known or cannot be (no case, no image).
  std::optional<EvaluabilityWork> work() const;
  /// Takes what the work found; nothing: it cannot be found, and is not tried again until an edit. False, and
  /// nothing taken, where model or image are others by now.
  bool take(const EvaluabilityWork& work, std::optional<EvaluabilityWork::Found> found);

  /// The reader's word on a stretch of a vessel (nothing: as the program finds it), as a step that can be
  /// undone. Throws InvalidInput.
  void judge(std::int32_t vessel, double from_mm, double to_mm, std::optional<analysis::Evaluability> grade);

 private:
  struct Known {
    std::vector<analysis::EvaluableStretch> stretches;
    bool stale = true;
    double length_mm = 0.0;  ///< of its vessel
  };
  void drop();
  Workbench& bench_;
  std::map<std::int32_t, Known> known_;
  std::optional<double> noise_hu_;
  std::vector<Subscription> own_;
};

}  // namespace ostia::session
