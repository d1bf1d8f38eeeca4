#include "boundary/edge_profile.h"

#include "ostia/core/parallel.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::segmentation {
namespace {

constexpr double model_error_hu = 10.0;  // of the layered disc as a model, independent from sample to sample
constexpr double disc_step_mm = 0.025;   // of the table of blurred discs
constexpr double endless_mm = 3.0;       // thickness that stands for "as far as the ray is looked at"

constexpr std::size_t most_hypotheses = 32;

constexpr double thickness_spread = 0.25;  // of a layer's thickness, as a share of it

/// A layer behind the lumen: as thick as this, of a tissue.
struct Layer {
  double thickness_mm = 0.0;
  double hu = 0.0, spread_hu = 0.0;
};
struct Hypothesis {
  double prior = 1.0;
  bool calcium = false;
  std::vector<Layer> layers;
};

std::vector<Hypothesis> hypotheses(double wall_hu, double wall_spread) {
  const auto wall = [&](double t) { return Layer{t, wall_hu, wall_spread}; };
  const auto plaque = [](double t) { return Layer{t, 75.0, 40.0}; };
  const Layer fat{endless_mm, -90.0, 35.0}, muscle{endless_mm, 90.0, 50.0}, blood{endless_mm, 250.0, 120.0};
  const Layer mixed{endless_mm, 0.0, 90.0};
  std::vector<Hypothesis> out;
  for (const double t : {0.25, 0.4, 0.6, 0.9}) out.push_back({1.0, false, {wall(t), fat}});
  for (const double t : {0.7, 1.1}) out.push_back({0.4, false, {plaque(t), fat}});
  out.push_back({0.4, false, {plaque(endless_mm)}});
  out.push_back({0.5, false, {wall(0.4), muscle}});
  for (const double t : {0.3, 0.6, 1.0}) out.push_back({0.2, false, {wall(t), blood}});
  out.push_back({0.02, false, {blood}});
  for (const double gap : {0.0, 0.25, 0.5}) {
    for (const double t : {0.25, 0.5, 0.8, 1.2}) {
      Hypothesis h{0.03, true, {}};
      if (gap > 0.0) h.layers.push_back(plaque(gap));
      h.layers.push_back({t, 850.0, 250.0});
      h.layers.push_back(mixed);
      out.push_back(h);
    }
  }
  return out;
}

double normal_distribution(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// blurred_disc at first_mm, first_mm + step_mm, ...: `count` of them.
std::vector<double> blurred_disc_from(double first_mm, double radius_mm, double step_mm, int count,
                                      double sigma_mm) {
  std::vector<double> sums(static_cast<std::size_t>(count), 0.0);
  if (radius_mm <= 0.0) return sums;
  // Strips parallel to the ray: each an interval blurred along it, weighted across it.
  constexpr int strips = 48;
  const double reach = std::min(radius_mm, 5.0 * sigma_mm);
  for (int i = 0; i < strips; ++i) {
    // midpoints in the angle, so that the strips crowd where the disc ends
    const double phi = (i + 0.5) / strips * 0.5 * std::numbers::pi;
    const double y = reach * std::sin(phi), dy = reach * std::cos(phi) * 0.5 * std::numbers::pi / strips;
    const double half = std::sqrt(std::max(0.0, radius_mm * radius_mm - y * y));
    const double across =
        std::exp(-0.5 * y * y / (sigma_mm * sigma_mm)) / (sigma_mm * std::sqrt(2.0 * std::numbers::pi));
    for (int n = 0; n < count; ++n) {
      const double rho = first_mm + n * step_mm;
      sums[static_cast<std::size_t>(n)] +=
          2.0 * dy * across *
          (normal_distribution((half - rho) / sigma_mm) - normal_distribution((-half - rho) / sigma_mm));
    }
  }
  return sums;
}

}  // namespace

std::vector<double> blurred_disc(double radius_mm, double step_mm, int count, double sigma_mm) {
  return blurred_disc_from(0.0, radius_mm, step_mm, count, sigma_mm);
}

double blurred_disc(double radius_mm, double rho_mm, double sigma_mm) {
  return blurred_disc_from(rho_mm, radius_mm, 0.0, 1, sigma_mm)[0];
}

int EdgeProfile::window(double radius_mm) const {
  return std::max(0, static_cast<int>(std::lround((radius_mm - window_mm()) / options_.sample_step_mm)));
}

void EdgeProfile::candidates(double radius_mm, int& first, int& last) const {
  const double at = (radius_mm - options_.first_mm) / options_.radius_step_mm;
  const double reach = reach_mm() / options_.radius_step_mm;
  first = std::clamp(static_cast<int>(std::ceil(at - reach)), 0, options_.radii - 1);
  last = std::clamp(static_cast<int>(std::floor(at + reach)), first, options_.radii - 1);
}

int EdgeProfile::lowest_start(int candidate) const {
  return window(radius(candidate) - reach_mm());
}

double EdgeProfile::disc(double radius_mm, int sample) const {
  const double at = std::min(radius_mm / disc_step_mm, discs_->radii - 1.001);
  const int i = static_cast<int>(at);
  const double t = at - i;
  return (1.0 - t) * discs_->at(i, sample) + t * discs_->at(i + 1, sample);
}

struct EdgeProfile::Build {
  using Matrix = Eigen::Matrix<double, samples, samples>;
  using Vector = Eigen::Matrix<double, samples, 1>;
  const EdgeProfile& profile;
  Matrix noise;

  explicit Build(const EdgeProfile& of);
  Vector share(double radius_mm, int start) const;
  /// Puts a hypothesis into its lane.
  void normal(const Hypothesis& hypothesis, double radius_mm, int start, detail::EdgeNormals& group,
              int lane) const;
  Candidate candidate(const std::vector<Hypothesis>& all, int number) const;
};

EdgeProfile::Build::Build(const EdgeProfile& of) : profile(of) {
  const EdgeProfileOptions& o = of.options_;
  for (int i = 0; i < samples; ++i) {
    for (int j = 0; j < samples; ++j) {
      const double d = (i - j) * o.sample_step_mm / o.noise_length_mm;
      noise(i, j) = o.noise_hu * o.noise_hu * std::exp(-0.5 * d * d);
    }
    noise(i, i) += model_error_hu * model_error_hu;
  }
}

/// Of a disc of a radius in each sample of the window.
EdgeProfile::Build::Vector EdgeProfile::Build::share(double radius_mm, int start) const {
  Vector out;
  for (int i = 0; i < samples; ++i)
    out[i] = profile.disc(radius_mm, std::min(start + i, profile.discs_->samples - 1));
  return out;
}

/// Samples' distribution: rings of tissue between blurred discs; levels and thicknesses are normal and enter
/// the covariance.
void EdgeProfile::Build::normal(const Hypothesis& hypothesis, double radius_mm, int start,
                                detail::EdgeNormals& group, int lane) const {
  const Vector lumen = share(radius_mm, start);
  const double spread = profile.options_.lumen_spread_hu;
  Vector mean = Vector::Zero(), inner = lumen;
  Matrix covariance = noise + spread * spread * lumen * lumen.transpose();
  double outer_radius = radius_mm;
  for (std::size_t i = 0; i < hypothesis.layers.size(); ++i) {
    const Layer& layer = hypothesis.layers[i];
    const bool last = i + 1 == hypothesis.layers.size();
    outer_radius += layer.thickness_mm;
    const Vector outer = last ? Vector::Ones() : share(outer_radius, start);
    const Vector part = outer - inner;
    mean += layer.hu * part;
    covariance += layer.spread_hu * layer.spread_hu * part * part.transpose();
    if (!last) {  // thicknesses between those tried, to first order
      const double h = 0.05, step = layer.hu - hypothesis.layers[i + 1].hu;
      const Vector shift = thickness_spread * layer.thickness_mm * step / (2.0 * h) *
                           (share(outer_radius + h, start) - share(outer_radius - h, start));
      covariance += shift * shift.transpose();
    }
    inner = outer;
  }
  const Eigen::LLT<Matrix> factor(covariance);
  const Matrix lower = factor.matrixL();
  const Matrix whitening = factor.matrixL().solve(Matrix::Identity());
  double half_log = 0.0;
  for (int i = 0, at = 0; i < samples; ++i) {
    group.mean[i][lane] = static_cast<float>(mean[i]);
    half_log += std::log(lower(i, i));
    for (int j = 0; j <= i; ++j, ++at) group.whitening[at][lane] = static_cast<float>(whitening(i, j));
  }
  group.offset[lane] = static_cast<float>(half_log) - static_cast<float>(std::log(hypothesis.prior));
}

EdgeProfile::Candidate EdgeProfile::Build::candidate(const std::vector<Hypothesis>& all, int number) const {
  const double radius_mm = profile.radius(number);
  const int lowest = profile.lowest_start(number), groups = profile.groups_;
  Candidate out;
  out.normals.resize(static_cast<std::size_t>(profile.starts_) * groups);
  for (int d = 0; d < profile.starts_; ++d) {
    for (const double part : share(radius_mm, lowest + d)) out.lumen.push_back(static_cast<float>(part));
    for (int n = 0; n < profile.hypotheses_; ++n)
      normal(all[n], radius_mm, lowest + d, out.normals[d * groups + n / detail::edge_lanes],
             n % detail::edge_lanes);
  }
  return out;
}

EdgeProfile::EdgeProfile(const EdgeProfileOptions& options) : options_(options) {
  const double largest = radius(options_.radii - 1), h = options_.sample_step_mm;
  discs_ = disc_table(disc_step_mm, h, options_.blur_sigma_mm,
                      static_cast<int>((largest + endless_mm + 2.0) / disc_step_mm) + 2,
                      static_cast<int>((largest + reach_mm() + window_mm()) / h) + samples + 2);
  for (const Hypothesis& one : hypotheses(options_.wall_hu, options_.wall_spread_hu))
    calcium_.push_back(one.calcium ? 1 : 0);
  hypotheses_ = static_cast<int>(calcium_.size());
  groups_ = (hypotheses_ + detail::edge_lanes - 1) / detail::edge_lanes;
  starts_ = static_cast<int>(2.0 * reach_mm() / h) + 2;
  candidates_.resize(static_cast<std::size_t>(options_.radii));
}

void EdgeProfile::prepare(const std::vector<double>& radius_mm) {
  std::vector<char> wanted(candidates_.size(), 0);
  for (const double radius : radius_mm) {
    int first = 0, last = 0;
    candidates(radius, first, last);
    std::fill(wanted.begin() + first, wanted.begin() + last + 1, 1);
  }
  const std::vector<Hypothesis> all = hypotheses(options_.wall_hu, options_.wall_spread_hu);
  const Build build(*this);
  core::parallel_for(candidates_.size(), 2, [&](std::size_t n) {
    if (wanted[n] && candidates_[n].normals.empty())
      candidates_[n] = build.candidate(all, static_cast<int>(n));
  });
}

double EdgeProfile::energy(const float* ray, int start, int candidate, double lumen_hu,
                           double calcium_odds) const {
  const int d = std::clamp(start - lowest_start(candidate), 0, starts_ - 1);
  const Candidate& of = candidates_[static_cast<std::size_t>(candidate)];
  float lumen[samples];
  for (int i = 0; i < samples; ++i)
    lumen[i] = static_cast<float>(lumen_hu) * of.lumen[static_cast<std::size_t>(d) * samples + i];
  std::array<float, most_hypotheses> energy;
  detail::edge_loop()(of.normals.data() + static_cast<std::size_t>(d) * groups_, groups_, ray + start, lumen,
                      energy.data());
  const auto bonus = static_cast<float>(std::log(calcium_odds));
  float least = std::numeric_limits<float>::max();
  for (int n = 0; n < hypotheses_; ++n) {
    energy[n] -= calcium_[n] ? bonus : 0.0F;
    least = std::min(least, energy[n]);
  }
  float total = 0.0F;
  for (int n = 0; n < hypotheses_; ++n) total += std::exp(least - energy[n]);
  return least - std::log(total);
}

}  // namespace ostia::segmentation
