#include "scan/point_spread.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::phantom {
namespace {

using Row = Eigen::Map<Eigen::ArrayXf, Eigen::Unaligned>;
using ConstRow = Eigen::Map<const Eigen::ArrayXf, Eigen::Unaligned>;
using Eight = Eigen::Array<float, 8, 1>;

double normal_cdf(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// Copies a row with its border repeated `reach` times.
void copy_with_border(const float* row, std::ptrdiff_t n, int reach, std::vector<float>& out) {
  out.resize(static_cast<std::size_t>(n + 2 * reach));
  std::fill_n(out.begin(), reach, row[0]);
  std::copy_n(row, n, out.begin() + reach);
  std::fill_n(out.begin() + reach + n, reach, row[n - 1]);
}

}  // namespace

AxisSpread::AxisSpread(double fwhm_mm, double spacing_mm, int parts) : parts_(parts) {
  const double piece_mm = spacing_mm / parts;
  // The box of a piece has variance w^2 / 12 and is part of what is seen.
  const double sigma = fwhm_mm / fwhm_per_sigma;
  const double rest = sigma * sigma - piece_mm * piece_mm / 12.0;
  if (fwhm_mm <= 0.0 || rest <= 0.0) {
    pieces_.assign(static_cast<std::size_t>(parts), 1.0f / static_cast<float>(parts));
    voxels_ = {1.0f};
    return;
  }
  const double gauss = std::sqrt(rest);
  reach_ = std::max(1, static_cast<int>(std::ceil(3.2 * sigma / spacing_mm - 0.5)));
  std::vector<double> weights;
  double sum = 0.0;
  for (int offset = -reach_; offset <= reach_; ++offset) {
    for (int part = 0; part < parts; ++part) {
      const double at = spacing_mm * offset + piece_mm * (part - 0.5 * (parts - 1));
      // The piece's middle alone, not its integral: the box was taken off the variance.
      weights.push_back(std::exp(-0.5 * at * at / (gauss * gauss)));
      sum += weights.back();
    }
  }
  // Coarse pieces sample the Gaussian too sparsely: there its integral is the better weight.
  if (gauss < 0.6 * piece_mm) {
    sum = 0.0;
    std::size_t index = 0;
    for (int offset = -reach_; offset <= reach_; ++offset) {
      for (int part = 0; part < parts; ++part, ++index) {
        const double at = spacing_mm * offset + piece_mm * (part - 0.5 * (parts - 1));
        weights[index] =
            normal_cdf((at + 0.5 * piece_mm) / gauss) - normal_cdf((at - 0.5 * piece_mm) / gauss);
        sum += weights[index];
      }
    }
  }
  for (std::size_t v = 0; v < weights.size(); v += static_cast<std::size_t>(parts)) {
    double voxel = 0.0;
    for (std::size_t p = 0; p < static_cast<std::size_t>(parts); ++p) {
      pieces_.push_back(static_cast<float>(weights[v + p] / sum));
      voxel += weights[v + p] / sum;
    }
    voxels_.push_back(static_cast<float>(voxel));
  }
}

PointSpread::PointSpread(AxisSpread x, AxisSpread y, AxisSpread z)
    : x_(std::move(x)), y_(std::move(y)), z_(std::move(z)) {
  lanes_ = 8 * ((2 * x_.reach() + 1 + 7) / 8);
  x_lanes_.assign(static_cast<std::size_t>(lanes_ * x_.parts()), 0.0f);
  // The output at voxel + d sees the voxel at offset -d.
  for (int part = 0; part < x_.parts(); ++part) {
    for (int d = -x_.reach(); d <= x_.reach(); ++d)
      x_lanes_[static_cast<std::size_t>(part * lanes_ + d + x_.reach())] = x_.piece(-d, part);
  }
  for (int d = -y_.reach(); d <= y_.reach(); ++d) {
    for (int part = 0; part < y_.parts(); ++part) y_weights_.push_back(y_.piece(-d, part));
  }
}

void PointSpread::blur_in_plane(const SliceView& slice) const {
  const std::ptrdiff_t w = slice.width, h = slice.height;
  if (x_.reach() > 0) {
    std::vector<float> padded;
    for (std::ptrdiff_t j = 0; j < h; ++j) {
      copy_with_border(slice.row(j), w, x_.reach(), padded);
      const float* centre = padded.data() + x_.reach();
      Row out(slice.row(j), w);
      out = x_.voxel(0) * ConstRow(centre, w);
      for (int d = 1; d <= x_.reach(); ++d)
        out += x_.voxel(d) * (ConstRow(centre - d, w) + ConstRow(centre + d, w));
    }
  }
  if (y_.reach() == 0) return;
  // Column strips keep what is read again in the cache.
  constexpr std::ptrdiff_t strip = 64;
  std::vector<float> columns(static_cast<std::size_t>((h + 2 * y_.reach()) * strip));
  for (std::ptrdiff_t i0 = 0; i0 < w; i0 += strip) {
    const std::ptrdiff_t n = std::min(strip, w - i0);
    for (std::ptrdiff_t j = -y_.reach(); j < h + y_.reach(); ++j)
      std::copy_n(slice.row(std::clamp<std::ptrdiff_t>(j, 0, h - 1)) + i0, n,
                  columns.begin() + (j + y_.reach()) * strip);
    for (std::ptrdiff_t j = 0; j < h; ++j) {
      const float* centre = columns.data() + (j + y_.reach()) * strip;
      Row out(slice.row(j) + i0, n);
      out = y_.voxel(0) * ConstRow(centre, n);
      for (int d = 1; d <= y_.reach(); ++d)
        out += y_.voxel(d) * (ConstRow(centre - d * strip, n) + ConstRow(centre + d * strip, n));
    }
  }
}

void PointSpread::add_pieces(const Pieces& voxel, int offset, const SliceView& slice) const {
  constexpr int most = 8;
  const int n = x_.parts();
  float plane[most * most];
  std::fill_n(plane, n * n, 0.0f);
  for (int pz = 0; pz < n; ++pz) {
    const float w = z_.piece(offset, pz);
    const float* from = voxel.difference + pz * n * n;
    for (int p = 0; p < n * n; ++p) plane[p] += w * from[p];
  }
  const int rows = 2 * y_.reach() + 1;
  for (int d = 0; d < rows; ++d) {
    float row[most] = {};
    const float* weights = y_weights_.data() + d * n;
    for (int py = 0; py < n; ++py)
      for (int px = 0; px < n; ++px) row[px] += weights[py] * plane[py * n + px];
    float* out = slice.row(voxel.j + d - y_.reach()) + voxel.i - x_.reach();
    for (int lane = 0; lane < lanes_; lane += 8) {
      Eight sum = Eight::Zero();
      for (int px = 0; px < n; ++px)
        sum += row[px] * Eigen::Map<const Eight, Eigen::Unaligned>(x_lanes_.data() + px * lanes_ + lane);
      Eigen::Map<Eight, Eigen::Unaligned>(out + lane) += sum;
    }
  }
}

}  // namespace ostia::phantom
