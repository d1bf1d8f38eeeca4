#include "scan/artefacts.h"
#include "scan/slice_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

constexpr std::uint64_t streak_stream = 0x73747265616bULL;
constexpr double streak_cell_mm = 0.8;
constexpr int streak_views = 360;          // over half a turn
constexpr double streaks_from_hu = 350.0;  // above all that is well mixed
constexpr double streaks_to_hu = 6000.0;   // metal is denser than the scale of CT numbers
constexpr double view_error = 0.04;        // of a view's share, at strength 1
constexpr double views_alike = 5.0;        // neighbouring views
constexpr double slices_alike_mm = 2.5;

}  // namespace

ViewStreaks::ViewStreaks(const ScanOptions& options)
    : spacing_(options.grid.spacing), strength_(options.realism.streaks) {
  if (!none()) noise_ = std::make_shared<const NoiseField>(options.seed ^ streak_stream);
}

void ViewStreaks::add(const SliceView& slice, std::int64_t k) const {
  if (none()) return;
  const CoarseSlice dense(slice, spacing_, streak_cell_mm, [](float hu) {
    return std::clamp(static_cast<double>(hu) - streaks_from_hu, 0.0, streaks_to_hu) * water_per_mm / 1000.0;
  });
  if (std::all_of(dense.values.begin(), dense.values.end(), [](double v) { return v <= 0.0; })) return;
  SliceDetector detector(dense);
  CoarseSlice error = dense;
  std::fill(error.values.begin(), error.values.end(), 0.0);
  const double height = spacing_.z() * static_cast<double>(k) / slices_alike_mm;
  for (int n = 0; n < streak_views; ++n) {
    detector.turn_to(std::numbers::pi * n / streak_views);
    std::vector<double> view = detector.projection(dense);
    const double off = view_error * strength_ * noise_->at({n / views_alike, height, 0.0});
    for (double& p : view) p *= off;
    detector.back_project(detector.ramp_filtered(view), streak_views, error);
  }
  error.add_to(slice, 1000.0 / water_per_mm);
}

}  // namespace ostia::phantom
