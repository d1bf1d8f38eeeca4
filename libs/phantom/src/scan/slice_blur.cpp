#include "scan/slice_blur.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

using BlurRow = Eigen::Map<Eigen::ArrayXf, Eigen::Unaligned>;
using ConstBlurRow = Eigen::Map<const Eigen::ArrayXf, Eigen::Unaligned>;

}  // namespace

std::vector<double> gaussian_weights(double sigma_voxels) {
  if (sigma_voxels < 0.05) return {1.0};
  std::vector<double> weights;
  double sum = 0.0;
  for (int n = 0; n <= static_cast<int>(std::ceil(3.3 * sigma_voxels)); ++n) {
    weights.push_back(std::exp(-0.5 * n * n / (sigma_voxels * sigma_voxels)));
    sum += n == 0 ? weights.back() : 2.0 * weights.back();
  }
  for (double& w : weights) w /= sum;
  return weights;
}

std::vector<float> blurred(const SliceView& slice, const std::array<double, 2>& sigma_voxels) {
  const std::ptrdiff_t w = slice.width, h = slice.height;
  const std::vector<double> x = gaussian_weights(sigma_voxels[0]), y = gaussian_weights(sigma_voxels[1]);
  const auto room = static_cast<std::ptrdiff_t>(x.size()) - 1;
  std::vector<float> across(static_cast<std::size_t>(w * h)), out(across.size());
  std::vector<float> padded(static_cast<std::size_t>(w + 2 * room));
  for (std::ptrdiff_t j = 0; j < h; ++j) {
    const float* from = slice.row(j);
    std::fill_n(padded.begin(), room, from[0]);
    std::copy_n(from, w, padded.begin() + room);
    std::fill_n(padded.begin() + room + w, room, from[w - 1]);
    BlurRow to(across.data() + j * w, w);
    to = static_cast<float>(x[0]) * ConstBlurRow(padded.data() + room, w);
    for (std::ptrdiff_t d = 1; d <= room; ++d)
      to += static_cast<float>(x[static_cast<std::size_t>(d)]) *
            (ConstBlurRow(padded.data() + room - d, w) + ConstBlurRow(padded.data() + room + d, w));
  }
  for (std::ptrdiff_t j = 0; j < h; ++j) {
    const auto from = [&](std::ptrdiff_t row) {
      return ConstBlurRow(across.data() + std::clamp<std::ptrdiff_t>(row, 0, h - 1) * w, w);
    };
    BlurRow to(out.data() + j * w, w);
    to = static_cast<float>(y[0]) * from(j);
    for (std::size_t d = 1; d < y.size(); ++d) {
      const auto n = static_cast<std::ptrdiff_t>(d);
      to += static_cast<float>(y[d]) * (from(j - n) + from(j + n));
    }
  }
  return out;
}

}  // namespace ostia::phantom
