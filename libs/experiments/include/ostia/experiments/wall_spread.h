#pragma once
/// \file The wall-spread experiment: how often the true calibre lies within the interval that an image lets
/// expect. See docs/experiments/wall-spread.md.

#include "ostia/analysis/wall_spread.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/imaging/volume.h"
#include "ostia/phantom/radial_profile.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ostia::experiments {

/// An artery of 44 mm with one narrowing in half fat, half muscle, as a scanner shows it. All of it is drawn
/// from the seed: calibre, narrowing, plaque, contrast, noise, blur and voxels.
struct NoisyVessel {
  imaging::ImageVolume image;
  std::shared_ptr<const geometry::AxisCurve> axis;
  phantom::RadialProfile lumen;  ///< the truth, about the axis
  double throat_mm = 0.0, lesion_mm = 0.0;
  double noise_hu = 0.0, lumen_hu = 0.0, fwhm_mm = 0.0, voxel_mm = 0.0;
  bool calcified = false;
};
NoisyVessel noisy_vessel(std::uint64_t seed);

/// One section of one vessel.
struct SpreadSection {
  std::uint64_t seed = 0;
  double s_mm = 0.0;
  double true_radius_mm = 0.0, found_radius_mm = 0.0;  ///< of the circle of equal area
  bool narrowed = false;                               ///< within the lesion
  bool calcified = false;                              ///< that vessel's plaque has calcium
  analysis::WallEvidence evidence;                     ///< at the wall that was found
  double noise_hu = 0.0;                               ///< measured in the image
  double seen_mm = 0.0, unseen_mm = 0.0;               ///< the model's two parts, the first at a scale of 1
  double sd_mm = 0.0;                                  ///< by the model
  /// Of the logarithm of the radius, in units of its spread: beyond 1.96 the truth is outside of the 95 %
  /// interval.
  double deviation() const;
};
struct WallSpreadOptions {
  std::uint64_t first_seed = 20001;
  int vessels = 100, sections = 2;  ///< of each vessel, [1, 8]
  analysis::WallSpreadModel model;
};
void validate(const WallSpreadOptions& options);  ///< throws InvalidInput

struct SpreadRun {
  std::vector<SpreadSection> sections;
  /// Of each vessel its deviations every half millimetre: how they go together along it.
  std::vector<std::vector<double>> courses;
};
/// The lumen is looked for in each image (segmentation::lumen_boundary) about an axis 0.2 mm beside the true
/// one; sections lie 6 mm apart or farther, one of them at the throat. Deterministic. Throws InvalidInput,
/// Cancelled.
SpreadRun run_wall_spread(const WallSpreadOptions& options, const core::TaskContext& task = core::no_task());

/// Of a group of sections.
struct SpreadCoverage {
  std::string name;
  std::size_t sections = 0;
  double held = 0.0;                   ///< share whose truth lies within the interval
  double bias_mm = 0.0, rms_mm = 0.0;  ///< of found less true radius
  double sd_mm = 0.0;                  ///< mean of the model's
  double half_width = 0.0;             ///< mean half width of the interval, of the diameter
};
/// All, healthy, narrowed, with and without calcium, below and above 30 HU of noise.
std::vector<SpreadCoverage> coverage(const std::vector<SpreadSection>& sections);
/// The `scale` with which 95 % of these are held; the rest of the model as it is.
double fitted_scale(const std::vector<SpreadSection>& sections, const analysis::WallSpreadModel& model);
/// How deviations go together: a share that all of a vessel has in common, and the length of a Matern 3/2
/// kernel for the rest; both by least squares over lags of 0.5 to 15 mm.
struct SpreadCorrelation {
  double common_share = 0.0, length_mm = 0.0;
  std::vector<double> by_lag;  ///< at 0, 0.5, 1, ... mm
};
SpreadCorrelation correlation_of(const std::vector<std::vector<double>>& courses);

std::string parameters_json(const WallSpreadOptions& fitting, const WallSpreadOptions& judged);
std::string wall_spread_json(const SpreadRun& fitting, const SpreadRun& judged,
                             const WallSpreadOptions& options);
std::string wall_spread_text(const SpreadRun& fitting, const SpreadRun& judged,
                             const WallSpreadOptions& options);
/// sections.csv of both and correlation.csv into a folder that is there.
void write_wall_spread_report(const std::filesystem::path& folder, const SpreadRun& fitting,
                              const SpreadRun& judged);

}  // namespace ostia::experiments
