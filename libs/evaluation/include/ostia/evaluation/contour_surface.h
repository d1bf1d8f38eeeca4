#pragma once
/// \file The surface that contours across a vessel stand for.

#include "ostia/geometry/contour_set.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::evaluation {

struct ContourSurfaceOptions {
  bool caps = false;  ///< close both ends by fans
  int points = 0;     ///< a contour; 0: as many as the section's largest has
};

/// Ruled between consecutive contours, outward. Contours of other numbers of points are resampled by arc
/// length; each is turned so that its points lie nearest to those of the one before it, so there is no twist
/// whatever its first point is. Throws InvalidInput for a section with a fault (geometry::find_fault).
geometry::TriMesh surface_of(const geometry::ContourSection& section,
                             const ContourSurfaceOptions& options = {});

/// How far the ruled surface is from the smooth one that the contours were taken from, mean, mm: from the
/// surface of every contour to that of every second one, which is three times as far off (both errors go
/// with the square of the distance between contours), and of every point to every second. Zero for fewer
/// than three contours.
double discretisation_floor_mm(const geometry::ContourSection& section);

/// One row of the table of floors: a tube on a circle, tapered, stenosed and not round, whose surface is
/// known exactly as a function r(s, theta) about its axis.
struct FloorRow {
  double spacing_mm = 0.0;
  int points = 0;
  double mean_mm = 0.0, max_mm = 0.0;  ///< distance of the ruled surface from the exact one
  double estimate_mm = 0.0;            ///< discretisation_floor_mm of the same contours
};
struct FloorOptions {
  std::vector<double> spacings_mm{0.25, 0.5, 1.0, 2.0};
  std::vector<int> points{16, 32, 64, 128};
  double ring_radius_mm = 20.0, length_mm = 20.0;
  double radius_mm = 1.75, radius_end_mm = 1.25;    ///< linear in between
  double severity = 0.5, stenosis_length_mm = 8.0;  ///< cosine-shaped, in the middle, of the diameter
  double oval = 0.12, triangular = 0.05;  ///< r times 1 + oval cos 2 theta + triangular cos(3 theta + 1)
};
std::vector<FloorRow> floor_table(const FloorOptions& options = {});

}  // namespace ostia::evaluation
