#pragma once
/// \file A closed surface scanned in silico: filled with one signal, in another one, as CT or MR shows it.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"

#include <array>
#include <cstdint>

namespace ostia::experiments {

/// How one axis of the scan blurs what is there.
struct AxisResponse {
  enum class Kind {
    gaussian,  ///< line-spread function of `width_mm` full width at half maximum
    k_space    ///< only frequencies below 1 / (2 `width_mm`), sharply cut (so with Gibbs' ringing), on a
               ///< period of the whole axis: what zero-filling makes of samples `width_mm` apart
  };
  Kind kind = Kind::gaussian;
  double width_mm = 0.7;
};

struct SurfaceScanOptions {
  imaging::Geometry grid;
  std::array<AxisResponse, 3> response;  ///< along the grid's axes
  double inside = 350.0, outside = 50.0;
  /// Standard deviation in the finished image; correlated as the response is. In a magnitude image that of
  /// each of the two channels.
  double noise = 0.0;
  bool magnitude = false;  ///< MR: the length of signal and noise in two channels, never below 0
  double fine_mm = 0.1;    ///< lines through the surface are no further apart, (0, 1]
  std::uint64_t seed = 1;
};
void validate(const SurfaceScanOptions& options);  ///< throws InvalidInput

/// The surface's inside convolved with the three responses, which is what a linear scanner shows of it: the
/// share along the grid's first axis is exact (chords times the integral of the response), across it a
/// midpoint rule on lines `fine_mm` apart. Noise is white, passed through the same response. Throws
/// InvalidInput for a surface with open edges; Cancelled.
imaging::ImageVolume scan_surface(const geometry::TriMesh& closed, const SurfaceScanOptions& options,
                                  const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
