// The loop of edge_loops.h for the instruction set that the including file is compiled for. No multiplication
// is fused with an addition, so that all of them give the same bits. Everything here is local to its file: no
// code for a newer processor may reach the others.

#include "boundary/edge_loops.h"

#include "ostia/core/simd.h"

namespace ostia::segmentation::detail::edge_rows {
namespace {

using core::simd::all;
using core::simd::load;
using core::simd::store;
using Pack = core::simd::FloatPack;
constexpr int lanes = static_cast<int>(core::simd::float_pack_size);
static_assert(edge_lanes % lanes == 0);

void edge_loop_here(const EdgeNormals* normals, int count, const float* samples, const float* lumen,
                    float* energy) {
  for (int n = 0; n < count; ++n)
    for (int lane = 0; lane < edge_lanes; lane += lanes) {
      const EdgeNormals& of = normals[n];
      Pack off[edge_samples];
      for (int i = 0; i < edge_samples; ++i)
        off[i] = all(samples[i]) - load(of.mean[i] + lane) - all(lumen[i]);
      Pack sum = all(0.0F);
      for (int i = 0, at = 0; i < edge_samples; ++i) {
        Pack white = all(0.0F);
        for (int j = 0; j <= i; ++j, ++at) white = white + load(of.whitening[at] + lane) * off[j];
        sum = sum + white * white;
      }
      store(energy + n * edge_lanes + lane, all(0.5F) * sum + load(of.offset + lane));
    }
}

}  // namespace
}  // namespace ostia::segmentation::detail::edge_rows
