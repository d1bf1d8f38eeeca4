#pragma once
/// \file The fat about a stretch of a vessel (docs/methods/fat-around-vessels.md).

#include "ostia/core/task_context.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace ostia::analysis {

struct FatOptions {
  double from_hu = -190.0, to_hu = -30.0;  ///< what is fat, [-300, 0], ascending (Antonopoulos et al. 2017)
  /// Reach from the outer wall, in vessel diameters, (0, 5].
  double reach_diameters = 1.0;
  /// Nearer to what is no fat (wall, muscle, blood, lung) voxels are partly that and are left out of
  /// `FatAmount::mean_hu`; about two and a half standard deviations of the scanner's blur. [0, 3] mm
  double edge_mm = 0.75;
  double slab_mm = 1.0;  ///< of the map along the vessel, [0.25, 10]
  int sectors = 8;       ///< of the map around it, [1, 64]
};
void validate(const FatOptions& options);  ///< throws InvalidInput

struct FatAmount {
  std::int64_t voxels = 0;      ///< fat, clear of edges
  double mean_hu = 0.0;         ///< of them; 0 of none
  double sd_hu = 0.0;           ///< of single voxels, noise included
  std::int64_t all_voxels = 0;  ///< fat by its CT number, beside edges, too
  double all_mean_hu = 0.0;     ///< of those: the index as studies measure it
  double volume_mm3 = 0.0;      ///< of all of these
};

/// One piece of the map: a slab along the vessel, a sector around it.
struct FatPiece {
  double from_mm = 0.0, to_mm = 0.0;  ///< along
  double from_theta = 0.0;            ///< geometry::radial_direction's angle; the sector's width is 2 pi / n
  FatAmount fat;
};

struct FatProfile {
  FatOptions options;
  double from_mm = 0.0, to_mm = 0.0;
  double diameter_mm = 0.0;      ///< mean within the outer wall over the stretch
  FatAmount fat;                 ///< of all of it
  std::vector<FatAmount> slabs;  ///< from proximal to distal, the last may be shorter
  std::vector<FatPiece> pieces;  ///< slab by slab, sector by sector
};

/// A stretch of a vessel with its outer wall, by abscissa and geometry::radial_direction's angle.
struct FatStretch {
  double from_mm = 0.0, to_mm = 0.0;
  std::function<double(double s_mm, double theta)> outer_mm;
};

/// A voxel belongs to the stretch where the axis' nearest point to its centre does, and lies beyond the outer
/// wall by no more than the reach. The same for any number of threads. Throws InvalidInput for bad options, a
/// stretch that the axis has not or radii that are not finite, and Cancelled.
FatProfile fat_profile(const geometry::AxisCurve& axis, const FatStretch& stretch,
                       const imaging::ImageVolume& image, const FatOptions& options = {},
                       const core::TaskContext& task = core::no_task());

/// The stretch that the index of a vessel is measured in, mm from where the vessel begins: RCA 10 to 50, LAD
/// and LCX 0 to 40 (Oikonomou et al. 2018). Nothing for another name.
struct FatRange {
  double from_mm = 0.0, to_mm = 0.0;
};
std::optional<FatRange> fat_range(std::string_view vessel);

/// What a mean taken at this tube voltage would be at 120 kV, by the ratios measured in hearts of pigs at 80,
/// 100 and 140 kV, linear between; nothing outside of 80 to 140 kV. An estimate: scanner and reconstruction
/// shift it, too.
std::optional<double> fat_hu_at_120_kv(double mean_hu, double tube_kv);

}  // namespace ostia::analysis
