#pragma once
/// \file Pictures made of straight rows, thin or of a layer, in parallel.

#include "row_loops.h"
#include "row_sampler.h"

#include "ostia/core/parallel.h"
#include "ostia/core/task_context.h"
#include "ostia/reformat/slab.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ostia::reformat {

/// A row of a picture: where its first pixel's centre lies, the step to the next, and the unit direction in
/// which a layer extends.
struct StraightRow {
  Vec3 start, step, across;
};

struct SlabShape {
  Slab slab = Slab::none;
  double thickness_mm = 0.0;
  double layer_spacings = 0.5;  ///< of the image's finest spacing a layer has at most
};

/// Offsets of the middles of equal layers.
inline std::vector<double> layer_offsets(const SlabShape& shape, const imaging::Geometry& grid) {
  if (shape.slab == Slab::none) return {0.0};
  const double finest = shape.layer_spacings * grid.spacing.minCoeff();
  const int count = std::max(1, static_cast<int>(std::ceil(shape.thickness_mm / finest - 1e-9)));
  std::vector<double> offsets;
  for (int i = 0; i < count; ++i) offsets.push_back(shape.thickness_mm * ((i + 0.5) / count - 0.5));
  return offsets;
}

/// `row_of(j)` gives the StraightRow of row j.
template <class T, class RowOf>
std::vector<float> sampled_rows(const imaging::Volume<T>& image, std::size_t width, std::size_t height,
                                const RowOf& row_of, const SlabShape& shape, imaging::Interpolation how,
                                const core::TaskContext& task) {
  const RowSampler<T> sampler(image, how);
  const std::vector<double> offsets = layer_offsets(shape, image.geometry);
  const FoldLoop fold = shape.slab == Slab::minimum ? row_loops().smaller : row_loops().larger;
  std::vector<float> values(width * height);
  core::parallel_chunks(height, 8, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    std::vector<float> layer(offsets.size() > 1 ? width : 0), count(layer.size());
    for (std::size_t j = first; j < last; ++j) {
      const StraightRow row = row_of(j);
      const std::span<float> out(values.data() + j * width, width);
      sampler.row(row.start + offsets[0] * row.across, row.step, out);
      if (offsets.size() == 1) continue;
      const bool mean = shape.slab == Slab::mean;
      for (std::size_t i = 0; i < width && mean; ++i) {
        count[i] = std::isnan(out[i]) ? 0.0F : 1.0F;
        if (std::isnan(out[i])) out[i] = 0.0F;
      }
      for (std::size_t l = 1; l < offsets.size(); ++l) {
        sampler.row(row.start + offsets[l] * row.across, row.step, layer);
        for (std::size_t i = 0; i < width && mean; ++i) {
          if (std::isnan(layer[i])) continue;
          out[i] += layer[i];
          count[i] += 1.0F;
        }
        if (!mean) fold(layer.data(), static_cast<std::int64_t>(width), out.data());
      }
      for (std::size_t i = 0; i < width && mean; ++i) out[i] /= count[i];  // 0 / 0: no layer in the image
    }
  });
  return values;
}

}  // namespace ostia::reformat
