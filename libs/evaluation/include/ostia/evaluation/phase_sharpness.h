#pragma once
/// \file Which of a heart's phases is the sharpest (docs/methods/best-phase.md).

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ostia::evaluation {

using geometry::Vec3;

struct SharpnessOptions {
  /// What is darker counts as this (lung), what is brighter as that (calcium, bone): edges are those between
  /// fat and blood. For all phases of a study the same.
  double low_hu = -100.0, high_hu = 400.0;
  double within_mm = 5.0;                 ///< about the points, [1, 50]
  double sigma_mm = 0.7;                  ///< of the Gaussian whose derivative is taken, [0.2, 3]
  double least_share_per_mm = 0.04;       ///< of high - low: fainter gradients are noise, [0, 0.5]
  std::int64_t most_voxels = 24'000'000;  ///< without points a larger region is looked at more coarsely
};
void validate(const SharpnessOptions& options);  ///< throws InvalidInput

/// How steep the edges of a region are. With g = |gradient of the image, held to [low, high]| over
/// high - low, summed over the region's voxels where g is no noise:
///   per_mm = sum g^2 / sum g
/// the mean steepness, weighted by itself: the normalized gradient squared of autofocus ([McGee]; a quality
/// of edges chooses the phase in [Stassi], the mean radial gradient in [CMMM2016]), but divided by the sum
/// of g once, which is the edges' area, so that a phase with more of them is not sharper. An edge between
/// low and high that is blurred by a Gaussian of deviation s in all (sigma_mm included) has
/// 1 / (2 sqrt(pi) s); one that is smeared over a length of L >> s has 1 / L.
struct EdgeSharpness {
  double per_mm = 0.0;     ///< 1/mm; 0 without an edge
  double edges_mm2 = 0.0;  ///< area of edges of full height with the same sum of g
  double noise_hu = 0.0;   ///< imaging::noise_level_hu; 0 where it cannot be told
  double inside = 1.0;     ///< share of the points that lie in the image
  Vec3 spacing_mm = Vec3::Zero();
  /// Deviation of the Gaussian that edges of full height would be blurred by, sigma_mm taken off; >= 0.
  double blur_mm(const SharpnessOptions& options = {}) const;
};

/// Within `within_mm` of the points (of arteries' axes, a millimetre or so apart; LPS, mm) or, where there
/// are none, where the heart lies in a chest: the middle 60 % from side to side, 15 to 70 % from front to
/// back. The same for any number of threads. Throws InvalidInput for an image below 3 voxels a side or points
/// that all lie outside of it, Cancelled.
EdgeSharpness edge_sharpness(const imaging::ImageVolume& image, const std::vector<Vec3>& points_mm,
                             const SharpnessOptions& options = {},
                             const core::TaskContext& task = core::no_task());

/// The commonest value above 200 HU where the heart lies: blood with contrast. Nothing where there is no peak
/// of at least 1 % of the voxels.
std::optional<double> blood_level_hu(const imaging::ImageVolume& image);

/// Why a phase is not compared with the others.
enum class LeftOut {
  none,
  not_measured,  ///< it could not be read
  no_edges,      ///< nothing there between fat and blood: a flat image
  lost_edges,    ///< below half of the edges that the phases have (median)
  noisy,         ///< above two and a half times the phases' noise (median): its gradients are noise
  other_voxels,  ///< spacing off by more than a tenth: another reconstruction is sharper or not by itself
  elsewhere      ///< below 95 % of the points lie in it
};

/// Which phase to read.
struct BestPhase {
  std::optional<std::size_t> best;    ///< nothing where fewer than two can be compared
  std::vector<std::size_t> as_sharp;  ///< others that are within the tie of the sharpest, ascending
  std::vector<LeftOut> left_out;      ///< of each phase
  std::vector<double> share;          ///< of the sharpest, (0, 1]; 0 for what is left out
};
/// Phases whose sharpness is within `tie_share` of the sharpest are as sharp as it; of these `on_table` is
/// proposed if it is among them, else the sharpest, the first of several. Voxels are compared with those of
/// `on_table`, or with their median. Throws InvalidInput for `on_table` out of range or a tie outside of
/// [0, 0.5].
BestPhase best_phase(const std::vector<std::optional<EdgeSharpness>>& phases,
                     std::optional<std::size_t> on_table = {}, double tie_share = 0.01);

}  // namespace ostia::evaluation
