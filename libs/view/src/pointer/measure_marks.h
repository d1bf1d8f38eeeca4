#pragma once
// A measurement as lines, handles and a text in a view.

#include "ostia/view/picture_view.h"

#include <functional>
#include <utility>

namespace ostia::view {

inline constexpr double mark_reach_mm = 2.0;  // farther from the view a measurement's points are not shown

void add_measurement_marks(Overlay& overlay, PictureView& view, const analysis::Measurement& measurement,
                           double reach_mm);
/// "12.3 mm", or what is wrong with it.
std::string measured_text(const session::Workbench& bench, const analysis::Measurement& measurement);
/// Of those that are to be seen the ones that stand on stretches of the selected vessel (stenosis, volume;
/// ring: one place).
std::vector<analysis::Measurement> stretches_of(const session::Workbench& bench);
/// The line by which a view shows an end of a stretch at an abscissa.
using EndLine = std::function<std::pair<Vec2, Vec2>(double s_mm)>;
/// Of the ends of these the nearest within `reach_px`, as such lines.
std::optional<HandleHit> end_near(const session::Workbench& bench, const Vec2& px, double reach_px,
                                  const EndLine& line_of);
Role role_of(const session::Workbench& bench, const analysis::Measurement& measurement);
/// Its name, or its kind and number, and what is measured: "Distance 3: 12.3 mm".
std::string label_of(const session::Workbench& bench, const analysis::Measurement& measurement);

/// The place of a piece of a line that is nearest to another place.
struct SegmentFoot {
  Vec2 place = Vec2::Zero();
  double t = 0.0, distance = 0.0;  // of the way from a to b; of the two places
};
SegmentFoot foot_on_segment(const Vec2& p, const Vec2& a, const Vec2& b);

}  // namespace ostia::view
