#include "scan/artefacts.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Vec3;
using Line = Eigen::ArrayXd;

constexpr std::uint64_t direction_stream = 0x68616c66ULL, start_stream = 0x7374617274ULL;
constexpr int half_scan_views = 360;
constexpr int half_scan_taps = 160;  // of the filter, to either side
// What moves is taken as the difference to this: the rim of the moving ball then hardly shows.
constexpr float still_hu = 50.0f;

double sinc(double x) {
  const double t = std::numbers::pi * x;
  return std::abs(t) < 1e-6 ? 1.0 : std::sin(t) / t;
}

/// The detector of one view: bins of half a voxel, `middle` the one under the slice's centre.
struct HalfScanDetector {
  double cos = 1.0, sin = 0.0;
  Vec3 spacing;
  double bin_mm = 1.0, half_x_mm = 0.0, half_y_mm = 0.0;
  Eigen::Index middle = 0;
  double bin(std::ptrdiff_t i, std::ptrdiff_t j) const {
    const double x = (static_cast<double>(i) + 0.5) * spacing.x() - half_x_mm;
    const double y = (static_cast<double>(j) + 0.5) * spacing.y() - half_y_mm;
    return (x * cos + y * sin) / bin_mm + static_cast<double>(middle);
  }
  double step() const { return spacing.x() * cos / bin_mm; }  ///< from voxel to voxel in a row
  /// Of a voxel, bins.
  double footprint() const { return (std::abs(cos) * spacing.x() + std::abs(sin) * spacing.y()) / bin_mm; }
};

HalfScanDetector detector_of(const SliceView& slice, const Vec3& spacing, double shift_mm) {
  HalfScanDetector d;
  d.spacing = spacing;
  d.bin_mm = 0.5 * spacing.head<2>().minCoeff();
  d.half_x_mm = 0.5 * spacing.x() * static_cast<double>(slice.width);
  d.half_y_mm = 0.5 * spacing.y() * static_cast<double>(slice.height);
  const double reach_mm = std::hypot(d.half_x_mm, d.half_y_mm) + shift_mm;
  d.middle = static_cast<Eigen::Index>(std::ceil(reach_mm / d.bin_mm)) + half_scan_taps + 4;
  return d;
}

/// The filter of back-projection, taps 0, 1, ... What blurs (voxels spread over bins, the look-up between
/// bins) is undone up to the voxels' own limit.
std::vector<double> half_scan_filter(double bin_mm) {
  constexpr int steps = 512;
  constexpr double mean_footprint = 2.55;  // bins
  const double last = 0.5 / bin_mm;
  std::vector<double> out(half_scan_taps + 1, 0.0);
  for (int n = 0; n < steps; ++n) {
    const double f = last * (n + 0.5) / steps, share = f / last;
    const double undone = sinc(f * mean_footprint * bin_mm) * std::pow(sinc(f * bin_mm), 4.0);
    // Beyond the voxels' limit, half of `last`, there are only mirror images of what lies below.
    if (share >= 0.5) break;
    const double fade = share < 0.3 ? 1.0 : std::pow(std::cos(2.5 * std::numbers::pi * (share - 0.3)), 2.0);
    const double weight = 2.0 * f * fade / std::max(undone, 0.3) * last / steps * bin_mm;
    for (int t = 0; t <= half_scan_taps; ++t)
      out[static_cast<std::size_t>(t)] += weight * std::cos(2.0 * std::numbers::pi * f * bin_mm * t);
  }
  return out;
}

/// Line integrals of the voxels, each as wide as it looks from there.
Line projected(const std::vector<float>& voxels, const SliceView& slice, const HalfScanDetector& d) {
  Line points = Line::Zero(2 * d.middle + 1);
  const double area = d.spacing.x() * d.spacing.y() / d.bin_mm;
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    const float* row = voxels.data() + j * slice.width;
    const double begin = d.bin(0, j), step = d.step();
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      if (row[i] == 0.0f) continue;
      const double at = begin + step * static_cast<double>(i);
      const auto low = static_cast<Eigen::Index>(at);
      const double value = area * static_cast<double>(row[i]), part = at - static_cast<double>(low);
      points[low] += (1.0 - part) * value;
      points[low + 1] += part * value;
    }
  }
  // A box as wide as the footprint, its ends in parts of a bin.
  const double half = 0.5 * d.footprint();
  const auto whole = static_cast<Eigen::Index>(half + 0.5);
  Line out = Line::Zero(points.size());
  const Eigen::Index inner = points.size() - 2 * half_scan_taps;
  for (Eigen::Index b = -whole; b <= whole; ++b) {
    const double weight = std::min(1.0, half + 0.5 - static_cast<double>(std::abs(b))) / d.footprint();
    out.segment(half_scan_taps, inner) += weight * points.segment(half_scan_taps + b, inner);
  }
  return out;
}

/// The line `bins` farther on, less itself.
Line moved_less_still(const Line& line, double bins) {
  const double whole = std::floor(bins), part = bins - whole;
  const auto step = static_cast<Eigen::Index>(whole);
  const auto at = [&](Eigen::Index i) { return i >= 0 && i < line.size() ? line[i] : 0.0; };
  Line out(line.size());
  for (Eigen::Index i = 0; i < line.size(); ++i)
    out[i] = (1.0 - part) * at(i - step) + part * at(i - step - 1) - line[i];
  return out;
}

Line filtered(const Line& line, const std::vector<double>& taps) {
  Line out = Line::Zero(line.size());
  const Eigen::Index inner = line.size() - 2 * half_scan_taps;
  auto sum = out.segment(half_scan_taps, inner);
  sum = taps[0] * line.segment(half_scan_taps, inner);
  for (Eigen::Index t = 1; t <= half_scan_taps; ++t)
    sum += taps[static_cast<std::size_t>(t)] *
           (line.segment(half_scan_taps - t, inner) + line.segment(half_scan_taps + t, inner));
  return out;
}

void back_project(const Line& view, const SliceView& slice, const HalfScanDetector& d,
                  std::vector<double>& sum) {
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    const double begin = d.bin(0, j), step = d.step();
    double* row = sum.data() + j * slice.width;
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const double at = begin + step * static_cast<double>(i);
      const auto low = static_cast<Eigen::Index>(at);
      const double part = at - static_cast<double>(low);
      row[i] += (1.0 - part) * view[low] + part * view[low + 1];
    }
  }
}

}  // namespace

HalfScanMotion::HalfScanMotion(const ScanOptions& options)
    : options_(options),
      direction_(drawn_angle(options, direction_stream)),
      first_angle_(0.5 * drawn_angle(options, start_stream)) {}

/// What moves in the slice; empty where nothing does.
std::vector<float> HalfScanMotion::moving_part(const SliceView& slice, std::int64_t margin_i,
                                               std::int64_t margin_j, std::int64_t k) const {
  std::vector<float> moving(static_cast<std::size_t>(slice.width * slice.height), 0.0f);
  bool any = false;
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const Vec3 at = options_.grid.world(
          Vec3(static_cast<double>(i - margin_i), static_cast<double>(j - margin_j), static_cast<double>(k)));
      const auto share = static_cast<float>(motion_share(options_, at));
      moving[static_cast<std::size_t>(j * slice.width + i)] = share * (slice.row(j)[i] - still_hu);
      any = any || share > 0.0f;
    }
  }
  if (!any) moving.clear();
  return moving;
}

void HalfScanMotion::blur(const SliceView& slice, std::int64_t margin_i, std::int64_t margin_j,
                          std::int64_t k) const {
  if (none()) return;
  const std::vector<float> moving = moving_part(slice, margin_i, margin_j, k);
  if (moving.empty()) return;
  const double path_mm = options_.realism.half_scan_motion_mm;
  HalfScanDetector detector = detector_of(slice, options_.grid.spacing, 0.5 * path_mm);
  const std::vector<double> taps = half_scan_filter(detector.bin_mm);
  std::vector<double> sum(moving.size(), 0.0);
  for (int n = 0; n < half_scan_views; ++n) {
    const double angle = std::numbers::pi * n / half_scan_views;
    detector.cos = std::cos(angle);
    detector.sin = std::sin(angle);
    // From -1/2 at the first view to 1/2 at the last, half a turn later.
    const double turned = std::fmod(angle - first_angle_ + 2.0 * std::numbers::pi, std::numbers::pi);
    const double shift_mm = (turned / std::numbers::pi - 0.5) * path_mm * std::cos(angle - direction_);
    const Line line = projected(moving, slice, detector);
    back_project(filtered(moved_less_still(line, shift_mm / detector.bin_mm), taps), slice, detector, sum);
  }
  for (std::ptrdiff_t j = 0; j < slice.height; ++j)
    for (std::ptrdiff_t i = 0; i < slice.width; ++i)
      slice.row(j)[i] += static_cast<float>(sum[static_cast<std::size_t>(j * slice.width + i)] *
                                            std::numbers::pi / half_scan_views);
}

}  // namespace ostia::phantom
