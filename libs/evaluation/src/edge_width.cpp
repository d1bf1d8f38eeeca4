#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/evaluation/image_quality.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/sampling.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;
using imaging::Geometry;

constexpr double fwhm_per_sigma = 2.3548200450309493;

/// A voxel's value at its place on the edge's normal.
struct Sample {
  double at_mm, hu;
};

/// low + (high - low) * Phi((t - place) / sigma).
struct Edge {
  double low = 0.0, high = 0.0, place = 0.0, sigma = 0.0, residual = 0.0;
};

/// Best heights for a given place and width, and the squared misfit.
double fit_heights(const std::vector<Sample>& samples, Edge& edge) {
  double n = 0.0, p = 0.0, pp = 0.0, v = 0.0, pv = 0.0, vv = 0.0;
  for (const Sample& s : samples) {
    const double phi = 0.5 * std::erfc((edge.place - s.at_mm) / (edge.sigma * std::numbers::sqrt2));
    n += 1.0;
    p += phi;
    pp += phi * phi;
    v += s.hu;
    pv += phi * s.hu;
    vv += s.hu * s.hu;
  }
  const double determinant = n * pp - p * p;
  if (determinant <= 1e-9 * n * n) return vv;
  const double step = (n * pv - p * v) / determinant;
  edge.low = (v - step * p) / n;
  edge.high = edge.low + step;
  return std::max(0.0, vv - edge.low * v - step * pv);
}

/// Least squares over place and width; the heights are linear and solved for.
std::optional<Edge> fit_edge(const std::vector<Sample>& samples, double half_length_mm) {
  Edge best;
  double least = -1.0;
  // From the best of a few starts.
  for (const double place : {-0.4 * half_length_mm, 0.0, 0.4 * half_length_mm}) {
    for (const double sigma : {0.15, 0.35, 0.8}) {
      Edge edge;
      edge.place = place;
      edge.sigma = sigma;
      const double misfit = fit_heights(samples, edge);
      if (least < 0.0 || misfit < least) {
        least = misfit;
        best = edge;
      }
    }
  }
  double step_place = 0.2, step_width = 0.3;
  // Pattern search: robust, and the two unknowns are few.
  for (int round = 0; round < 200 && (step_place > 1e-5 || step_width > 1e-5); ++round) {
    bool better = false;
    for (const auto& [dp, dw] :
         {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
      Edge edge = best;
      edge.place += dp * step_place;
      edge.sigma *= std::exp(dw * step_width);
      if (std::abs(edge.place) > half_length_mm || edge.sigma < 0.01 || edge.sigma > 2.0 * half_length_mm)
        continue;
      const double misfit = fit_heights(samples, edge);
      if (misfit < least) {
        least = misfit;
        best = edge;
        better = true;
      }
    }
    if (!better) {
      step_place *= 0.5;
      step_width *= 0.5;
    }
  }
  fit_heights(samples, best);
  best.residual = std::sqrt(least / static_cast<double>(samples.size()));
  if (!std::isfinite(best.sigma) || best.high == best.low) return std::nullopt;
  return best;
}

/// The derivative of the profile at a place: the slope of the line that fits best, weighted by a Gaussian of
/// deviation `h`. Over evenly spread samples that is the true derivative blurred by this very Gaussian.
double slope_at(const std::vector<Sample>& sorted, double place, double h) {
  const auto from = std::lower_bound(sorted.begin(), sorted.end(), place - 3.5 * h,
                                     [](const Sample& s, double t) { return s.at_mm < t; });
  double w = 0.0, wt = 0.0, wtt = 0.0, wv = 0.0, wtv = 0.0;
  for (auto s = from; s != sorted.end() && s->at_mm < place + 3.5 * h; ++s) {
    const double t = s->at_mm - place, weight = std::exp(-0.5 * t * t / (h * h));
    w += weight;
    wt += weight * t;
    wtt += weight * t * t;
    wv += weight * s->hu;
    wtv += weight * t * s->hu;
  }
  const double determinant = w * wtt - wt * wt;
  return determinant > 1e-9 * w * w * h * h ? (w * wtv - wt * wv) / determinant : 0.0;
}

/// The width of the profile's derivative at half its height.
double line_spread_fwhm(std::vector<Sample> samples, const Edge& edge, double half_length_mm) {
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return a.at_mm < b.at_mm || (a.at_mm == b.at_mm && a.hu < b.hu);
  });
  const double h = 0.5 * edge.sigma, step = 0.1 * edge.sigma, sign = edge.high > edge.low ? 1.0 : -1.0;
  std::vector<double> place, value;
  for (double t = -half_length_mm; t <= half_length_mm; t += step) {
    place.push_back(t);
    value.push_back(sign * slope_at(samples, t, h));
  }
  const auto top = static_cast<std::size_t>(std::max_element(value.begin(), value.end()) - value.begin());
  const double half = 0.5 * value[top];
  const auto crossing = [&](std::ptrdiff_t direction) {
    auto n = static_cast<std::ptrdiff_t>(top);
    const std::ptrdiff_t end = direction > 0 ? static_cast<std::ptrdiff_t>(value.size()) - 1 : 0;
    while (n != end && value[static_cast<std::size_t>(n)] > half) n += direction;
    const auto here = static_cast<std::size_t>(n), before = static_cast<std::size_t>(n - direction);
    if (n == static_cast<std::ptrdiff_t>(top) || value[here] > half) return place[here];
    return place[before] +
           (half - value[before]) / (value[here] - value[before]) * (place[here] - place[before]);
  };
  const double measured = crossing(1) - crossing(-1), widening = fwhm_per_sigma * h;
  return std::sqrt(std::max(0.0, measured * measured - widening * widening));
}

bool wanted(EdgeDirection direction, const Vec3& normal, const Geometry& grid) {
  if (direction == EdgeDirection::any) return true;
  const double along = std::abs(normal.normalized().dot(grid.direction.col(2)));
  return direction == EdgeDirection::in_plane ? along < 0.18 : along > 0.985;
}

void require_options(const EdgeOptions& options) {
  if (!(options.half_length_mm > 0.0 && options.half_length_mm <= 50.0 && options.tube_radius_mm > 0.0 &&
        options.tube_radius_mm <= 50.0))
    throw InvalidInput("edge width: half_length_mm and tube_radius_mm must lie in (0, 50]");
}

void require_same_grid(const imaging::ImageVolume& image, const imaging::MaskVolume& mask) {
  if (!imaging::same_grid(image.geometry, mask.geometry))
    throw InvalidInput("edge widths: the mask and the image are on different grids");
}

Vec3 vector_of(std::int64_t i, std::int64_t j, std::int64_t k) {
  return {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
}

/// The places on a mask's boundary whose normals are wanted, and the smoothed mask that tells the normals:
/// the noise of the image would turn them.
struct BoundaryPlaces {
  BoundaryPlaces(const imaging::MaskVolume& mask, EdgeDirection direction, const core::TaskContext& task)
      : smooth{mask.geometry, std::vector<float>(mask.voxels.begin(), mask.voxels.end())} {
    const Geometry& g = mask.geometry;
    for (float& v : smooth.voxels) v = v != 0.0f ? 1.0f : 0.0f;
    smooth = imaging::gaussian_blurred(smooth, 1.2 * g.spacing.maxCoeff(), task);
    for (std::int64_t k = 1; k + 1 < g.size[2]; ++k) {
      for (std::int64_t j = 1; j + 1 < g.size[1]; ++j) {
        for (std::int64_t i = 1; i + 1 < g.size[0]; ++i) {
          if (mask(i, j, k) == 0) continue;
          const bool border = mask(i - 1, j, k) == 0 || mask(i + 1, j, k) == 0 || mask(i, j - 1, k) == 0 ||
                              mask(i, j + 1, k) == 0 || mask(i, j, k - 1) == 0 || mask(i, j, k + 1) == 0;
          if (!border) continue;
          const Vec3 p = g.world(vector_of(i, j, k));
          if (wanted(direction, imaging::sample_gradient(smooth, p), g)) places.push_back(p);
        }
      }
    }
  }
  imaging::FloatVolume smooth;
  std::vector<Vec3> places;
};

/// An edge that is good enough, with the voxels that it was fitted to.
struct GoodEdge {
  Edge edge;
  std::vector<Sample> samples;
};

std::optional<GoodEdge> good_edge_at(const imaging::ImageVolume& image, const imaging::FloatVolume& smooth,
                                     const Vec3& at, const EdgeOptions& options) {
  const Geometry& g = image.geometry;
  const Vec3 normal = imaging::sample_gradient(smooth, at).normalized();
  const Vec3 middle = g.index(at);
  const double reach_mm = std::hypot(options.half_length_mm, options.tube_radius_mm);
  GoodEdge out;
  std::array<std::int64_t, 3> lower{}, upper{};
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = reach_mm / g.spacing[axis];
    const auto a = static_cast<std::size_t>(axis);
    lower[a] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(middle[axis] - reach)));
    upper[a] = std::min(g.size[a], static_cast<std::int64_t>(std::floor(middle[axis] + reach)) + 1);
  }
  for (std::int64_t k = lower[2]; k < upper[2]; ++k) {
    for (std::int64_t j = lower[1]; j < upper[1]; ++j) {
      for (std::int64_t i = lower[0]; i < upper[0]; ++i) {
        const Vec3 d = g.world(vector_of(i, j, k)) - at;
        const double along = d.dot(normal);
        if (std::abs(along) > options.half_length_mm) continue;
        if ((d - along * normal).squaredNorm() > options.tube_radius_mm * options.tube_radius_mm) continue;
        out.samples.push_back({along, static_cast<double>(image(i, j, k))});
      }
    }
  }
  if (out.samples.size() < 12) return std::nullopt;
  const std::optional<Edge> edge = fit_edge(out.samples, options.half_length_mm);
  if (!edge) return std::nullopt;
  const double contrast = std::abs(edge->high - edge->low);
  const bool whole = std::abs(edge->place) + 1.5 * edge->sigma < options.half_length_mm;
  if (!whole || contrast < options.least_contrast_hu || edge->residual > options.most_residual * contrast)
    return std::nullopt;
  out.edge = *edge;
  return out;
}

/// Every `step`-th of so many places is looked at.
std::size_t step_of(std::size_t places, std::size_t most) {
  return std::max<std::size_t>(1, places / std::max<std::size_t>(most, 1));
}

/// A mean profile, in bins.
struct ProfileSum {
  static constexpr double bin_mm = 0.1;
  std::vector<double> sum, count;
  std::size_t edges = 0;
  explicit ProfileSum(double half_mm)
      : sum(static_cast<std::size_t>(2.0 * std::ceil(half_mm / bin_mm))), count(sum.size(), 0.0) {}
  double place(std::size_t bin) const {
    return bin_mm * (static_cast<double>(bin) + 0.5 - 0.5 * static_cast<double>(sum.size()));
  }
  void add(const GoodEdge& good) {
    const double height = good.edge.high - good.edge.low, sign = height > 0.0 ? 1.0 : -1.0;
    const double low = std::min(good.edge.low, good.edge.high);
    for (const Sample& s : good.samples) {
      const double at = sign * (s.at_mm - good.edge.place) / bin_mm + 0.5 * static_cast<double>(sum.size());
      if (at < 0.0 || at >= static_cast<double>(sum.size())) continue;
      sum[static_cast<std::size_t>(at)] += (s.hu - low) / std::abs(height);
      count[static_cast<std::size_t>(at)] += 1.0;
    }
    ++edges;
  }
  ProfileSum& operator+=(const ProfileSum& other) {
    for (std::size_t b = 0; b < sum.size(); ++b) {
      sum[b] += other.sum[b];
      count[b] += other.count[b];
    }
    edges += other.edges;
    return *this;
  }
};

/// From 0 to 1 on the two sides.
EdgeProfile profile_of(const ProfileSum& mean, double half_mm) {
  EdgeProfile out;
  out.edges = mean.edges;
  std::array<double, 2> side{}, weight{};
  for (std::size_t b = 0; b < mean.sum.size(); ++b) {
    if (std::abs(mean.place(b)) < 0.6 * half_mm) continue;
    side[mean.place(b) > 0.0] += mean.sum[b];
    weight[mean.place(b) > 0.0] += mean.count[b];
  }
  if (weight[0] == 0.0 || weight[1] == 0.0) return out;
  const double low = side[0] / weight[0], high = side[1] / weight[1];
  for (std::size_t b = 0; b < mean.sum.size(); ++b) {
    if (mean.count[b] == 0.0) continue;
    out.at_mm.push_back(mean.place(b));
    out.level.push_back((mean.sum[b] / mean.count[b] - low) / (high - low));
    if (out.at_mm.back() < 0.0) out.undershoot = std::max(out.undershoot, -out.level.back());
    if (out.at_mm.back() > 0.0) out.overshoot = std::max(out.overshoot, out.level.back() - 1.0);
  }
  return out;
}

}  // namespace

EdgeWidth edge_width(const imaging::ImageVolume& image,
                     const std::function<double(const Vec3&)>& signed_distance_mm, const EdgeOptions& options,
                     const core::TaskContext& task) {
  require_options(options);
  const Geometry& g = image.geometry;
  const double probe = 0.1 * g.spacing.minCoeff();
  std::vector<std::vector<Sample>> slices(static_cast<std::size_t>(g.size[2]));
  core::parallel_for(slices.size(), 1, [&](std::size_t k) {
    task.throw_if_cancelled();
    for (std::int64_t j = 0; j < g.size[1]; ++j) {
      for (std::int64_t i = 0; i < g.size[0]; ++i) {
        const Vec3 p = g.world(vector_of(i, j, static_cast<std::int64_t>(k)));
        const double d = signed_distance_mm(p);
        if (!(std::abs(d) <= options.half_length_mm)) continue;
        if (options.direction != EdgeDirection::any) {
          Vec3 gradient;
          for (int axis = 0; axis < 3; ++axis) {
            const Vec3 aside = probe * Vec3::Unit(axis);
            gradient[axis] = signed_distance_mm(p + aside) - signed_distance_mm(p - aside);
          }
          if (!(gradient.norm() > 0.0) || !wanted(options.direction, gradient, g)) continue;
        }
        slices[k].push_back({d, static_cast<double>(image(i, j, static_cast<std::int64_t>(k)))});
      }
    }
  });
  std::vector<Sample> samples;
  for (const auto& slice : slices) samples.insert(samples.end(), slice.begin(), slice.end());
  if (samples.size() < 50)
    throw InvalidInput("edge width: only " + std::to_string(samples.size()) +
                       " voxels lie near the boundary in the asked direction; 50 are needed");
  const std::optional<Edge> edge = fit_edge(samples, options.half_length_mm);
  if (!edge) throw NumericalError("edge width: there is no edge at the boundary");
  return {fwhm_per_sigma * edge->sigma,
          line_spread_fwhm(samples, *edge, options.half_length_mm),
          std::min(edge->low, edge->high),
          std::max(edge->low, edge->high),
          edge->place,
          edge->residual,
          samples.size()};
}

EdgeWidths edge_widths(const imaging::ImageVolume& image, const imaging::MaskVolume& mask,
                       const EdgeOptions& options, std::size_t most, const core::TaskContext& task) {
  require_options(options);
  require_same_grid(image, mask);
  const BoundaryPlaces boundary(mask, options.direction, task);
  const std::size_t step = step_of(boundary.places.size(), most);
  EdgeWidths result;
  result.tried = (boundary.places.size() + step - 1) / step;
  std::vector<double> widths(result.tried, 0.0);
  core::parallel_for(result.tried, 4, [&](std::size_t n) {
    task.throw_if_cancelled();
    if (const auto good = good_edge_at(image, boundary.smooth, boundary.places[n * step], options))
      widths[n] = fwhm_per_sigma * good->edge.sigma;
  });
  for (const double w : widths)
    if (w > 0.0) result.fwhm_mm.push_back(w);
  std::sort(result.fwhm_mm.begin(), result.fwhm_mm.end());
  const auto quantile = [&](double share) {
    if (result.fwhm_mm.empty()) return 0.0;
    return result
        .fwhm_mm[static_cast<std::size_t>(share * static_cast<double>(result.fwhm_mm.size() - 1) + 0.5)];
  };
  result.median_mm = quantile(0.5);
  result.p25_mm = quantile(0.25);
  result.p75_mm = quantile(0.75);
  return result;
}

EdgeProfile edge_profile(const imaging::ImageVolume& image, const imaging::MaskVolume& mask,
                         const EdgeOptions& options, std::size_t most, const core::TaskContext& task) {
  require_options(options);
  require_same_grid(image, mask);
  const BoundaryPlaces boundary(mask, options.direction, task);
  const std::size_t step = step_of(boundary.places.size(), most);
  const ProfileSum none(options.half_length_mm);
  const ProfileSum sum = core::parallel_reduce(
      (boundary.places.size() + step - 1) / step, 16, none,
      [&](std::size_t first, std::size_t last) {
        ProfileSum part = none;
        for (std::size_t n = first; n < last; ++n) {
          task.throw_if_cancelled();
          if (const auto good = good_edge_at(image, boundary.smooth, boundary.places[n * step], options))
            part.add(*good);
        }
        return part;
      },
      [](ProfileSum a, const ProfileSum& b) { return a += b; });
  return profile_of(sum, options.half_length_mm);
}

}  // namespace ostia::evaluation
