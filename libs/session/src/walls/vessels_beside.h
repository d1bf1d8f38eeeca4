#pragma once
/// \file Work on a model's vessels side by side.

#include "ostia/analysis/lumen_profile.h"
#include "ostia/core/parallel.h"
#include "ostia/core/task_context.h"
#include "ostia/lumen/lumen_model.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace ostia::session {

/// `of(i, task)` for each i of `count`, side by side; the results in their order. `effort`, one each or none:
/// what takes longest begins first, so that no thread ends up with it alone.
template <class Result, class Of>
std::vector<Result> beside(std::size_t count, const core::TaskContext& task, const Of& of,
                           const std::vector<double>& effort = {}) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!effort.empty())
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return effort[a] > effort[b]; });
  std::vector<Result> results(count);
  std::atomic<std::size_t> next{0}, done{0};
  core::parallel_for(count, 1, [&](std::size_t) {
    task.throw_if_cancelled();
    const std::size_t i = order[next++];
    results[i] = of(i, count == 1 ? task : task.sub(0.0, 0.0));  // all run at once: what is done counts
    task.set_progress(static_cast<double>(++done) / static_cast<double>(count));
  });
  return results;
}

/// How long vessels' own parts are, mm: what work on each of them takes.
inline std::vector<double> own_lengths(const lumen::LumenModel& model) {
  std::vector<double> out;
  for (const auto& vessel : model.vessels) out.push_back(vessel->axis->length() - vessel->own_from_mm);
  return out;
}

/// All vessels' walls, asked of the calling thread now, so that any thread may ask for them from now on.
inline analysis::SurfaceOfVessel held_surfaces(const lumen::LumenModel& model,
                                               const analysis::SurfaceOfVessel& surface_of) {
  std::map<std::int32_t, std::shared_ptr<const lumen::ImplicitSurface>> held;
  for (const auto& vessel : model.vessels) held[vessel->vessel] = surface_of(vessel->vessel);
  return [held = std::move(held)](std::int32_t vessel) { return held.at(vessel); };
}

}  // namespace ostia::session
