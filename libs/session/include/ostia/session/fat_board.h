#pragma once
/// \file The fat about the main arteries of the workbench's case, as far as it is known, and the work that
/// measures it.

#include "ostia/session/property.h"
#include "ostia/session/session.h"
#include "ostia/session/vessel_fat.h"
#include "ostia/session/workbench.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::session {

/// A case that no longer changes, with its image.
struct FatWork {
  std::shared_ptr<const lumen::LumenModel> model;
  SolvedWalls walls;
  std::shared_ptr<const imaging::ImageVolume> image;
  std::optional<double> tube_kv = {};
  CaseFat found(const core::TaskContext& task = core::no_task()) const;  ///< any thread; throws as case_fat
};

/// Watches the workbench: what is known ends with the model, the image or the case that it was measured with.
/// One thread.
class FatBoard {
 public:
  explicit FatBoard(Workbench& bench);
  FatBoard(const FatBoard&) = delete;
  FatBoard& operator=(const FatBoard&) = delete;

  Property<bool> shown{false};
  Signal<> changed;  ///< something is known that was not, or the other way round

  const CaseFat* known() const { return known_ ? &*known_ : nullptr; }
  const VesselFat* of_selected() const;  ///< null where nothing is known of the selected vessel
  std::uint64_t revision() const { return revision_; }  ///< another number whenever `known` is another
  /// Nothing where it is known or cannot be (no case, no image).
  std::optional<FatWork> work() const;
  /// Takes what the work found; false, and nothing taken, where model or image are others by now.
  bool take(const FatWork& work, CaseFat found);

 private:
  void drop();
  Workbench& bench_;
  std::optional<CaseFat> known_;
  std::uint64_t revision_ = 1;
  std::vector<Subscription> own_;
};

}  // namespace ostia::session
