#pragma once
/// \file The built-in case: a bifurcating, stenosed vessel of exactly known shape, as a CT angiogram would
/// show it.

#include "ostia/core/task_context.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::phantom {

/// Lengths, calibres and CT numbers of a left coronary artery (Dodge et al. 1992 for the diameters; usual
/// values for the HU).
struct BuiltinOptions {
  std::uint64_t seed = 1;       ///< noise, and small differences of course and severity
  double spacing_mm = 0.4;      ///< voxel, in [0.1, 2]
  double blur_fwhm_mm = 0.6;    ///< point-spread function (Gaussian), in [0, 5]
  double noise_hu = 20.0;       ///< standard deviation after correlation, in [0, 500]
  double noise_grain_mm = 0.3;  ///< deviation of the Gaussian that correlates the noise, in [0, 5]
  double lumen_hu = 380.0;
  double fat_hu = -80.0;
  double myocardium_hu = 100.0;
};
/// Throws InvalidInput.
void validate(const BuiltinOptions& options);

struct BuiltinStenosis {
  std::size_t tube = 0;    ///< in truth.tubes
  double centre_mm = 0.0;  ///< abscissa of the throat on the tube
  double length_mm = 0.0;
  double diameter_stenosis = 0.0;  ///< 0.5 is half the diameter
  double throat_radius_mm = 0.0;
};

struct BuiltinCase {
  imaging::ImageVolume image;
  geometry::AnalyticShape truth;  ///< tube 0: the main vessel; tube 1: the branch, from the main axis on
  BuiltinStenosis stenosis;
  /// Seed pairs, one a branch: what a person would click.
  std::vector<std::pair<geometry::Vec3, geometry::Vec3>> branches;
};

/// The image is the exact shape's partial volumes (supersampled), blurred, with correlated noise. The same
/// for the same options.
BuiltinCase make_builtin_case(const BuiltinOptions& options = {},
                              const core::TaskContext& task = core::no_task());

}  // namespace ostia::phantom
