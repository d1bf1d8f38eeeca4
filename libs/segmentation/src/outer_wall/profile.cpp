#include "outer_wall/profile.h"

#include "ostia/core/parallel.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::segmentation {
namespace {

using detail::wall_candidates, detail::wall_parts;

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

// What a ray is mixed of.
enum : int { lumen_part, lumen_step_part, all_part, ray_part, first_border_part, fat_part = wall_parts - 1 };
constexpr std::array<double, 5> borders{0.3, 0.5, 0.6, 0.95, 1.0};  // of layers, from lumen to outer border
static_assert(first_border_part + static_cast<int>(borders.size()) == fat_part);
constexpr std::size_t most_hypotheses = 16;
constexpr double fat_mm = 0.7;  // thickness of fat before something else

int border_part(double to) {
  return first_border_part +
         static_cast<int>(std::find(borders.begin(), borders.end(), to) - borders.begin());
}

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
      radii_(static_cast<int>(largest_radius_mm / wall_disc_step_mm) + 3),
      table_(disc_table(wall_disc_step_mm, step_mm, sigma_mm, radii_, samples_)) {}

double BlurredDiscs::share(int radius, int sample) const {
  return table_->at(radius, std::min(sample, samples_ - 1));
}

double BlurredDiscs::place(double radius_mm) const {
  return std::clamp(radius_mm / wall_disc_step_mm, 0.0, radii_ - 1.001);
}

double BlurredDiscs::at(double radius_mm, int sample) const {
  const double x = place(radius_mm);
  const int r = static_cast<int>(x);
  return share(r, sample) + (x - r) * (share(r + 1, sample) - share(r, sample));
}

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
  anything_weight_ = anything_prior;
  for (int i = 0; i < samples; ++i) {
    anything_weight_ *= lower(i, i) / other_lower(i, i);
    for (int j = 0; j < samples; ++j) whitening_[i][j] = white(i, j), anything_[i][j] = wide(i, j);
  }
  white_.resize(static_cast<std::size_t>(discs_.samples()) * discs_.radii());
  core::parallel_for(static_cast<std::size_t>(discs_.samples()), 4, [&](std::size_t start) {
    for (int r = 0; r < discs_.radii(); ++r) {
      Samples disc{};
      for (int i = 0; i < samples; ++i) disc[i] = discs_.share(r, static_cast<int>(start) + i);
      white_[start * discs_.radii() + r] = whitened(disc);
    }
  });
  const Layer wall{0.0, 1.0, options.wall_hu, 25.0}, soft{0.0, 1.0, 35.0, 25.0};
  const Layer fibrous{0.0, 1.0, 95.0, 35.0};
  const auto rest = [](double from, double to) { return Layer{from, to, 75.0, 40.0}; };
  const auto calcium = [](double from, double to) { return Layer{from, to, 850.0, 300.0}; };
  for (const bool something_beyond : {false, true}) {
    const auto add = [&](double prior, bool healthy, double least_mm, const std::vector<Layer>& layers) {
      add_hypothesis((something_beyond ? 0.3 : 1.0) * prior, healthy, least_mm, layers, something_beyond);
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

/// Deviations of the layers' levels, of the fat's, of what lies behind it, of the lumen's level and place.
void WallProfile::add_hypothesis(double prior, bool healthy, double least_mm,
                                 const std::vector<Layer>& layers, bool something_beyond) {
  Hypothesis out{prior, healthy, least_mm, {}, 0, layers.front().hu};
  detail::WallMixture& mixture = out.mixture;
  const auto add = [&](int outer, int inner, double hu, double spread) {
    mixture.direction[mixture.count++] = {outer, inner, hu, spread};
  };
  int inner = lumen_part;
  for (const Layer& layer : layers) {
    add(border_part(layer.to), inner, layer.hu, layer.spread_hu);
    inner = border_part(layer.to);
  }
  out.fat = mixture.count;
  add(something_beyond ? fat_part : all_part, inner, 0.0, fat_spread_hu);
  if (something_beyond) add(all_part, fat_part, anything_hu, anything_spread_hu);
  add(lumen_part, -1, 0.0, lumen_spread_hu);
  add(lumen_step_part, -1, 0.0, 0.0);
  hypotheses_.push_back(out);
}

int WallProfile::start_of(double about_mm) const {
  return std::max(0, static_cast<int>(std::lround(about_mm / options_.sample_step_mm)) - samples / 2);
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

WallProfile::Samples WallProfile::white_disc(double radius_mm, int start) const {
  const double x = discs_.place(radius_mm);
  const int r = static_cast<int>(x), row = std::min(start, discs_.samples() - 1);
  const Samples* table = white_.data() + static_cast<std::size_t>(row) * discs_.radii() + r;
  Samples out{};
  for (int i = 0; i < samples; ++i) out[i] = table[0][i] + (x - r) * (table[1][i] - table[0][i]);
  return out;
}

double WallProfile::anything_square(const WallRay& ray, int start) const {
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    double white = 0.0;
    for (int j = 0; j <= i; ++j)
      white += anything_[i][j] * (ray.hu[std::min(start + j, ray.count - 1)] - anything_hu);
    sum += white * white;
  }
  return sum;
}

void WallProfile::fill(const WallRay& ray, int start, int first, int count, detail::WallSamples& out) const {
  constexpr double h = 0.05;
  const Samples lumen = white_disc(ray.lumen_mm, start), more = white_disc(ray.lumen_mm + h, start),
                less = white_disc(ray.lumen_mm - h, start);
  Samples everywhere{}, hu{};
  everywhere.fill(1.0);
  for (int i = 0; i < samples; ++i) hu[i] = ray.hu[std::min(start + i, ray.count - 1)];
  everywhere = whitened(everywhere);
  hu = whitened(hu);
  const int padded = (count + 3) / 4 * 4;  // whole packs are worked out
  for (int c = 0; c < padded; ++c) {
    const auto put = [&](int part, const Samples& samples_of_it) {
      for (int i = 0; i < samples; ++i) out.value[part][i][c] = samples_of_it[i];
    };
    for (int i = 0; i < samples; ++i) {
      out.value[lumen_part][i][c] = lumen[i];
      out.value[lumen_step_part][i][c] = (more[i] - less[i]) / (2.0 * h);
      out.value[ray_part][i][c] = hu[i] - ray.lumen_hu * lumen[i];
    }
    put(all_part, everywhere);
    const double outer_mm = options_.grid.at(first + std::min(c, count - 1));
    const double thick = outer_mm - ray.lumen_mm;
    for (std::size_t b = 0; b < borders.size(); ++b)
      put(first_border_part + static_cast<int>(b), white_disc(ray.lumen_mm + borders[b] * thick, start));
    put(fat_part, white_disc(outer_mm + fat_mm, start));
  }
}

RayEnergy WallProfile::no_energy(const WallRay& ray, double about_mm) const {
  const double reach = 2.5 * options_.sample_step_mm;
  const RadiusGrid& grid = options_.grid;
  const auto index = [&](double radius) { return (radius - grid.first_mm) / grid.step_mm; };
  const int lowest = static_cast<int>(std::ceil(index(ray.lumen_mm + options_.least_thickness_mm) - 1e-9));
  RayEnergy out;
  out.first = std::clamp(static_cast<int>(std::ceil(index(about_mm - reach))),
                         std::min(lowest, grid.count - 1), grid.count - 1);
  const int last =
      std::clamp(static_cast<int>(std::floor(index(about_mm + reach))), out.first, grid.count - 1);
  out.value.assign(static_cast<std::size_t>(last - out.first + 1), 0.0);
  return out;
}

RayEnergy WallProfile::energy(const WallRay& ray, double about_mm) const {
  RayEnergy out = no_energy(ray, about_mm);
  const int start = start_of(about_mm), all = static_cast<int>(out.value.size());
  const auto hypotheses = static_cast<int>(hypotheses_.size());
  const double anything = anything_square(ray, start);
  std::array<detail::WallMixture, most_hypotheses> mixtures;
  for (int h = 0; h < hypotheses; ++h) {
    const Hypothesis& one = hypotheses_[h];
    mixtures[h] = one.mixture;
    mixtures[h].direction[one.fat].hu = ray.fat_hu;
    mixtures[h].direction[one.mixture.count - 1].spread = lumen_place_mm * (ray.lumen_hu - one.first_hu);
  }
  detail::WallSamples parts;
  double square[most_hypotheses][wall_candidates], determinant[most_hypotheses][wall_candidates];
  for (int from = 0; from < all; from += wall_candidates) {
    const int count = std::min(wall_candidates, all - from);
    fill(ray, start, out.first + from, count, parts);
    detail::wall_loop()(parts, ray_part, count, mixtures.data(), hypotheses, square, determinant);
    for (int c = 0; c < count; ++c) {
      const double thick = options_.grid.at(out.first + from + c) - ray.lumen_mm;
      const double off = std::max({0.0, thin_mm - thick, thick - thick_mm}) / rarer_mm;
      double least = anything;
      for (int h = 0; h < hypotheses; ++h) {
        if (hypotheses_[h].healthy) square[h][c] += off * off;
        if (thick >= hypotheses_[h].least_mm) least = std::min(least, square[h][c]);
      }
      double total = anything_weight_ * std::exp(0.5 * (least - anything));
      for (int h = 0; h < hypotheses; ++h)
        if (thick >= hypotheses_[h].least_mm)
          total +=
              hypotheses_[h].prior / std::sqrt(determinant[h][c]) * std::exp(0.5 * (least - square[h][c]));
      out.value[static_cast<std::size_t>(from + c)] = 0.5 * least - std::log(total);
    }
  }
  return out;
}

}  // namespace ostia::segmentation
