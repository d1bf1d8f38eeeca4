#pragma once
/// \file How improbable the samples of a ray are under many hypotheses at once; compiled for two instruction
/// sets, with the same bits.

namespace ostia::segmentation::detail {

constexpr int edge_samples = 11, edge_lanes = 8;

/// Normal distributions of a ray's samples, beside each other: the mean without the lumen's share, the
/// inverse of the covariance's lower Cholesky factor row by row, and what is added to half the square of a
/// deviation.
struct EdgeNormals {
  float mean[edge_samples][edge_lanes] = {};
  float whitening[edge_samples * (edge_samples + 1) / 2][edge_lanes] = {};
  float offset[edge_lanes] = {};
};

/// Of samples whose lumen's share is known, under `count` times `edge_lanes` distributions, in their order.
using EdgeLoop = void (*)(const EdgeNormals* normals, int count, const float* samples, const float* lumen,
                          float* energy);

EdgeLoop edge_loop();  ///< for this processor
EdgeLoop edge_loop_plain();
EdgeLoop edge_loop_avx2();  ///< for processors that have it

}  // namespace ostia::segmentation::detail
