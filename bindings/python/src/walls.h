#pragma once
/// \file The solved walls of a model, for all that measures on them.

#include "ostia/core/task_context.h"
#include "ostia/lumen/implicit_surface.h"
#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <map>
#include <memory>

namespace ostia::python {

struct SolvedWalls {
  std::map<std::int32_t, std::shared_ptr<const lumen::ImplicitSurface>> surfaces;  ///< by vessel
  std::shared_ptr<const lumen::ImplicitSurface> operator()(
      std::int32_t vessel) const;  ///< throws InvalidInput
};
/// Each vessel afresh in canonical order. Throws as lumen::solve does; Cancelled.
SolvedWalls solved(const lumen::LumenModel& model, const core::TaskContext& task);

}  // namespace ostia::python
