#pragma once
/// \file What all ways through vessels share: which intensities are lumen, and the line centred and measured.

#include "path/line.h"
#include "path/speed.h"

#include "ostia/segmentation/minimal_path.h"

#include <cstdio>
#include <string>
#include <vector>

namespace ostia::segmentation::detail {

inline constexpr double kLineStepMm = 0.5;  // while a line is centred

template <class... Values>
std::string worded(const char* format, Values... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

/// Throws InvalidInput for an empty image or a place outside of it; `what` names the place ("the click").
void require_inside(const imaging::ImageVolume& image, const Vec3& place, const std::string& what);

/// Lumen, background and calcium: lumen as in `lumen_places` (their median), tissue as about `around`.
LumenLevels levels_from(const imaging::ImageVolume& image, const std::vector<Vec3>& lumen_places,
                        const std::vector<Vec3>& around);
/// The same where a tree's wide arteries are brighter than those about the click, which partial volume dims:
/// calcium is brighter than the upper quartile of all places of its axes.
LumenLevels calcium_above(const LumenLevels& levels, const imaging::ImageVolume& image,
                          const std::vector<Vec3>& axes);
/// The brightest voxel (lightly smoothed) of a place and its 26 neighbours.
struct BrightVoxel {
  double hu = 0.0;
  Vec3 place = Vec3::Zero();
};
BrightVoxel brightest_about(TubeSpeed& image, const Vec3& place);
/// Full contrast for a vessel as dim as the one that was clicked.
LumenLevels dimmed(const LumenLevels& levels, double click_hu);

/// The click, or the best place within reach where it lies beside the lumen, which is told. Throws
/// InvalidInput where there is no lumen.
Vec3 snapped(TubeSpeed& speed, const Vec3& click, double snap_voxels, std::vector<std::string>& warnings);

RayOptions rays_for(const TubeSpeed& speed, const MinimalPathOptions& options);
/// Median of the radii along a line as the image shows them.
double middle_radius(TubeSpeed& speed, const std::vector<Vec3>& line, const MinimalPathOptions& options);

/// Centres the line and measures along it: everything of `path` but its junction and visited voxels. What is
/// fixed is not measured (it belongs to the parent's lumen); its radii are those next to it.
void finish(MinimalPath& path, TubeSpeed& speed, const std::vector<Vec3>& rough, const FixedEnds& fixed,
            const MinimalPathOptions& options);

class PathTarget;
/// The junction of a way whose first point lies in the lumen of the target, in the voxel `reached`; then
/// centred and measured from there. Throws InvalidInput, naming the place `what`, where nothing of it lies
/// outside of the lumen.
void join_and_finish(MinimalPath& path, TubeSpeed& speed, const PathTarget& target, const Voxel& reached,
                     const std::vector<Vec3>& way, double fixed_end_mm, const MinimalPathOptions& options,
                     const std::string& what);

}  // namespace ostia::segmentation::detail
