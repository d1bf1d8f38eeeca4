#pragma once
/// \file How well mixtures of lumen, layers of the wall and fat explain the samples of a ray, for many places
/// of the wall's outer border at once; compiled for two instruction sets, with the same bits.

namespace ostia::segmentation::detail {

constexpr int wall_samples = 11, wall_parts = 10, wall_candidates = 24, most_wall_directions = 7;

/// The samples of the parts that a ray is mixed of, whitened, of several candidates beside each other. A part
/// of all candidates alike is there for each of them.
struct WallSamples {
  double value[wall_parts][wall_samples][wall_candidates] = {};
};

/// What lies within part `outer` and not within part `inner` (negative: all of `outer`): its level, and the
/// level's normal deviation.
struct WallDirection {
  int outer = 0, inner = -1;
  double hu = 0.0, spread = 0.0;
};
struct WallMixture {
  int count = 0;
  WallDirection direction[most_wall_directions] = {};
};

/// Of the samples `ray_part`, for the first `count` candidates: what the mixture leaves over, squared, once
/// deviations along its directions are integrated out, and the determinant that comes with it (1 without
/// directions). Both have room for `wall_candidates`.
using WallLoop = void (*)(const WallSamples& samples, int ray_part, int count, const WallMixture* mixtures,
                          int mixture_count, double (*square)[wall_candidates],
                          double (*determinant)[wall_candidates]);

WallLoop wall_loop();  ///< for this processor
WallLoop wall_loop_plain();
WallLoop wall_loop_avx2();  ///< for processors that have it

}  // namespace ostia::segmentation::detail
