#pragma once
/// \file Annotated sections of a lumen: how a result does against contours drawn by observers.

#include "ostia/core/task_context.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/contour_set.h"
#include "ostia/geometry/tri_mesh.h"

#include <string>
#include <vector>

namespace ostia::evaluation {

struct LumenScoreOptions {
  double sample_mm = 0.15;  ///< density of the points that are asked for their distance, > 0
  double line_mm = 0.05;    ///< distance of the lines that areas are measured by, > 0
  /// The result counts as this vessel up to so many largest radii of the reference's contours from its axis.
  double reach_radii = 1.8;
};
void validate(const LumenScoreOptions& options);

/// A result against one observer's contours of one section.
struct SectionScore {
  std::string section, vessel, observer;
  geometry::Health health = geometry::Health::healthy;
  double length_mm = 0.0;
  bool found = true;  ///< false: the result has no surface there; Dice is 0 and the distances are NaN
  double dice = 0.0;  ///< of the enclosed volumes between the first and the last contour's plane
  double msd_mm = 0.0, rms_sd_mm = 0.0, max_sd_mm = 0.0;
  double signed_mean_mm = 0.0;  ///< mean difference of the radii below: positive where the result is wider
  double floor_mm = 0.0;        ///< discretisation_floor_mm of the reference's contours
  std::vector<double> s_mm;     ///< of the reference's contours
  std::vector<double> reference_radius_mm, result_radius_mm;  ///< of circles of the same area there
};

/// The score where there is no result at all: not found, its radii 0, so that a stenosis there is missed. The
/// section has no fault (geometry::find_fault).
SectionScore score_of_nothing(const geometry::ContourSection& reference);

/// A result's surface, prepared once for many sections.
class LumenResult {
 public:
  explicit LumenResult(geometry::TriMesh surface);  ///< throws InvalidInput when it has no triangle
  /// The part of the surface that belongs to the section is what lies between the planes of its first and
  /// last contour, near its axis and, seen from there, behind no wall of the result's own (what is behind one
  /// is another vessel or a side branch). Distances are exact, from each surface to the other, weighted by
  /// area: MSD is their mean, the maximum the larger of the two. Throws InvalidInput for a section with a
  /// fault.
  SectionScore score(const geometry::ContourSection& reference, const LumenScoreOptions& options = {},
                     const core::TaskContext& task = core::no_task()) const;

 private:
  geometry::TriMesh surface_;
  geometry::AabbTree tree_;
};

/// A section's own contours as a result: what they enclose, drawn out by 0.5 mm at both ends, since caps in
/// the planes that end the section would count as surface.
LumenResult result_of(const geometry::ContourSection& section);

/// Means over sections, weighted by their lengths; sections that were not found count with Dice 0 and in
/// `missing`, not in the distances.
struct LumenSummary {
  std::size_t sections = 0, missing = 0;
  double length_mm = 0.0;
  double dice = 0.0, msd_mm = 0.0, rms_sd_mm = 0.0, max_sd_mm = 0.0;  ///< max: the largest
};
LumenSummary summarize(const std::vector<SectionScore>& scores);

/// How much narrower the section's thinnest place is than its ends let expect: 1 - r / r_healthy, where
/// r_healthy is linear between the largest radii of its first and last third. In [0, 1].
double diameter_stenosis(const std::vector<double>& s_mm, const std::vector<double>& radius_mm);

}  // namespace ostia::evaluation
