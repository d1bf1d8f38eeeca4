#include "path/line.h"

#include "ostia/geometry/frame.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::segmentation::detail {
namespace {

constexpr int kRays = 16;
constexpr double kRayStepMm = 0.15;
constexpr double kHalf = 0.5;
constexpr double kLeastOfWidth = 0.25;  // a lumen hardly brighter than its wall: the background counts
constexpr int kCentrings = 4;
constexpr double kMostShiftMm = 0.4;   // of a centring
constexpr double kSmoothingMm3 = 2.0;  // lets bends of 3 mm and more through
constexpr std::size_t kFewestEdges = 8;
constexpr double kBloomMm = 0.8;        // how far behind an edge calcium still changes it
constexpr int kFewestAtCalcium = 2;     // rays: one sample may be so bright by noise
constexpr double kLevelMm = 7.5;        // either way, over which a vessel's lumen is as bright as here
constexpr double kBridgeWeight = 0.02;  // of a place beside calcium, against 1: bridges some 20 mm

/// Where a ray from the centre leaves the lumen, mm; nothing when it does not within the reach.
double edge_along(TubeSpeed& image, const Vec3& centre, const Vec3& direction, double half_hu,
                  double reach_mm) {
  const double calcium = image.levels().calcium_hu;
  double before = image.smooth(centre);
  for (double r = kRayStepMm; r <= reach_mm; r += kRayStepMm) {
    const double here = image.smooth(Vec3(centre + r * direction));
    const double bound = here < half_hu ? half_hu : calcium;
    if (here < half_hu || (here > calcium && before <= calcium)) {
      return r - kRayStepMm * std::clamp((here - bound) / (here - before), 0.0, 1.0);
    }
    before = here;
  }
  return -1.0;
}

/// Whether a ray comes upon calcium before `to_mm`: in the image itself, since a mean hides small nodules.
bool meets_calcium(const TubeSpeed& image, const Vec3& centre, const Vec3& direction, double to_mm,
                   double bound) {
  for (double r = 0.0; r <= to_mm; r += kRayStepMm)
    if (imaging::sample(image.image(), centre + r * direction, imaging::Interpolation::trilinear) > bound)
      return true;
  return false;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double unblurred_radius(double half_mm, double sigma_mm) {
  // Half-radius over sigma of a disc of radius over sigma 0, 1/4, ...: a Gaussian's for a point, the disc's
  // own for a large one. By quadrature of the disc's convolution.
  struct Entry {
    double radius, half;
  };
  static constexpr std::array<Entry, 12> kTable{{{0.0, 1.177},
                                                 {0.25, 1.187},
                                                 {0.5, 1.215},
                                                 {0.75, 1.264},
                                                 {1.0, 1.335},
                                                 {1.25, 1.433},
                                                 {1.5, 1.559},
                                                 {1.75, 1.715},
                                                 {2.0, 1.901},
                                                 {2.5, 2.342},
                                                 {3.0, 2.839},
                                                 {4.0, 3.872}}};
  if (!(sigma_mm > 0.0)) return half_mm;
  const double half = half_mm / sigma_mm;
  if (half >= kTable.back().half) return half_mm + sigma_mm * (kTable.back().radius - kTable.back().half);
  std::size_t n = 1;
  while (n + 1 < kTable.size() && kTable[n].half < half) ++n;
  const Entry &a = kTable[n - 1], &b = kTable[n];
  const double t = std::max(0.0, (half - a.half) / (b.half - a.half));
  return sigma_mm * std::max(0.75, a.radius + t * (b.radius - a.radius));
}

std::vector<double> lumen_along(TubeSpeed& image, const std::vector<Vec3>& line) {
  const std::vector<double> s = geometry::abscissas(line);
  std::vector<double> values, result;
  for (const Vec3& p : line) values.push_back(image.smooth(p));
  for (std::size_t i = 0, first = 0, last = 0; i < line.size(); ++i) {
    while (s[i] - s[first] > kLevelMm) ++first;
    while (last < line.size() && s[last] - s[i] <= kLevelMm) ++last;
    result.push_back(median({values.begin() + static_cast<std::ptrdiff_t>(first),
                             values.begin() + static_cast<std::ptrdiff_t>(last)}));
  }
  return result;
}

PathSection look_across(TubeSpeed& image, const Vec3& centre, const Vec3& tangent, const RayOptions& rays) {
  PathSection section;
  const LumenLevels& levels = image.levels();
  const double hu = image.smooth(centre);
  section.contrast = levels.contrast(hu);
  section.calcium = hu > levels.calcium_hu;
  const double inner = std::min(hu, levels.calcium_hu);
  double outer = levels.background_hu;
  if (rays.wall_hu > outer && inner - rays.wall_hu > kLeastOfWidth * (inner - outer)) outer = rays.wall_hu;
  if (inner <= outer) return section;
  const double half = outer + kHalf * (inner - outer);
  geometry::Frame frame;
  frame.tangent = tangent;
  frame.normal = geometry::initial_normal(tangent);
  frame.binormal = tangent.cross(frame.normal);
  std::vector<double> found;
  std::array<double, kRays> radius{};
  int at_calcium = 0;
  const double calcium_voxel_hu = std::max(levels.calcium_voxel_hu, rays.lumen_hu + levels.calcium_margin_hu);
  for (int n = 0; n < kRays; ++n) {
    const Vec3 direction = geometry::radial_direction(frame, 2.0 * M_PI * n / kRays);
    const double r = edge_along(image, centre, direction, half, 1.5 * rays.largest_radius_mm);
    radius[static_cast<std::size_t>(n)] = r;
    if (r >= 0.0) found.push_back(r);
    at_calcium += r >= 0.0 && meets_calcium(image, centre, direction, r + kBloomMm, calcium_voxel_hu) ? 1 : 0;
  }
  section.near_calcium = section.calcium || at_calcium >= kFewestAtCalcium;
  section.edges = static_cast<double>(found.size()) / kRays;
  if (found.size() < kFewestEdges) return section;
  const double half_radius = section.seen_radius_mm = median(found);
  section.radius_mm = std::min(unblurred_radius(half_radius, rays.blur_sigma_mm), rays.largest_radius_mm);
  // A circle of radius R seen from a place at distance d from its centre has r = R + d cos(theta) + O(d^2).
  for (int n = 0; n < kRays; ++n) {
    double r = radius[static_cast<std::size_t>(n)];
    if (r < 0.0 || r > 2.0 * half_radius) r = half_radius;  // a side branch, or no edge
    section.shift += 2.0 / kRays * r * geometry::radial_direction(frame, 2.0 * M_PI * n / kRays);
  }
  return section;
}

std::vector<Vec3> smoothed_line(const std::vector<Vec3>& points, double step_mm, double lambda_mm3,
                                const std::vector<double>& weights) {
  const std::vector<Vec3> even = geometry::resample(points, step_mm);
  if (even.size() < 4) return even;
  const std::vector<double> t = geometry::abscissas(even);
  std::vector<double> of_even(even.size(), 1.0);
  if (!weights.empty()) {
    const std::vector<double> s = geometry::abscissas(points);
    for (std::size_t i = 0, n = 0; i < even.size(); ++i) {
      const double at = t[i] * s.back() / t.back();
      while (n + 1 < s.size() && s[n + 1] - at < at - s[n]) ++n;  // the nearest point's
      of_even[i] = weights[n];
    }
  }
  // The penalty per point: the same smoothness for any step.
  return geometry::smoothing_spline(t, even, of_even, lambda_mm3 / step_mm, true);
}

std::vector<Vec3> centred_line(TubeSpeed& image, std::vector<Vec3> points, double step_mm,
                               const FixedEnds& fixed, const RayOptions& rays) {
  points = smoothed_line(points, step_mm, kSmoothingMm3);
  for (int turn = 0; turn < kCentrings; ++turn) {
    if (points.size() < 3) return points;
    const std::vector<Vec3> tangents = geometry::tangents(points);
    const std::vector<double> s = geometry::abscissas(points);
    const std::vector<double> lumen = lumen_along(image, points);
    std::vector<double> weights(points.size(), 1.0);
    RayOptions here = rays;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (s[i] < fixed.start_mm || s[i] > s.back() - fixed.end_mm) continue;
      here.lumen_hu = lumen[i];
      const PathSection section = look_across(image, points[i], tangents[i], here);
      if (section.near_calcium) weights[i] = kBridgeWeight;
      if (section.radius_mm <= 0.0 || section.near_calcium) continue;
      const double most = std::min(kMostShiftMm, section.radius_mm);
      const double length = section.shift.norm();
      points[i] += length > most ? Vec3(section.shift * (most / length)) : section.shift;
    }
    points = smoothed_line(points, step_mm, kSmoothingMm3, weights);
  }
  return points;
}

}  // namespace ostia::segmentation::detail
