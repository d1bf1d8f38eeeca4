#include "scene/way_marks.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/view/vessel_colors.h"

#include <algorithm>

namespace ostia::view {
namespace {

constexpr double least_named_mm = 2.0;  // of a segment that is named within a parent's part

}  // namespace

std::vector<WayMark> way_marks(const session::Workbench& bench) {
  const std::int32_t selected = bench.vessel.get();
  const std::vector<analysis::WayStretch> way = bench.way(selected);
  std::vector<analysis::VesselSegment> segments;
  if (way.size() > 1) segments = analysis::segments_of(*bench.model());
  std::vector<WayMark> marks;
  for (const analysis::WayStretch& one : way) {
    WayMark mark{one.vessel, one.vessel != selected,         one.from_mm, one.to_mm,
                 {},         vessel_color(bench, one.vessel)};
    for (const analysis::VesselSegment& segment : segments) {
      const double from = std::max(segment.from_mm, one.from_mm), to = std::min(segment.to_mm, one.to_mm);
      if (segment.vessel != one.vessel || !segment.aha || to - from < least_named_mm) continue;
      mark.name += (mark.name.empty() ? "" : ", ") + segment.label;
    }
    if (mark.name.empty()) mark.name = bench.vessel_name(one.vessel);
    marks.push_back(std::move(mark));
  }
  return marks;
}

}  // namespace ostia::view
