#pragma once
/// \file The lumen's size along a vessel.

#include "ostia/core/task_context.h"
#include "ostia/lumen/implicit_surface.h"
#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace ostia::analysis {

using geometry::Vec3;

struct ProfileOptions {
  double step_mm = 0.5;  ///< between sections, [0.05, 5]
  int around = 64;       ///< rays of a section, [16, 512]
};
void validate(const ProfileOptions& options);  ///< throws InvalidInput

/// The lumen on the cross-section at an abscissa.
struct SectionMeasures {
  double s_mm = 0.0;
  bool found = false;  ///< the wall closes about the axis, or near it; all measures are 0 where it does not
  double area_mm2 = 0.0;
  double perimeter_mm = 0.0;
  double diameter_mm = 0.0;  ///< of the circle of the same area
  double least_diameter_mm = 0.0,
         largest_diameter_mm = 0.0;  ///< least and largest distance of two parallel tangents
  Vec3 centroid = Vec3::Zero();      ///< of the area; the axis' point where not found
  bool open = false;  ///< not found because the wall does not close within 12 mm; otherwise the lumen is shut
  Vec3 normal = Vec3::UnitZ();  ///< of the section: the axis' tangent, distal
};

/// Sections from the root to the vessel's end, at equal steps no longer than `step_mm`, ends included.
struct LumenProfile {
  std::int32_t vessel = 0;
  ProfileOptions options;
  double length_mm = 0.0;
  std::vector<SectionMeasures> sections;
};

/// The solved wall of a vessel: LiveModel::surface, or lumen::solve.
using SurfaceOfVessel = std::function<std::shared_ptr<const lumen::ImplicitSurface>(std::int32_t vessel)>;

/// Measured on the wall of the vessel that owns the place (lumen::owner_at), without the branches that leave
/// there: a branch's mouth does not widen the vessel. Where the axis lies outside the lumen, the lumen
/// nearest to it within 3 mm is measured. `surface_of` is asked from the calling thread. Throws InvalidInput,
/// Cancelled.
LumenProfile lumen_profile(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of,
                           std::int32_t vessel, const ProfileOptions& options = {},
                           const core::TaskContext& task = core::no_task());
/// The same profile after an edit that moved walls between two abscissas alone: only sections there, and one
/// on either side, are measured again. Throws InvalidInput where the axis is not the one of the profile; the
/// profile is then as before.
void update_profile(LumenProfile& profile, const lumen::LumenModel& model, const SurfaceOfVessel& surface_of,
                    double from_mm, double to_mm);

/// One section, as a profile has it, with its contour: counter-clockwise looking distally, from theta = 0 (or
/// the point nearest to it) on. `around` points on the wall to 1e-6 mm; as many as its bends ask for where
/// the lumen is too flat for rays or not star-shaped. None where it is not found. Throws InvalidInput for an
/// abscissa outside the vessel.
struct MeasuredSection {
  SectionMeasures measures;
  std::vector<Vec3> contour;
};
MeasuredSection measured_section(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of,
                                 std::int32_t vessel, double s_mm, const ProfileOptions& options = {});

/// Linear between sections; not `found` where a neighbour is not. Beyond an end, that end's. Throws
/// InvalidInput for a profile without sections.
SectionMeasures at(const LumenProfile& profile, double s_mm);
/// Integral of the area along the way of the centroids (Pappus), mm^3: right for bent vessels and an axis off
/// the middle. Throws InvalidInput outside the vessel or where a section is missing.
double volume_mm3(const LumenProfile& profile, double from_mm, double to_mm);

}  // namespace ostia::analysis
