#include "outer_wall/profile.h"

#include "boundary/edge_profile.h"

#include "ostia/core/parallel.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::segmentation {
namespace {

constexpr double wall_disc_step_mm = 0.05;  // of the table of blurred discs
constexpr double noise_length_mm = 0.6;     // of the noise's Gaussian correlation
constexpr double wall_model_error_hu =
    10.0;                                 // of layered discs as a model, independent from sample to sample
constexpr double lumen_spread_hu = 15.0;  // of the lumen's level
constexpr double lumen_place_mm = 0.05;   // of the lumen's own edge
constexpr double fat_spread_hu = 20.0;    // of the fat's level
// Healthy walls are as thick as that; beyond, they get rarer by a normal deviate.
constexpr double thin_mm = 0.25, thick_mm = 0.9, rarer_mm = 0.15;
constexpr double anything_prior = 0.05, anything_hu = 60.0, anything_spread_hu = 150.0;
constexpr double anything_length_mm = 0.5;

using Matrix = Eigen::Matrix<double, WallProfile::samples, WallProfile::samples>;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, WallProfile::most_directions,
                            WallProfile::most_directions>;
using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, WallProfile::most_directions, 1>;

/// Correlated samples: variance and length of the correlation.
Matrix correlated(double spread, double length_mm, double step_mm) {
  Matrix out;
  for (int i = 0; i < WallProfile::samples; ++i)
    for (int j = 0; j < WallProfile::samples; ++j) {
      const double d = (i - j) * step_mm / length_mm;
      out(i, j) = spread * spread * std::exp(-0.5 * d * d);
    }
  return out;
}

}  // namespace

BlurredDiscs::BlurredDiscs(double largest_radius_mm, double reach_mm, double step_mm, double sigma_mm)
    : samples_(static_cast<int>(reach_mm / step_mm) + 2),
      radii_(static_cast<int>(largest_radius_mm / wall_disc_step_mm) + 3) {
  share_.resize(static_cast<std::size_t>(samples_) * radii_);
  core::parallel_for(static_cast<std::size_t>(radii_), 8, [&](std::size_t r) {
    for (int i = 0; i < samples_; ++i)
      share_[r * samples_ + i] =
          blurred_disc(static_cast<double>(r) * wall_disc_step_mm, i * step_mm, sigma_mm);
  });
}

double BlurredDiscs::at(double radius_mm, int sample) const {
  const double x = std::clamp(radius_mm / wall_disc_step_mm, 0.0, radii_ - 1.001);
  const int r = static_cast<int>(x);
  const double* column =
      share_.data() + static_cast<std::size_t>(r) * samples_ + std::min(sample, samples_ - 1);
  return column[0] + (x - r) * (column[samples_] - column[0]);
}

struct WallProfile::Window {
  const WallRay& ray;
  int start = 0;
  Samples lumen{}, lumen_step{};
};

WallProfile::WallProfile(const WallProfileOptions& options)
    : options_(options),
      discs_(options.grid.at(options.grid.count) + 1.5, options.grid.at(options.grid.count) + 2.5,
             options.sample_step_mm, options.blur_sigma_mm) {
  const double step = options.sample_step_mm, scale = step / 0.2;
  const Matrix noise = correlated(options.noise_hu, noise_length_mm * scale, step) +
                       wall_model_error_hu * wall_model_error_hu * Matrix::Identity();
  const Matrix anything = noise + correlated(anything_spread_hu, anything_length_mm * scale, step) +
                          anything_spread_hu * anything_spread_hu * Matrix::Ones();
  const Eigen::LLT<Matrix> factor(noise), other(anything);
  const Matrix white = factor.matrixL().solve(Matrix::Identity());
  const Matrix wide = other.matrixL().solve(Matrix::Identity());
  const Matrix lower = factor.matrixL(), other_lower = other.matrixL();
  for (int i = 0; i < samples; ++i) {
    anything_offset_ += std::log(other_lower(i, i)) - std::log(lower(i, i));
    for (int j = 0; j < samples; ++j) whitening_[i][j] = white(i, j), anything_[i][j] = wide(i, j);
  }
  anything_offset_ -= std::log(anything_prior);
  const Layer wall{0.0, 1.0, options.wall_hu, 25.0}, soft{0.0, 1.0, 35.0, 25.0};
  const Layer fibrous{0.0, 1.0, 95.0, 35.0};
  const auto rest = [](double from, double to) { return Layer{from, to, 75.0, 40.0}; };
  const auto calcium = [](double from, double to) { return Layer{from, to, 850.0, 300.0}; };
  for (const double fat_mm : {0.0, 0.7}) {
    const double share = fat_mm > 0.0 ? 0.3 : 1.0;
    const auto add = [&](double prior, bool healthy, double least_mm, std::vector<Layer> layers) {
      hypotheses_.push_back({share * prior, healthy, fat_mm, least_mm, std::move(layers)});
    };
    add(1.0, true, 0.0, {wall});
    add(0.15, false, 0.5, {soft});
    add(0.15, false, 0.5, {fibrous});
    add(0.02, false, 0.2, {calcium(0.0, 1.0)});
    add(0.02, false, 0.4, {rest(0.0, 0.3), calcium(0.3, 0.95)});
    add(0.02, false, 0.4, {calcium(0.0, 0.5), rest(0.5, 1.0)});
    add(0.02, false, 0.8, {rest(0.0, 0.3), calcium(0.3, 0.6), rest(0.6, 1.0)});
    add(0.02, false, 0.8, {rest(0.0, 0.5), calcium(0.5, 1.0)});
  }
}

WallProfile::Samples WallProfile::whitened(const Samples& values) const {
  Samples out{};
  for (int i = 0; i < samples; ++i) {
    double sum = 0.0;
    for (int j = 0; j <= i; ++j) sum += whitening_[i][j] * values[j];
    out[i] = sum;
  }
  return out;
}

double WallProfile::anything_energy(const WallRay& ray, int start) const {
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    double white = 0.0;
    for (int j = 0; j <= i; ++j)
      white += anything_[i][j] * (ray.hu[std::min(start + j, ray.count - 1)] - anything_hu);
    sum += white * white;
  }
  return 0.5 * sum + anything_offset_;
}

double WallProfile::marginal_energy(const Samples& residual, Directions& direction, int count) const {
  const Samples y = whitened(residual);
  for (int n = 0; n < count; ++n) direction[n] = whitened(direction[n]);
  Small gram = Small::Identity(count, count);
  Few along = Few::Zero(count);
  double square = 0.0;
  for (int i = 0; i < samples; ++i) {
    square += y[i] * y[i];
    for (int n = 0; n < count; ++n) {
      along[n] += direction[n][i] * y[i];
      for (int m = 0; m <= n; ++m) gram(n, m) += direction[n][i] * direction[m][i];
    }
  }
  const Eigen::LLT<Small> factor(gram);  // the lower half is read
  double half_log = 0.0;
  for (int n = 0; n < count; ++n) half_log += std::log(factor.matrixLLT()(n, n));
  const Few explained = factor.matrixL().solve(along);
  return 0.5 * (square - explained.squaredNorm()) + half_log;
}

double WallProfile::hypothesis_energy(const Hypothesis& hypothesis, const Window& window,
                                      double outer_mm) const {
  const WallRay& ray = window.ray;
  const double thick = outer_mm - ray.lumen_mm;
  const auto disc = [&](double radius_mm) {
    Samples out{};
    for (int i = 0; i < samples; ++i) out[i] = discs_.at(radius_mm, window.start + i);
    return out;
  };
  Samples residual{};
  for (int i = 0; i < samples; ++i)
    residual[i] = ray.hu[std::min(window.start + i, ray.count - 1)] - ray.lumen_hu * window.lumen[i];
  Directions direction;
  int count = 0;
  const auto add = [&](const Samples& inner, const Samples& outer, double hu, double spread) {
    Samples part{};
    for (int i = 0; i < samples; ++i) {
      part[i] = (outer[i] - inner[i]) * spread;
      residual[i] -= (outer[i] - inner[i]) * hu;
    }
    direction[count++] = part;
  };
  Samples inner = window.lumen;
  for (const Layer& layer : hypothesis.layers) {
    const Samples outer = disc(ray.lumen_mm + layer.to * thick);
    add(inner, outer, layer.hu, layer.spread_hu);
    inner = outer;
  }
  Samples all{};
  all.fill(1.0);
  if (hypothesis.fat_mm > 0.0) {
    const Samples fat = disc(outer_mm + hypothesis.fat_mm);
    add(inner, fat, ray.fat_hu, fat_spread_hu);
    add(fat, all, anything_hu, anything_spread_hu);
  } else {
    add(inner, all, ray.fat_hu, fat_spread_hu);
  }
  const double step = lumen_place_mm * (ray.lumen_hu - hypothesis.layers.front().hu);
  for (int i = 0; i < samples; ++i) {
    direction[count][i] = lumen_spread_hu * window.lumen[i];
    direction[count + 1][i] = step * window.lumen_step[i];
  }
  count += 2;
  double energy = marginal_energy(residual, direction, count) - std::log(hypothesis.prior);
  if (hypothesis.healthy) {
    const double off = std::max({0.0, thin_mm - thick, thick - thick_mm}) / rarer_mm;
    energy += 0.5 * off * off;
  }
  return energy;
}

RayEnergy WallProfile::energy(const WallRay& ray, double about_mm) const {
  const double step = options_.sample_step_mm, reach = 2.5 * step;
  const RadiusGrid& grid = options_.grid;
  Window window{ray, std::max(0, static_cast<int>(std::lround(about_mm / step)) - samples / 2), {}, {}};
  constexpr double h = 0.05;
  for (int i = 0; i < samples; ++i) {
    const int n = window.start + i;
    window.lumen[i] = discs_.at(ray.lumen_mm, n);
    window.lumen_step[i] = (discs_.at(ray.lumen_mm + h, n) - discs_.at(ray.lumen_mm - h, n)) / (2.0 * h);
  }
  const auto index = [&](double radius) { return (radius - grid.first_mm) / grid.step_mm; };
  const int lowest = static_cast<int>(std::ceil(index(ray.lumen_mm + options_.least_thickness_mm) - 1e-9));
  RayEnergy out;
  out.first = std::clamp(static_cast<int>(std::ceil(index(about_mm - reach))),
                         std::min(lowest, grid.count - 1), grid.count - 1);
  const int last =
      std::clamp(static_cast<int>(std::floor(index(about_mm + reach))), out.first, grid.count - 1);
  const double anything = anything_energy(ray, window.start);
  for (int k = out.first; k <= last; ++k) {
    const double thick = grid.at(k) - ray.lumen_mm;
    double least = anything;
    std::vector<double> all{anything};
    for (const Hypothesis& hypothesis : hypotheses_) {
      if (thick < hypothesis.least_mm) continue;
      all.push_back(hypothesis_energy(hypothesis, window, grid.at(k)));
      least = std::min(least, all.back());
    }
    double total = 0.0;
    for (const double one : all) total += std::exp(least - one);
    out.value.push_back(least - std::log(total));
  }
  return out;
}

}  // namespace ostia::segmentation
