#pragma once
/// \file How sharp and how noisy a CT image is, measured in the image alone: to compare scans, and to prove
/// that a synthetic one has the noise and blur that it was asked for.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace ostia::evaluation {

/// CT numbers of a set of voxels.
struct HuStatistics {
  std::size_t voxels = 0;
  double mean_hu = 0.0, deviation_hu = 0.0;
  double median_hu = 0.0, p05_hu = 0.0, p95_hu = 0.0;  ///< percentiles, between the values around them
};
/// Where the mask has this value (any but 0, where `value` is 0). Throws InvalidInput for another grid or no
/// voxel.
HuStatistics hu_statistics(const imaging::ImageVolume& image, const imaging::MaskVolume& mask,
                           std::uint8_t value = 0);
/// Voxels whose centres lie in a ball. Throws InvalidInput where there is none.
HuStatistics hu_statistics(const imaging::ImageVolume& image, const geometry::Vec3& centre_mm,
                           double radius_mm);

/// Shares of all voxels (or the mask's); what lies outside [from, to) counts in the first and last bin.
struct HuHistogram {
  double from_hu = 0.0, bin_hu = 1.0;
  std::vector<double> share;  ///< sums to 1
};
HuHistogram hu_histogram(const imaging::ImageVolume& image, double from_hu = -1024.0, double to_hu = 1500.0,
                         double bin_hu = 20.0, const imaging::MaskVolume* mask = nullptr);
/// Half the sum of absolute differences, in [0, 1]: 0 the same, 1 nothing in common. Throws InvalidInput for
/// different bins.
double histogram_distance(const HuHistogram& a, const HuHistogram& b);

/// A square of voxels within a slice: lowest i, j and its k.
using NoiseRegion = std::array<std::int64_t, 3>;

/// The noise power spectrum in the plane of the slices: mean over squares, each less its best polynomial of
/// second order (IEC 61223-3-5 and ICRU 87 describe the method), and averaged over directions.
struct NoisePower {
  std::vector<double> frequency_per_mm;  ///< middle of each ring
  std::vector<double> power_hu2_mm2;     ///< mean over the ring
  double deviation_hu = 0.0;             ///< root of the spectrum's integral: of the squares less their trend
  double peak_per_mm = 0.0;              ///< of the parabola through the top, log power
  double mean_per_mm = 0.0;              ///< integral of f NPS(f) over that of NPS(f)
  /// How much of the power lies along one direction: the modulus of the second harmonic over the angle, 0
  /// (the same all round) to 1 (streaks).
  double anisotropy = 0.0;
  /// Along which the noise is longest, across its strongest waves: from the i axis towards the j axis, [0,
  /// 180).
  double streaks_deg = 0.0;
  std::size_t regions = 0;
};
/// Throws InvalidInput for no region, a side below 8 voxels, and a region that reaches beyond the image.
NoisePower noise_power(const imaging::ImageVolume& image, const std::vector<NoiseRegion>& regions, int side);
/// How alike the noise of slices is that lie 1, 2, ..., `most` apart: the correlation of squares (less their
/// trends) with those above them. Squares without so many slices above are left out of those lags. Throws
/// InvalidInput as noise_power does, and where a lag has no square.
std::vector<double> noise_correlation_along_k(const imaging::ImageVolume& image,
                                              const std::vector<NoiseRegion>& regions, int side, int most);
/// Squares wholly inside the mask, side by side; every `slice_step`-th slice.
std::vector<NoiseRegion> noise_regions(const imaging::MaskVolume& mask, int side, int slice_step = 1);

/// Which edges count, by the direction of their normal: within some 10 degrees of the slice's plane or of the
/// k axis.
enum class EdgeDirection { any, in_plane, along_k };

struct EdgeOptions {
  EdgeDirection direction = EdgeDirection::any;
  double half_length_mm = 2.5;       ///< of the profile, to either side of the edge
  double tube_radius_mm = 1.0;       ///< voxels so near a normal belong to its profile (fitted boundaries)
  double least_contrast_hu = 150.0;  ///< fitted boundaries: fainter edges are left out
  double most_residual = 0.12;       ///< fitted boundaries: root mean square misfit, a share of the contrast
};

/// An edge-spread function's figures. `fwhm_mm` is of the Gaussian whose integral fits the profile best, as
/// little disturbed by noise as can be; `line_spread_fwhm_mm` is read off the derivative of the oversampled
/// profile without a model, for images of little noise.
struct EdgeWidth {
  double fwhm_mm = 0.0;
  double line_spread_fwhm_mm = 0.0;
  double low_hu = 0.0, high_hu = 0.0;
  double shift_mm = 0.0;  ///< where the profile passes half its height, on the signed distance
  double residual_hu = 0.0;
  std::size_t samples = 0;
};
/// Across a known boundary: all voxels near it, by their signed distance (mm, its gradient of length 1).
/// Throws InvalidInput where fewer than 50 voxels lie near it, NumericalError where nothing fits.
EdgeWidth edge_width(const imaging::ImageVolume& image,
                     const std::function<double(const geometry::Vec3&)>& signed_distance_mm,
                     const EdgeOptions& options = {}, const core::TaskContext& task = core::no_task());

/// Widths found at the boundary of a mask, its place fitted anew at each.
struct EdgeWidths {
  std::vector<double> fwhm_mm;                         ///< ascending
  double median_mm = 0.0, p25_mm = 0.0, p75_mm = 0.0;  ///< 0 where no edge was good enough
  std::size_t tried = 0;
};
/// At up to `most` places spread evenly over the mask's boundary: the voxels about the gradient's line there
/// are fitted with an edge of free place, height and width. A real boundary is no step, and a vessel's
/// neighbours disturb it: the lower quartile tells the scanner's blur best.
EdgeWidths edge_widths(const imaging::ImageVolume& image, const imaging::MaskVolume& mask,
                       const EdgeOptions& options = {}, std::size_t most = 2000,
                       const core::TaskContext& task = core::no_task());

/// What edges look like on average: their profiles laid over each other, from 0 to 1 on their two sides (the
/// means beyond 0.6 of the half length).
struct EdgeProfile {
  std::vector<double> at_mm, level;  ///< in steps of 0.1 mm, the higher side last
  double undershoot = 0.0;           ///< how far it falls below 0 on the lower side
  double overshoot = 0.0;            ///< how far it rises above 1 on the higher side
  std::size_t edges = 0;
};
/// Of the edges that `edge_widths` finds good enough; without any, empty.
EdgeProfile edge_profile(const imaging::ImageVolume& image, const imaging::MaskVolume& mask,
                         const EdgeOptions& options = {}, std::size_t most = 2000,
                         const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
