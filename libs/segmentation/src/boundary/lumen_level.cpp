#include "boundary/lumen_level.h"

#include "boundary/edge_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::segmentation {
namespace {

constexpr double window_mm = 12.0;      // half width of the fit along the vessel
constexpr double least_sigma_hu = 8.0;  // no scan has less noise
constexpr double mad_to_sigma = 1.4826;

/// What one row says of the lumen, and how much it counts.
struct RowLevel {
  double hu = 0.0, weight = 0.0;
};

/// Weighted straight line through rows near `at`, its value there; outliers lose their say (biweight). The
/// slope is held back by a ridge so that few rows give their mean.
double local_fit(const std::vector<RowLevel>& rows, std::size_t at, double step_mm, double scale_hu,
                 double otherwise) {
  const int reach = std::max(1, static_cast<int>(window_mm / step_mm));
  const int n = static_cast<int>(rows.size());
  const int first = std::max(0, static_cast<int>(at) - reach);
  const int last = std::min(n - 1, static_cast<int>(at) + reach);
  std::vector<double> values;
  for (int i = first; i <= last; ++i)
    if (rows[i].weight > 0.0) values.push_back(rows[i].hu);
  if (values.empty()) return otherwise;
  double value = median(values), slope = 0.0;
  for (int round = 0; round < 6; ++round) {
    double w0 = 1e-9, w1 = 0.0, w2 = 0.0, v0 = 1e-9 * value, v1 = 0.0;
    for (int i = first; i <= last; ++i) {
      const double x = (i - static_cast<int>(at)) * step_mm;
      const double off = (rows[i].hu - value - slope * x) / (4.0 * scale_hu);
      if (rows[i].weight <= 0.0 || std::abs(off) >= 1.0) continue;
      const double part = x / window_mm, near = 1.0 - part * part, robust = 1.0 - off * off;
      const double w = rows[i].weight * std::max(0.0, near) * robust * robust;
      w0 += w, w1 += w * x, w2 += w * x * x, v0 += w * rows[i].hu, v1 += w * x * rows[i].hu;
    }
    w2 += 0.3 * window_mm * window_mm * w0;
    const double det = w0 * w2 - w1 * w1;
    value = (w2 * v0 - w1 * v1) / det;
    slope = (w0 * v1 - w1 * v0) / det;
  }
  return value;
}

/// Where no row within reach says anything, what was thought before.
LumenLevel smooth(const std::vector<RowLevel>& rows, double step_mm, const LumenLevel* before) {
  std::vector<double> all;
  for (const RowLevel& row : rows)
    if (row.weight > 0.0) all.push_back(row.hu);
  LumenLevel out;
  out.typical_hu = median(all);
  for (double& value : all) value = std::abs(value - out.typical_hu);
  const double scale = std::max(15.0, mad_to_sigma * median(all));
  out.hu.resize(rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    out.hu[n] = local_fit(rows, n, step_mm, scale, before ? before->hu[n] : out.typical_hu);
  }
  if (all.empty() && before) out.typical_hu = before->typical_hu;
  return out;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

LumenLevel lumen_level(const RayFan& fan, double core_mm, double row_step_mm) {
  const int core = std::clamp(static_cast<int>(core_mm / fan.step_mm), 1, fan.count - 1);
  std::vector<RowLevel> rows(static_cast<std::size_t>(fan.rows));
  std::vector<double> deviations;
  for (int r = 0; r < fan.rows; ++r) {
    std::vector<double> values;
    for (int a = 0; a < fan.around; ++a)
      for (int i = 0; i <= core; ++i) values.push_back(fan.ray(r, a)[i]);
    // The axis may run beside the lumen's middle: its brighter half is surely lumen.
    const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 6 / 10);
    std::nth_element(values.begin(), upper, values.end());
    rows[r] = {*upper, 1.0};
    deviations.push_back(std::abs(fan.ray(r, 0)[0] - (r > 0 ? fan.ray(r - 1, 0)[0] : fan.ray(r, 0)[0])));
  }
  LumenLevel out = smooth(rows, row_step_mm, nullptr);
  out.sigma_hu = std::max(2.0 * least_sigma_hu, mad_to_sigma * median(deviations));
  return out;
}

LumenLevel lumen_level(const RayFan& fan, const std::vector<double>& radius_mm, const CoreOptions& core,
                       double row_step_mm, const LumenLevel& first) {
  std::vector<RowLevel> rows(static_cast<std::size_t>(fan.rows));
  std::vector<double> deviations;
  const auto reach = [&](double radius) {
    return std::max(radius - 2.0 * core.blur_sigma_mm, std::min(0.2, 0.4 * radius));
  };
  for (int r = 0; r < fan.rows; ++r) {
    const double* ring = radius_mm.data() + static_cast<std::size_t>(r) * fan.around;
    double sum = 0.0, area = 0.0, mean_radius = 0.0;
    for (int a = 0; a < fan.around; ++a) {
      const int most = std::min(fan.count - 1, static_cast<int>(reach(ring[a]) / fan.step_mm));
      for (int i = 0; i <= most; ++i) {
        const double w = i == 0 ? 0.125 : i;
        sum += w * fan.ray(r, a)[i];
        area += w;
      }
      mean_radius += ring[a] / fan.around;
    }
    // A thin lumen looks darker than it is: its blurred disc has its full height nowhere.
    const double share = blurred_disc(mean_radius, 0.67 * reach(mean_radius), core.blur_sigma_mm);
    const double mm2 = area * fan.step_mm * fan.step_mm * 2.0 * std::numbers::pi / fan.around;
    if (share > 0.7) rows[r] = {core.outside_hu + (sum / area - core.outside_hu) / share, mm2 * share};
  }
  LumenLevel out = smooth(rows, row_step_mm, &first);
  for (int r = 0; r < fan.rows; ++r) {
    for (int a = 0; a < fan.around; ++a) {
      const double most = radius_mm[static_cast<std::size_t>(r) * fan.around + a] - 2.0 * core.blur_sigma_mm;
      for (int i = 0; i * fan.step_mm < most && i < fan.count; i += 3) {
        deviations.push_back(std::abs(fan.ray(r, a)[i] - out.hu[r]));
      }
    }
  }
  out.sigma_hu =
      deviations.size() < 100 ? first.sigma_hu : std::max(least_sigma_hu, mad_to_sigma * median(deviations));
  return out;
}

}  // namespace ostia::segmentation
