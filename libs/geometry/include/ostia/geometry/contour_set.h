#pragma once
/// \file Closed contours across vessels: what observers draw, what a lumen is given by between two places.

#include "ostia/geometry/vec.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::geometry {

/// A closed line across a vessel. World LPS mm, counter-clockwise looking distally, first point at theta = 0,
/// not repeated at the end.
struct Contour {
  double s_mm = 0.0;  ///< abscissa on the vessel's axis
  std::vector<Vec3> points;
};

enum class Health { healthy, diseased };

/// A stretch of one vessel's boundary as one observer sees it.
struct ContourSection {
  std::string section;             ///< key, the same for all observers of this stretch: "s03"
  std::string vessel;              ///< "LAD"
  std::string observer;            ///< "truth", "observer1", ...
  std::string boundary = "lumen";  ///< "lumen" or "wall" (the outer wall)
  Health health = Health::healthy;
  std::vector<Contour> contours;  ///< by ascending s_mm, at least two
};

struct ContourSet {
  std::vector<ContourSection> sections;
};

/// The contour's mean normal by Newell's formula, unit; distal for a contour in the order above. Zero for a
/// contour without area.
Vec3 contour_normal(const Contour& contour);
double contour_area(const Contour& contour);    ///< mm^2, of its projection along its mean normal
Vec3 contour_centroid(const Contour& contour);  ///< mm, of that projection's area
/// Whether two of its pieces cross or touch, judged in the plane of its mean normal.
bool crosses_itself(const Contour& contour);

/// What is wrong with a section (fewer than two contours, contours of fewer than three points, points that
/// are not finite or repeated, abscissas that do not ascend, a contour that crosses itself or runs against
/// its neighbours), with the contour's abscissa; nothing if sound.
std::optional<std::string> find_fault(const ContourSection& section);

}  // namespace ostia::geometry
