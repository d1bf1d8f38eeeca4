#pragma once
/// \file Smoothing of surfaces without shrinkage.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::geometry {

struct TaubinOptions {
  int iterations = 30;     ///< pairs of a shrinking and an inflating step, >= 0
  double pass_band = 0.1;  ///< k_PB of Taubin 1995, in (0, 2): the smaller, the smoother
  double lambda = 0.33;    ///< weight of the shrinking step, in (0, 1); the inflating one follows from k_PB =
                           ///< 1/lambda + 1/mu
};
/// Throws InvalidInput out of range, and where the two would make the roughest ripples grow.
void validate(const TaubinOptions& options);

/// Taubin's lambda|mu filter (1995; [Antiga] 3.3) with equal weights for all neighbours. Border points stay.
/// Connectivity is kept. Throws InvalidInput for points that are not finite, Cancelled within one iteration.
TriMesh taubin_smoothed(const TriMesh& mesh, const TaubinOptions& options = {},
                        const core::TaskContext& task = core::no_task());

struct VolumeSmoothingOptions {
  TaubinOptions filter;
  std::vector<bool> free;     ///< one a point: which may move; empty: all
  bool borders_move = false;  ///< points of a border follow their neighbours on it; else they stay
  int restoring_rounds = 3;   ///< >= 0
  int mean_rings = 10;        ///< over so many rings of points a distance is averaged, > 0
};
void validate(const VolumeSmoothingOptions& options);

/// Taubin's filter, and then each inner point moves along its normal by what the filter has moved its
/// surroundings in the mean: a vessel of few triangles around, which the filter alone makes thinner or wider,
/// keeps its calibre, and the surface its volume. Throws as taubin_smoothed, and InvalidInput where `free`
/// has another length.
TriMesh smoothed_in_volume(const TriMesh& mesh, const VolumeSmoothingOptions& options = {},
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::geometry
