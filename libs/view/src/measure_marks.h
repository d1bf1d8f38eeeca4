#pragma once
// A measurement as lines, handles and a text in a view.

#include "ostia/view/picture_view.h"

namespace ostia::view {

inline constexpr double mark_reach_mm = 2.0;  // farther from the view a measurement's points are not shown

void add_measurement_marks(Overlay& overlay, PictureView& view, const analysis::Measurement& measurement,
                           double reach_mm);
/// "12.3 mm", or what is wrong with it.
std::string measured_text(const session::Workbench& bench, const analysis::Measurement& measurement);
/// Measurements that stand on stretches of the selected vessel (stenosis, volume; ring: one place): where
/// they lie.
struct StretchMark {
  double from_mm = 0.0, to_mm = 0.0;
  std::string text;
  bool selected = false;
};
std::vector<StretchMark> stretches_of(const session::Workbench& bench);
/// A word before the text: "3: LAD " ...
std::string caption(const analysis::Measurement& measurement);

}  // namespace ostia::view
