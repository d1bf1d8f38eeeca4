#include "scan/slice_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {

CoarseSlice::CoarseSlice(const SliceView& slice, const geometry::Vec3& spacing, double cell_mm,
                         const std::function<double(float)>& value) {
  step_x = std::max<std::ptrdiff_t>(1, std::lround(cell_mm / spacing.x()));
  step_y = std::max<std::ptrdiff_t>(1, std::lround(cell_mm / spacing.y()));
  cell_mm_x = spacing.x() * static_cast<double>(step_x);
  cell_mm_y = spacing.y() * static_cast<double>(step_y);
  width = (slice.width + step_x - 1) / step_x;
  height = (slice.height + step_y - 1) / step_y;
  values.assign(static_cast<std::size_t>(width * height), 0.0);
  std::vector<double> counts(values.size(), 0.0);
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const auto cell = static_cast<std::size_t>(i / step_x + width * (j / step_y));
      values[cell] += value(slice.row(j)[i]);
      counts[cell] += 1.0;
    }
  }
  for (std::size_t c = 0; c < counts.size(); ++c) values[c] /= counts[c];
}

void CoarseSlice::add_to(const SliceView& slice, double scale) const {
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    const double y = std::clamp((static_cast<double>(j) + 0.5) / static_cast<double>(step_y) - 0.5, 0.0,
                                static_cast<double>(height - 1));
    const auto j0 = std::min(static_cast<std::ptrdiff_t>(y), std::max<std::ptrdiff_t>(height - 2, 0));
    const std::ptrdiff_t j1 = std::min(j0 + 1, height - 1);
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const double x = std::clamp((static_cast<double>(i) + 0.5) / static_cast<double>(step_x) - 0.5, 0.0,
                                  static_cast<double>(width - 1));
      const auto i0 = std::min(static_cast<std::ptrdiff_t>(x), std::max<std::ptrdiff_t>(width - 2, 0));
      const std::ptrdiff_t i1 = std::min(i0 + 1, width - 1);
      const double fx = x - static_cast<double>(i0), fy = y - static_cast<double>(j0);
      const auto at = [&](std::ptrdiff_t ci, std::ptrdiff_t cj) {
        return values[static_cast<std::size_t>(ci + width * cj)];
      };
      const double value = (1.0 - fy) * ((1.0 - fx) * at(i0, j0) + fx * at(i1, j0)) +
                           fy * ((1.0 - fx) * at(i0, j1) + fx * at(i1, j1));
      slice.row(j)[i] += static_cast<float>(scale * value);
    }
  }
}

SliceDetector::SliceDetector(const CoarseSlice& slice) {
  bin_mm_ = std::min(slice.cell_mm_x, slice.cell_mm_y);
  const double across = std::hypot(slice.cell_mm_x * static_cast<double>(slice.width),
                                   slice.cell_mm_y * static_cast<double>(slice.height));
  bins_ = static_cast<std::size_t>(std::ceil(across / bin_mm_)) + 4;
  middle_ = 0.5 * static_cast<double>(bins_ - 1);
}

void SliceDetector::turn_to(double angle) {
  cos_ = std::cos(angle);
  sin_ = std::sin(angle);
}

/// Where a square is seen.
double SliceDetector::bin(const CoarseSlice& slice, std::ptrdiff_t i, std::ptrdiff_t j) const {
  const double x = (static_cast<double>(i) - 0.5 * static_cast<double>(slice.width - 1)) * slice.cell_mm_x;
  const double y = (static_cast<double>(j) - 0.5 * static_cast<double>(slice.height - 1)) * slice.cell_mm_y;
  return (x * cos_ + y * sin_) / bin_mm_ + middle_;
}

std::vector<double> SliceDetector::projection(const CoarseSlice& slice) const {
  std::vector<double> out(bins_, 0.0);
  const double area = slice.cell_mm_x * slice.cell_mm_y / bin_mm_;
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const double value = slice.values[static_cast<std::size_t>(i + slice.width * j)];
      if (value <= 0.0) continue;
      const double at = bin(slice, i, j);
      const auto low = static_cast<std::size_t>(at);
      const double part = at - static_cast<double>(low);
      out[low] += (1.0 - part) * value * area;
      out[low + 1] += part * value * area;
    }
  }
  return out;
}

std::vector<double> SliceDetector::ramp_filtered(const std::vector<double>& projection) const {
  const auto n = static_cast<std::ptrdiff_t>(projection.size());
  std::vector<double> result(projection.size(), 0.0);
  const double pi2 = std::numbers::pi * std::numbers::pi;
  for (std::ptrdiff_t a = 0; a < n; ++a) {
    double sum = 0.25 * projection[static_cast<std::size_t>(a)];
    for (std::ptrdiff_t b = (a + 1) % 2; b < n; b += 2) {
      const auto d = static_cast<double>(a - b);
      sum -= projection[static_cast<std::size_t>(b)] / (pi2 * d * d);
    }
    result[static_cast<std::size_t>(a)] = sum / bin_mm_;
  }
  return result;
}

void SliceDetector::back_project(const std::vector<double>& view, int views, CoarseSlice& slice) const {
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const double at = bin(slice, i, j);
      const auto low = static_cast<std::size_t>(at);
      const double part = at - static_cast<double>(low);
      slice.values[static_cast<std::size_t>(i + slice.width * j)] +=
          ((1.0 - part) * view[low] + part * view[low + 1]) * std::numbers::pi / views;
    }
  }
}

}  // namespace ostia::phantom
