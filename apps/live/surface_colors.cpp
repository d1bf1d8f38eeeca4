#include "surface_colors.h"

#include <utility>

namespace ostia::live {

using glview::SurfaceValue;

SurfaceColors::SurfaceColors(glview::ShownSurface surface, motion::MovingCage cage)
    : surface_(std::move(surface)), cage_(std::move(cage)) {}

void SurfaceColors::ask(SurfaceValue value) {
  if (!busy()) work_.emplace([this, value](const core::TaskContext& task) { return find(value, task); });
}

SurfaceColors::Found SurfaceColors::take() {
  struct End {
    std::optional<Preparation<Found>>& work;
    ~End() { work.reset(); }
  } const end{work_};
  return work_->get();
}

SurfaceColors::Found SurfaceColors::find(SurfaceValue value, const core::TaskContext& task) {
  Found found;
  found.value = value;
  const bool goes_along = value == SurfaceValue::stretch || value == SurfaceValue::bending;
  if (goes_along && surface_.along.empty()) surface_.along = glview::find_directions(surface_, 3.0, task);
  if (goes_along) found.along = surface_.along;
  if (value == SurfaceValue::bending) found.bending = glview::bending_table(surface_, cage_, 20, 3.0, task);
  found.range = glview::value_range(surface_, cage_, value, found.bending ? &*found.bending : nullptr, task);
  return found;
}

}  // namespace ostia::live
