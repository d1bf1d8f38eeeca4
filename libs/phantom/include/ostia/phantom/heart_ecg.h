#pragma once
/// \file A synthetic electrocardiogram with its R peaks.

#include "ostia/geometry/ecg_record.h"

#include <cstdint>
#include <vector>

namespace ostia::phantom {

struct EcgOptions {
  double seconds = 60.0;            ///< in [2, 3600]
  double samples_per_second = 360;  ///< in [100, 10000]
  double noise_mv = 0.008;          ///< deviation, in [0, 1]
  double breathing_per_min = 15.0;  ///< in [4, 60]
};

struct HeartEcg {
  geometry::EcgRecord record;            ///< leads II and V5, mV
  std::vector<geometry::EcgBeat> beats;  ///< all normal, at the top of each R wave
};

/// P, Q, R, S and T as Gaussians about each R peak, as the model of McSharry et al. 2003 has them; the RR
/// interval varies with breath (3 %), with the Mayer waves of 0.1 Hz (2 %) and by chance (1 %). The same
/// samples for the same seed. Throws InvalidInput for a rate outside [20, 240] a minute or options out of
/// range.
HeartEcg draw_ecg(double heart_rate_per_min, std::uint64_t seed, const EcgOptions& options = {});

}  // namespace ostia::phantom
