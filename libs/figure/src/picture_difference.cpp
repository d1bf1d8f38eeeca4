#include "ostia/figure/picture_difference.h"

#include "ostia/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace ostia::figure {
namespace {

using Plane = std::vector<float>;
using Planes = std::array<Plane, 3>;
using Matrix = std::array<std::array<double, 3>, 3>;

// IEC 61966-2-1: linear sRGB to XYZ, white D65 at Y = 1.
constexpr Matrix xyz_of_rgb{{{0.4124564, 0.3575761, 0.1804375},
                             {0.2126729, 0.7151522, 0.0721750},
                             {0.0193339, 0.1191920, 0.9503041}}};
constexpr std::array<double, 3> white{0.95047, 1.0, 1.08883};
// Poirson and Wandell: achromatic, red-green, blue-yellow.
constexpr Matrix opponent_of_xyz{{{0.279, 0.720, -0.107}, {-0.449, 0.290, -0.077}, {0.086, -0.590, 0.501}}};

struct Lobe {
  double weight, spread_deg;
};
constexpr std::array<Lobe, 3> achromatic{{{0.921, 0.0283}, {0.105, 0.133}, {-0.108, 4.336}}};
constexpr std::array<Lobe, 2> red_green{{{0.531, 0.0392}, {0.330, 0.494}}};
constexpr std::array<Lobe, 2> blue_yellow{{{0.488, 0.0536}, {0.371, 0.386}}};
constexpr double support_deg = 0.5;
constexpr double negligible = 3.0;  // spreads: exp(-9) of the middle

Matrix inverse(const Matrix& m) {
  Matrix out{};
  double determinant = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t c = (j + 1) % 3, d = (j + 2) % 3;
      out[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
    determinant += m[0][i] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]);
  }
  for (auto& row : out)
    for (double& value : row) value /= determinant;
  return out;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}

std::array<double, 256> linear_levels() {
  std::array<double, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double v = static_cast<double>(i) / 255.0;
    table[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  return table;
}

Planes opponents(const Raster& raster) {
  static const std::array<double, 256> linear = linear_levels();
  static const Matrix m = product(opponent_of_xyz, xyz_of_rgb);
  const std::size_t count = static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height);
  Planes out{Plane(count), Plane(count), Plane(count)};
  for (std::size_t p = 0; p < count; ++p) {
    const std::uint8_t* at = raster.rgba.data() + 4 * p;
    const double opacity = at[3] / 255.0;
    const std::array<double, 3> rgb{linear[at[0]] * opacity, linear[at[1]] * opacity,
                                    linear[at[2]] * opacity};
    for (std::size_t c = 0; c < 3; ++c)
      out[c][p] = static_cast<float>(m[c][0] * rgb[0] + m[c][1] * rgb[1] + m[c][2] * rgb[2]);
  }
  return out;
}

std::vector<float> kernel(double spread_px, double support_px) {
  const int radius = std::max(1, static_cast<int>(std::ceil(std::min(support_px, negligible * spread_px))));
  std::vector<float> taps;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    const double value = std::exp(-(i / spread_px) * (i / spread_px));
    taps.push_back(static_cast<float>(value));
    sum += value;
  }
  for (float& tap : taps) tap = static_cast<float>(tap / sum);
  return taps;
}

/// Along the rows, and turned: twice gives the whole blur. Beyond the edges lies the edge.
Plane blurred_and_turned(const Plane& plane, int width, int height, const std::vector<float>& taps) {
  const int radius = static_cast<int>(taps.size()) / 2;
  Plane out(plane.size());
  std::vector<float> row(static_cast<std::size_t>(width + 2 * radius));
  for (int y = 0; y < height; ++y) {
    const float* from = plane.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int x = -radius; x < width + radius; ++x)
      row[static_cast<std::size_t>(x + radius)] = from[std::clamp(x, 0, width - 1)];
    for (int x = 0; x < width; ++x) {
      float sum = 0.0F;
      for (std::size_t k = 0; k < taps.size(); ++k) sum += taps[k] * row[static_cast<std::size_t>(x) + k];
      out[static_cast<std::size_t>(x) * static_cast<std::size_t>(height) + static_cast<std::size_t>(y)] = sum;
    }
  }
  return out;
}

Plane seen(const Plane& plane, int width, int height, std::span<const Lobe> lobes, double pixels_per_degree) {
  double weights = 0.0;
  for (const Lobe& lobe : lobes) weights += lobe.weight;
  Plane out(plane.size(), 0.0F);
  for (const Lobe& lobe : lobes) {
    const auto taps = kernel(lobe.spread_deg * pixels_per_degree, support_deg * pixels_per_degree);
    const Plane part =
        blurred_and_turned(blurred_and_turned(plane, width, height, taps), height, width, taps);
    const float share = static_cast<float>(lobe.weight / weights);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += share * part[i];
  }
  return out;
}

double lab_function(double t) {
  constexpr double d = 6.0 / 29.0;
  return t > d * d * d ? std::cbrt(t) : t / (3.0 * d * d) + 4.0 / 29.0;
}

/// The planes become L*, a*, b*.
void to_lab(Planes& planes) {
  static const Matrix back = inverse(opponent_of_xyz);
  for (std::size_t p = 0; p < planes[0].size(); ++p) {
    std::array<double, 3> f{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = back[c][0] * planes[0][p] + back[c][1] * planes[1][p] + back[c][2] * planes[2][p];
      f[c] = lab_function(std::max(0.0, value / white[c]));
    }
    planes[0][p] = static_cast<float>(116.0 * f[1] - 16.0);
    planes[1][p] = static_cast<float>(500.0 * (f[0] - f[1]));
    planes[2][p] = static_cast<float>(200.0 * (f[1] - f[2]));
  }
}

Planes seen_lab(const Raster& raster, double pixels_per_degree) {
  Planes planes = opponents(raster);
  const auto see = [&](std::size_t channel, std::span<const Lobe> lobes) {
    planes[channel] = seen(planes[channel], raster.width, raster.height, lobes, pixels_per_degree);
  };
  see(0, achromatic);
  see(1, red_green);
  see(2, blue_yellow);
  to_lab(planes);
  return planes;
}

void find_worst(PictureDifference& found, int block_px) {
  const auto columns = static_cast<std::size_t>(found.width) + 1;
  std::vector<double> sums(columns * (static_cast<std::size_t>(found.height) + 1), 0.0);
  const auto at = [&](int x, int y) -> double& {
    return sums[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < found.height; ++y)
    for (int x = 0; x < found.width; ++x)
      at(x + 1, y + 1) =
          at(x, y + 1) + at(x + 1, y) - at(x, y) +
          static_cast<double>(
              found.delta_e[static_cast<std::size_t>(y) * (columns - 1) + static_cast<std::size_t>(x)]);
  found.mean = at(found.width, found.height) / (static_cast<double>(found.width) * found.height);
  const int step = std::max(1, block_px / 2);
  for (int y = 0; y < found.height; y += step)
    for (int x = 0; x < found.width; x += step) {
      const int right = std::min(x + block_px, found.width), bottom = std::min(y + block_px, found.height);
      const double sum = at(right, bottom) - at(x, bottom) - at(right, y) + at(x, y);
      const double mean = sum / (static_cast<double>(right - x) * (bottom - y));
      if (mean <= found.worst) continue;
      found.worst = mean;
      found.worst_x = x;
      found.worst_y = y;
    }
}

void check(const Raster& raster, const char* which) {
  const std::size_t bytes = 4 * static_cast<std::size_t>(std::max(0, raster.width)) *
                            static_cast<std::size_t>(std::max(0, raster.height));
  if (bytes == 0 || raster.rgba.size() != bytes)
    throw InvalidInput(
        fmt::format("picture_difference: the {} picture has {} x {} pixels and {} bytes; give "
                    "one with at least a pixel and four bytes for each",
                    which, raster.width, raster.height, raster.rgba.size()));
}

}  // namespace

void DifferenceOptions::validate() const {
  if (!(pixels_per_degree >= 4.0 && pixels_per_degree <= 400.0))
    throw InvalidInput(
        fmt::format("picture_difference: {} pixels per degree; give 4 to 400", pixels_per_degree));
  if (block_px < 1 || block_px > 1024)
    throw InvalidInput(fmt::format("picture_difference: blocks of {} pixels; give 1 to 1024", block_px));
}

PictureDifference picture_difference(const Raster& one, const Raster& other,
                                     const DifferenceOptions& options) {
  options.validate();
  check(one, "first");
  check(other, "second");
  if (one.width != other.width || one.height != other.height)
    throw InvalidInput(
        fmt::format("picture_difference: {} x {} pixels are held against {} x {}; both pictures "
                    "must have one size",
                    one.width, one.height, other.width, other.height));
  PictureDifference found{one.width, one.height, {}, 0.0, 0.0, 0, 0};
  found.delta_e.resize(one.rgba.size() / 4, 0.0F);
  if (one.rgba == other.rgba) return found;
  const Planes a = seen_lab(one, options.pixels_per_degree), b = seen_lab(other, options.pixels_per_degree);
  for (std::size_t p = 0; p < found.delta_e.size(); ++p)
    found.delta_e[p] = std::hypot(a[0][p] - b[0][p], a[1][p] - b[1][p], a[2][p] - b[2][p]);
  find_worst(found, options.block_px);
  return found;
}

Raster difference_picture(const Raster& picture, const PictureDifference& difference, double full) {
  check(picture, "shown");
  if (picture.width != difference.width || picture.height != difference.height)
    throw InvalidInput(
        fmt::format("difference_picture: a picture of {} x {} pixels and a difference of {} x {}",
                    picture.width, picture.height, difference.width, difference.height));
  if (!(full > 0.0))
    throw InvalidInput(fmt::format("difference_picture: full red at {}; give more than 0", full));
  Raster out = picture;
  for (std::size_t p = 0; p < difference.delta_e.size(); ++p) {
    std::uint8_t* at = out.rgba.data() + 4 * p;
    const double faint = 64.0 + (0.30 * at[0] + 0.59 * at[1] + 0.11 * at[2]) / 4.0;
    const double red = std::min(1.0, static_cast<double>(difference.delta_e[p]) / full);
    at[0] = static_cast<std::uint8_t>(std::lround(faint + red * (255.0 - faint)));
    at[1] = at[2] = static_cast<std::uint8_t>(std::lround(faint * (1.0 - red)));
    at[3] = 255;
  }
  return out;
}

}  // namespace ostia::figure
