#include "ostia/evaluation/phase_sharpness.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/noise.h"
#include "ostia/imaging/reduced_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace ostia::evaluation {
namespace {

using imaging::Geometry;
using imaging::ImageVolume;
using imaging::MaskVolume;

struct SharpnessSums {
  double first = 0.0, second = 0.0;  // of g and of its square, a share of the contrast per mm
};

Vec3 corner_index(const Geometry& g, int number) {
  return {number & 1 ? static_cast<double>(g.size[0] - 1) : 0.0,
          number & 2 ? static_cast<double>(g.size[1] - 1) : 0.0,
          number & 4 ? static_cast<double>(g.size[2] - 1) : 0.0};
}

/// Where the heart lies in a chest, in the world: LPS, so that x goes to the left and y to the back.
geometry::Box3 heart_box(const Geometry& g) {
  geometry::Box3 all;
  for (int n = 0; n < 8; ++n) all.extend(g.world(corner_index(g, n)));
  const Vec3 low = all.min(), wide = all.sizes();
  return {Vec3(low.x() + 0.2 * wide.x(), low.y() + 0.15 * wide.y(), low.z()),
          Vec3(low.x() + 0.8 * wide.x(), low.y() + 0.7 * wide.y(), all.max().z())};
}

/// The part of the image about the points, with room for the filter; the whole where a side is thin.
ImageVolume cropped_about(const ImageVolume& image, const std::vector<Vec3>& points, double margin_mm) {
  const Geometry& g = image.geometry;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& point : points) {
    const Vec3 at = g.index(point), reach = margin_mm * g.spacing.cwiseInverse();
    low = low.cwiseMin(at - reach);
    high = high.cwiseMax(at + reach);
  }
  imaging::Region region;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<int>(a);
    const auto last = static_cast<double>(g.size[a] - 1);
    region.lower[a] = static_cast<std::int64_t>(std::floor(std::clamp(low[axis], 0.0, last)));
    region.upper[a] = static_cast<std::int64_t>(std::ceil(std::clamp(high[axis], 0.0, last))) + 1;
    if (region.upper[a] - region.lower[a] < 3) region.lower[a] = 0, region.upper[a] = g.size[a];
  }
  return imaging::cropped(image, region);
}

void mark_ball(MaskVolume& mask, const Vec3& centre, double radius_mm) {
  const Geometry& g = mask.geometry;
  const Vec3 at = g.index(centre), reach = radius_mm * g.spacing.cwiseInverse();
  std::array<std::int64_t, 3> lower{}, upper{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<int>(a);
    lower[a] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(at[axis] - reach[axis])));
    upper[a] = std::min(g.size[a] - 1, static_cast<std::int64_t>(std::floor(at[axis] + reach[axis])));
  }
  for (std::int64_t k = lower[2]; k <= upper[2]; ++k)
    for (std::int64_t j = lower[1]; j <= upper[1]; ++j)
      for (std::int64_t i = lower[0]; i <= upper[0]; ++i) {
        const Vec3 here(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        if ((here - at).cwiseProduct(g.spacing).squaredNorm() <= radius_mm * radius_mm) mask(i, j, k) = 1;
      }
}

MaskVolume region_of(const Geometry& g, const std::vector<Vec3>& points, double within_mm) {
  MaskVolume mask{g, std::vector<std::uint8_t>(static_cast<std::size_t>(g.voxels()), points.empty() ? 1 : 0)};
  for (const Vec3& point : points) mark_ball(mask, point, within_mm);
  return mask;
}

/// Without the rim, where there is no difference to take.
SharpnessSums sums_of(const imaging::FloatVolume& image, const MaskVolume& mask, double least) {
  const Geometry& g = image.geometry;
  const Vec3 step = (2.0 * g.spacing).cwiseInverse();
  const auto slices = static_cast<std::size_t>(g.size[2] - 2);
  std::vector<SharpnessSums> of(slices);
  core::parallel_for(slices, 1, [&](std::size_t n) {
    const auto k = static_cast<std::int64_t>(n) + 1;
    for (std::int64_t j = 1; j + 1 < g.size[1]; ++j)
      for (std::int64_t i = 1; i + 1 < g.size[0]; ++i) {
        if (mask(i, j, k) == 0) continue;
        const double x = (image(i + 1, j, k) - image(i - 1, j, k)) * step.x();
        const double y = (image(i, j + 1, k) - image(i, j - 1, k)) * step.y();
        const double z = (image(i, j, k + 1) - image(i, j, k - 1)) * step.z();
        const double steep = std::sqrt(x * x + y * y + z * z);
        if (steep < least) continue;
        of[n].first += steep;
        of[n].second += steep * steep;
      }
  });
  SharpnessSums all;
  for (const SharpnessSums& one : of) all.first += one.first, all.second += one.second;
  return all;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool same_spacing(const Vec3& a, const Vec3& b) {
  return ((a - b).cwiseAbs().array() <= 0.1 * b.array()).all();
}

/// What is wrong with each by itself and against the others.
std::vector<LeftOut> left_out_of(const std::vector<std::optional<EdgeSharpness>>& phases,
                                 std::optional<std::size_t> on_table) {
  constexpr double least_inside = 0.95, least_edges = 0.5, most_noise = 2.5, least_mm2 = 1.0;
  std::vector<LeftOut> out(phases.size(), LeftOut::none);
  std::vector<double> edges, noise;
  std::array<std::vector<double>, 3> spacings;
  for (std::size_t n = 0; n < phases.size(); ++n) {
    if (!phases[n])
      out[n] = LeftOut::not_measured;
    else if (phases[n]->inside < least_inside)
      out[n] = LeftOut::elsewhere;
    else if (!(phases[n]->per_mm > 0.0) || phases[n]->edges_mm2 < least_mm2)
      out[n] = LeftOut::no_edges;
    if (out[n] != LeftOut::none) continue;
    for (std::size_t a = 0; a < 3; ++a) spacings[a].push_back(phases[n]->spacing_mm[static_cast<int>(a)]);
  }
  Vec3 usual(median_of(spacings[0]), median_of(spacings[1]), median_of(spacings[2]));
  if (on_table && phases[*on_table]) usual = phases[*on_table]->spacing_mm;
  for (std::size_t n = 0; n < phases.size(); ++n) {
    if (out[n] != LeftOut::none) continue;
    if (!same_spacing(phases[n]->spacing_mm, usual)) {
      out[n] = LeftOut::other_voxels;
      continue;
    }
    edges.push_back(phases[n]->edges_mm2);
    noise.push_back(phases[n]->noise_hu);
  }
  const double usual_edges = median_of(edges), usual_noise = median_of(noise);
  for (std::size_t n = 0; n < phases.size(); ++n) {
    if (out[n] != LeftOut::none) continue;
    // Of an image without any noise all others are noisy: not below 5 HU.
    if (phases[n]->noise_hu > most_noise * std::max(usual_noise, 5.0))
      out[n] = LeftOut::noisy;
    else if (phases[n]->edges_mm2 < least_edges * usual_edges)
      out[n] = LeftOut::lost_edges;
  }
  return out;
}

}  // namespace

void validate(const SharpnessOptions& o) {
  if (!(std::isfinite(o.low_hu) && std::isfinite(o.high_hu) && o.high_hu - o.low_hu >= 50.0))
    throw InvalidInput("sharpness: high_hu must be 50 HU or more above low_hu");
  if (!(o.within_mm >= 1.0 && o.within_mm <= 50.0))
    throw InvalidInput("sharpness: within_mm must lie in [1, 50]");
  if (!(o.sigma_mm >= 0.2 && o.sigma_mm <= 3.0))
    throw InvalidInput("sharpness: sigma_mm must lie in [0.2, 3]");
  if (!(o.least_share_per_mm >= 0.0 && o.least_share_per_mm <= 0.5))
    throw InvalidInput("sharpness: least_share_per_mm must lie in [0, 0.5]");
  if (o.most_voxels < 1000) throw InvalidInput("sharpness: most_voxels must be 1000 or more");
}

double EdgeSharpness::blur_mm(const SharpnessOptions& options) const {
  if (!(per_mm > 0.0)) return 0.0;
  const double all = 0.5 / (std::sqrt(std::numbers::pi) * per_mm);
  return std::sqrt(std::max(0.0, all * all - options.sigma_mm * options.sigma_mm));
}

EdgeSharpness edge_sharpness(const ImageVolume& image, const std::vector<Vec3>& points,
                             const SharpnessOptions& options, const core::TaskContext& task) {
  validate(options);
  const Geometry& whole = image.geometry;
  if (*std::min_element(whole.size.begin(), whole.size.end()) < 3)
    throw InvalidInput("sharpness: the image must have 3 voxels or more along each side");
  EdgeSharpness result;
  result.spacing_mm = whole.spacing;
  std::vector<Vec3> inside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(inside),
               [&](const Vec3& p) { return whole.contains(p); });
  if (!points.empty()) {
    result.inside = static_cast<double>(inside.size()) / static_cast<double>(points.size());
    if (inside.empty()) throw InvalidInput("sharpness: all points lie outside of the image");
  }
  imaging::ReducedVolumeOptions coarser;
  coarser.most_voxels = options.most_voxels;
  coarser.box = heart_box(whole);
  const ImageVolume part = inside.empty()
                               ? imaging::reduced_volume(image, coarser, task.sub(0.0, 0.3))
                               : cropped_about(image, inside, options.within_mm + 4.0 * options.sigma_mm);
  if (*std::min_element(part.geometry.size.begin(), part.geometry.size.end()) < 3) return result;
  result.noise_hu = imaging::noise_level_hu(image).value_or(0.0);
  const double contrast = options.high_hu - options.low_hu;
  imaging::FloatVolume held{part.geometry, std::vector<float>(part.voxels.size())};
  std::transform(part.voxels.begin(), part.voxels.end(), held.voxels.begin(), [&](std::int16_t hu) {
    return static_cast<float>((std::clamp<double>(hu, options.low_hu, options.high_hu) - options.low_hu) /
                              contrast);
  });
  held = imaging::gaussian_blurred(held, options.sigma_mm, task.sub(0.3, 0.9));
  task.throw_if_cancelled();
  const SharpnessSums sums =
      sums_of(held, region_of(part.geometry, inside, options.within_mm), options.least_share_per_mm);
  if (sums.first > 0.0) result.per_mm = sums.second / sums.first;
  result.edges_mm2 = sums.first * part.geometry.spacing.prod();
  task.set_progress(1.0);
  return result;
}

std::optional<double> blood_level_hu(const ImageVolume& image) {
  constexpr int from_hu = 200, to_hu = 800, bin_hu = 10, bins = (to_hu - from_hu) / bin_hu;
  constexpr double least_share = 0.01;
  const Geometry& g = image.geometry;
  if (g.voxels() <= 0) return std::nullopt;
  const geometry::Box3 heart = heart_box(g);
  std::array<double, bins> count{};
  double all = 0.0;
  for (std::int64_t k = 0; k < g.size[2]; ++k)
    for (std::int64_t j = 0; j < g.size[1]; j += 2)
      for (std::int64_t i = 0; i < g.size[0]; i += 2) {
        const Vec3 at(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        if (!heart.contains(g.world(at))) continue;
        all += 1.0;
        const int hu = image(i, j, k);
        if (hu >= from_hu && hu < to_hu) count[static_cast<std::size_t>((hu - from_hu) / bin_hu)] += 1.0;
      }
  // Over 50 HU, so that noise makes no peak; the lowest bins are the slope of what is darker.
  double best = 0.0;
  int at = 0;
  for (int n = 2; n + 2 < bins; ++n) {
    double sum = 0.0;
    for (int m = n - 2; m <= n + 2; ++m) sum += count[static_cast<std::size_t>(m)];
    if (sum > best) best = sum, at = n;
  }
  if (at <= 2 || best < least_share * all) return std::nullopt;
  return from_hu + (at + 0.5) * bin_hu;
}

BestPhase best_phase(const std::vector<std::optional<EdgeSharpness>>& phases,
                     std::optional<std::size_t> on_table, double tie_share) {
  if (on_table && *on_table >= phases.size())
    throw InvalidInput("best phase: number " + std::to_string(*on_table) + " of " +
                       std::to_string(phases.size()) + " phases");
  if (!(tie_share >= 0.0 && tie_share <= 0.5))
    throw InvalidInput("best phase: tie_share must lie in [0, 0.5]");
  BestPhase result;
  result.left_out = left_out_of(phases, on_table);
  result.share.assign(phases.size(), 0.0);
  std::vector<std::size_t> compared;
  for (std::size_t n = 0; n < phases.size(); ++n)
    if (result.left_out[n] == LeftOut::none) compared.push_back(n);
  if (compared.empty()) return result;
  const std::size_t sharpest =
      *std::max_element(compared.begin(), compared.end(),
                        [&](std::size_t a, std::size_t b) { return phases[a]->per_mm < phases[b]->per_mm; });
  for (const std::size_t n : compared) result.share[n] = phases[n]->per_mm / phases[sharpest]->per_mm;
  if (compared.size() < 2) return result;
  const auto is_tied = [&](std::size_t n) { return result.share[n] >= 1.0 - tie_share; };
  result.best = on_table && is_tied(*on_table) ? *on_table : sharpest;
  for (const std::size_t n : compared)
    if (n != *result.best && is_tied(n)) result.as_sharp.push_back(n);
  return result;
}

}  // namespace ostia::evaluation
