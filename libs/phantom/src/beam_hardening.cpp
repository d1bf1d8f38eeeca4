#include "artefacts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

constexpr double coarse_mm = 1.5;        // streaks are smooth: the model needs no more
constexpr int angles = 120;              // over half a turn
constexpr double dense_from_hu = 130.0;  // softer tissue is corrected for in the scanner
constexpr double most_hu = 1500.0;       // metal would need another model
constexpr double water_per_mm = 0.0195;  // attenuation of water at 70 keV
constexpr double second_order = 0.2;     // share of the projection's square that is missing (usual value)

/// A slice in squares of about `coarse_mm`.
struct Coarse {
  std::ptrdiff_t width = 0, height = 0, step_x = 1, step_y = 1;
  double cell_mm_x = 1.0, cell_mm_y = 1.0;
  std::vector<double> values;
};

/// Attenuation above water of dense materials, per mm, averaged over the squares.
Coarse dense_map(const SliceView& slice, const geometry::Vec3& spacing) {
  Coarse map;
  map.step_x = std::max<std::ptrdiff_t>(1, std::lround(coarse_mm / spacing.x()));
  map.step_y = std::max<std::ptrdiff_t>(1, std::lround(coarse_mm / spacing.y()));
  map.cell_mm_x = spacing.x() * static_cast<double>(map.step_x);
  map.cell_mm_y = spacing.y() * static_cast<double>(map.step_y);
  map.width = (slice.width + map.step_x - 1) / map.step_x;
  map.height = (slice.height + map.step_y - 1) / map.step_y;
  map.values.assign(static_cast<std::size_t>(map.width * map.height), 0.0);
  std::vector<double> counts(map.values.size(), 0.0);
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const auto cell = static_cast<std::size_t>(i / map.step_x + map.width * (j / map.step_y));
      const double above = std::clamp(static_cast<double>(slice.row(j)[i]) - dense_from_hu, 0.0, most_hu);
      map.values[cell] += above * water_per_mm / 1000.0;
      counts[cell] += 1.0;
    }
  }
  for (std::size_t c = 0; c < counts.size(); ++c) map.values[c] /= counts[c];
  return map;
}

/// Where a square is seen on the detector of one angle.
struct Detector {
  double cos = 1.0, sin = 0.0, bin_mm = 1.0, middle = 0.0;
  double bin(const Coarse& map, std::ptrdiff_t i, std::ptrdiff_t j) const {
    const double x = (static_cast<double>(i) - 0.5 * static_cast<double>(map.width - 1)) * map.cell_mm_x;
    const double y = (static_cast<double>(j) - 0.5 * static_cast<double>(map.height - 1)) * map.cell_mm_y;
    return (x * cos + y * sin) / bin_mm + middle;
  }
};

/// Filter of back-projection in space (Ramachandran and Lakshminarayanan 1971), per bin.
std::vector<double> ramp_filtered(const std::vector<double>& projection, double bin_mm) {
  const auto n = static_cast<std::ptrdiff_t>(projection.size());
  std::vector<double> result(projection.size(), 0.0);
  const double pi2 = std::numbers::pi * std::numbers::pi;
  for (std::ptrdiff_t a = 0; a < n; ++a) {
    double sum = 0.25 * projection[static_cast<std::size_t>(a)];
    for (std::ptrdiff_t b = (a + 1) % 2; b < n; b += 2) {
      const auto d = static_cast<double>(a - b);
      sum -= projection[static_cast<std::size_t>(b)] / (pi2 * d * d);
    }
    result[static_cast<std::size_t>(a)] = sum / bin_mm;
  }
  return result;
}

}  // namespace

void add_beam_hardening(const SliceView& slice, const geometry::Vec3& spacing_mm, double strength) {
  if (strength <= 0.0) return;
  const Coarse map = dense_map(slice, spacing_mm);
  Detector detector;
  detector.bin_mm = std::min(map.cell_mm_x, map.cell_mm_y);
  const double across = std::hypot(map.cell_mm_x * static_cast<double>(map.width),
                                   map.cell_mm_y * static_cast<double>(map.height));
  const auto bins = static_cast<std::size_t>(std::ceil(across / detector.bin_mm)) + 4;
  detector.middle = 0.5 * static_cast<double>(bins - 1);
  std::vector<double> error(map.values.size(), 0.0);
  for (int a = 0; a < angles; ++a) {
    const double angle = std::numbers::pi * a / angles;
    detector.cos = std::cos(angle);
    detector.sin = std::sin(angle);
    std::vector<double> projection(bins, 0.0);
    const double area = map.cell_mm_x * map.cell_mm_y / detector.bin_mm;
    for (std::ptrdiff_t j = 0; j < map.height; ++j) {
      for (std::ptrdiff_t i = 0; i < map.width; ++i) {
        const double value = map.values[static_cast<std::size_t>(i + map.width * j)];
        if (value <= 0.0) continue;
        const double at = detector.bin(map, i, j);
        const auto low = static_cast<std::size_t>(at);
        const double part = at - static_cast<double>(low);
        projection[low] += (1.0 - part) * value * area;
        projection[low + 1] += part * value * area;
      }
    }
    for (double& p : projection) p = -second_order * p * p;
    const std::vector<double> filtered = ramp_filtered(projection, detector.bin_mm);
    for (std::ptrdiff_t j = 0; j < map.height; ++j) {
      for (std::ptrdiff_t i = 0; i < map.width; ++i) {
        const double at = detector.bin(map, i, j);
        const auto low = static_cast<std::size_t>(at);
        const double part = at - static_cast<double>(low);
        error[static_cast<std::size_t>(i + map.width * j)] +=
            ((1.0 - part) * filtered[low] + part * filtered[low + 1]) * std::numbers::pi / angles;
      }
    }
  }
  const double to_hu = strength * 1000.0 / water_per_mm;
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    const double y = std::clamp((static_cast<double>(j) + 0.5) / static_cast<double>(map.step_y) - 0.5, 0.0,
                                static_cast<double>(map.height - 1));
    const auto j0 = std::min(static_cast<std::ptrdiff_t>(y), std::max<std::ptrdiff_t>(map.height - 2, 0));
    const std::ptrdiff_t j1 = std::min(j0 + 1, map.height - 1);
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const double x = std::clamp((static_cast<double>(i) + 0.5) / static_cast<double>(map.step_x) - 0.5, 0.0,
                                  static_cast<double>(map.width - 1));
      const auto i0 = std::min(static_cast<std::ptrdiff_t>(x), std::max<std::ptrdiff_t>(map.width - 2, 0));
      const std::ptrdiff_t i1 = std::min(i0 + 1, map.width - 1);
      const double fx = x - static_cast<double>(i0), fy = y - static_cast<double>(j0);
      const auto at = [&](std::ptrdiff_t ci, std::ptrdiff_t cj) {
        return error[static_cast<std::size_t>(ci + map.width * cj)];
      };
      const double value = (1.0 - fy) * ((1.0 - fx) * at(i0, j0) + fx * at(i1, j0)) +
                           fy * ((1.0 - fx) * at(i0, j1) + fx * at(i1, j1));
      slice.row(j)[i] += static_cast<float>(to_hu * value);
    }
  }
}

}  // namespace ostia::phantom
