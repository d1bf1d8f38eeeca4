#pragma once
/// \file A model on the screen: kept solved while a person edits it.

#include "ostia/core/task_context.h"
#include "ostia/lumen/edit.h"
#include "ostia/lumen/incremental_surface.h"
#include "ostia/lumen/tree_field.h"
#include "ostia/lumen/tree_surface.h"

#include <map>
#include <memory>
#include <vector>

namespace ostia::lumen {

/// What a view has to draw anew after a change.
struct LiveChange {
  geometry::Box3 box;  ///< outside it no wall has moved by more than 1e-6 mm; empty when none has
  struct OfVessel {
    std::int32_t vessel = 0;
    bool solved_anew = false;           ///< the whole vessel may have changed
    double from_mm = 0.0, to_mm = 0.0;  ///< abscissas whose wall may have moved
  };
  std::vector<OfVessel> vessels;
};

/// The fields of a model's vessels, solved incrementally, and the tree's wall brought up to date on demand.
/// Not safe from several threads at once; the fields that it hands out are immutable.
class LiveModel {
 public:
  explicit LiveModel(std::shared_ptr<const LumenModel> model);  ///< throws as `solve` does
  ~LiveModel();
  LiveModel(LiveModel&&) noexcept;
  LiveModel& operator=(LiveModel&&) noexcept;

  const LumenModel& model() const;
  /// Follows an edit's outcome. Throws InvalidInput or NumericalError where a vessel cannot be solved; then
  /// all is as before and the edit is to be refused.
  LiveChange follow(const EditOutcome& outcome);

  std::shared_ptr<const ImplicitSurface> surface(std::int32_t vessel) const;  ///< throws InvalidInput
  std::shared_ptr<const TreeField> field() const;
  /// The tree's wall with cells of `cell_mm` (the same in all calls, or it is made anew); only blocks that
  /// changed since the last call are made.
  geometry::TriMesh wall(double cell_mm = 0.25, const core::TaskContext& task = core::no_task());

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::lumen
