#pragma once
// Places on the lumen's outline across a vessel, for measurements that one click on the wall places.

#include "ostia/session/workbench.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::view {

using geometry::Vec3;

/// The section as it is now; `around` as analysis::ProfileOptions has it. Nothing where the vessel or its
/// lumen is not there.
std::optional<analysis::MeasuredSection> section_of(const session::Workbench& bench, std::int32_t vessel,
                                                    double s_mm, int around = 64);

/// Two places of the outline whose distance is the section's diameter (that of the circle of its area), on a
/// line through its centroid: the profile tells the same number, and the line ends on the wall. Of several
/// such lines (a round lumen has any) the one that is most across `sight`. Where the lumen's form has none,
/// the line that comes nearest. Nothing for a centroid outside the outline.
std::optional<std::pair<Vec3, Vec3>> diameter_ends(const analysis::MeasuredSection& section,
                                                   const Vec3& sight);

/// The outline, moved outwards from its centroid.
std::vector<Vec3> widened(const analysis::MeasuredSection& section, double by_mm);

}  // namespace ostia::view
