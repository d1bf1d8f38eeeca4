#include "vein_stretch.h"

#include "median.h"

namespace ostia::coronary {

std::size_t voxels_in_vein(const VeinLook& look, const FrontNodes& nodes, const imaging::FloatVolume& tube,
                           const imaging::FloatVolume& radius_mm, const std::vector<std::int64_t>& way) {
  constexpr double window_mm = 10.0, least_mm = 15.0;
  constexpr double wide_mm = 1.35, faint = 0.75, faint_tube = 0.68;  // shares of the contrast
  const auto forward = [&](std::size_t i) { return way[way.size() - 1 - i]; };
  const auto length = [&](std::size_t i) { return nodes.at(forward(i)).length_mm; };
  const auto like_vein = [&](std::size_t first, std::size_t last) {
    std::vector<double> hu, likeness, radius;
    for (std::size_t i = first; i < last; ++i) {
      const auto at = static_cast<std::size_t>(forward(i));
      hu.push_back((look.image.voxels[at] - look.fat_hu) / look.contrast_hu);
      likeness.push_back(tube.voxels[at]);
      radius.push_back(radius_mm.voxels[at]);
    }
    return median(radius) >= wide_mm && median(hu) < faint && median(likeness) < faint_tube;
  };
  std::size_t last = 0, begin = 0;
  bool within = false;
  for (std::size_t i = 0; i < way.size(); ++i) {
    while (last < way.size() && length(last) - length(i) < window_mm) ++last;
    if (last == way.size()) break;
    if (!like_vein(i, last)) {
      within = false;
      continue;
    }
    if (!within) begin = i;
    within = true;
    if (length(last) - length(begin) < least_mm) continue;
    // The first window may lie half in the artery.
    const double from_mm = length(begin) + 0.5 * window_mm;
    while (length(begin) < from_mm) ++begin;
    return way.size() - begin;
  }
  return 0;
}

}  // namespace ostia::coronary
