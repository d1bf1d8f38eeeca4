#include "vesselness/tube_scales.h"

#include <algorithm>
#include <cmath>

namespace ostia::segmentation::detail {
namespace {

/// exp(-x) I_1(x) for x >= 0 (M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 9.8.3 and
/// 9.8.4), within 3e-7 of itself.
double scaled_bessel_1(double x) {
  if (x < 3.75) {
    const double t = x * x / (3.75 * 3.75);
    const double sum =
        0.5 +
        t * (0.87890594 +
             t * (0.51498869 + t * (0.15084934 + t * (0.02658733 + t * (0.00301532 + t * 0.00032411)))));
    return x * std::exp(-x) * sum;
  }
  const double t = 3.75 / x;
  const double end = 0.02282967 + t * (-0.02895312 + t * (0.01787654 - t * 0.00420059));
  const double sum =
      0.39894228 + t * (-0.03988024 + t * (-0.00362018 + t * (0.00163801 + t * (-0.01031555 + t * end))));
  return sum / std::sqrt(x);
}

/// How fast a disc blurred by a Gaussian darkens at `rho` from its centre: its border's normals, blurred.
double fall_of_disc(double rho, double radius, double blur) {
  const double t = blur * blur, gap = rho - radius;
  return radius / t * std::exp(-0.5 * gap * gap / t) * scaled_bessel_1(rho * radius / t);
}

/// Grows with the tube's radius or falls.
double growth(double ball, double tube, double blur) {
  const double h = 1e-2 * tube;
  return flux_of_tube(ball, tube + h, blur) - flux_of_tube(ball, tube - h, blur);
}

/// Where `f` crosses 0, of different signs at the ends.
template <class F>
double root(double low, double high, const F& f) {
  const bool rising = f(high) > 0.0;
  for (int n = 0; n < 22; ++n) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == rising ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

TubeScale flux_scale(double tube, double least_ball, double sigma, double blur) {
  TubeScale scale;
  scale.sigma_mm = sigma;
  if (growth(least_ball, tube, blur) >= 0.0) {  // thinner than can be told
    scale.ball_mm = least_ball;
    tube = root(tube, 2.0 * tube + 4.0 * (blur + least_ball),
                [&](double radius) { return growth(least_ball, radius, blur); });
  } else {
    scale.ball_mm =
        root(least_ball, 2.0 * tube + 2.0 * blur, [&](double ball) { return growth(ball, tube, blur); });
  }
  scale.radius_mm = tube;
  scale.factor = scale.ball_mm / 3.0 / flux_of_tube(scale.ball_mm, tube, blur);
  return scale;
}

TubeScale hessian_scale(double tube, double least_sigma, double image_blur) {
  TubeScale scale;
  const double least_t = least_sigma * least_sigma + image_blur * image_blur;
  const double t = std::max(0.5 * tube * tube, least_t);
  scale.radius_mm = std::sqrt(2.0 * t);
  scale.sigma_mm = std::sqrt(t - image_blur * image_blur);
  scale.factor = std::exp(1.0) * t;
  return scale;
}

}  // namespace

double flux_of_tube(double ball_mm, double tube_mm, double blur_mm) {
  constexpr int kSteps = 48;  // over a quarter; the integrand is smooth and periodic
  double sum = 0.0;
  for (int n = 1; n <= kSteps; ++n) {
    const double sine = std::sin(0.5 * M_PI * n / kSteps);
    const double end = n == kSteps ? 0.5 : 1.0;
    sum += end * sine * sine * fall_of_disc(ball_mm * sine, tube_mm, blur_mm);
  }
  return 0.25 * M_PI * sum / kSteps;
}

TubeScales::TubeScales(const VesselnessOptions& options, const geometry::Vec3& spacing_mm)
    : method_(options.method) {
  const double voxel = std::cbrt(spacing_mm.prod());
  const double sigma = options.flux_blur_voxels * voxel;
  blur_mm_ = std::hypot(sigma, options.image_blur_mm);
  for (const double radius : options.radii_mm) {
    const TubeScale scale = method_ == TubeMethod::flux
                                ? flux_scale(radius, 0.6 * voxel, sigma, blur_mm_)
                                : hessian_scale(radius, 0.7 * voxel, options.image_blur_mm);
    // Radii below what can be told all become the least that can.
    if (scales_.empty() || scale.radius_mm > 1.02 * scales_.back().radius_mm) scales_.push_back(scale);
  }
  for (std::size_t s = 0; s < scales_.size(); ++s) {
    const auto log_radius = [&](std::size_t n) { return std::log(scales_[n].radius_mm); };
    Parabola p{{1.0F, 1.0F}, static_cast<float>(log_radius(s))};
    if (s > 0) p.step[0] = static_cast<float>(log_radius(s) - log_radius(s - 1));
    if (s + 1 < scales_.size()) p.step[1] = static_cast<float>(log_radius(s + 1) - log_radius(s));
    parabolas_.push_back(p);
  }
  if (const std::size_t count = scales_.size(); count > 1) {
    end_ratio_[0] = static_cast<float>(ideal(scales_[1], scales_[0].radius_mm));
    end_ratio_[1] = static_cast<float>(ideal(scales_[count - 2], scales_[count - 1].radius_mm));
  }
  add_correction();
}

double TubeScales::ideal(const TubeScale& scale, double tube_mm) const {
  if (method_ == TubeMethod::flux)
    return 3.0 * scale.factor / scale.ball_mm * flux_of_tube(scale.ball_mm, tube_mm, blur_mm_);
  const double x = tube_mm * tube_mm / (scale.radius_mm * scale.radius_mm);
  return x * std::exp(1.0 - x);
}

/// The same for ideal tubes of known radii.
void TubeScales::add_correction() {
  constexpr int kPerScale = 16;
  std::vector<float> answers(scales_.size());
  std::vector<Measured> measured;
  for (std::size_t s = 0; s + 1 < scales_.size(); ++s) {
    for (int n = 0; n < kPerScale; ++n) {
      const double part = n / static_cast<double>(kPerScale);
      const double tube =
          scales_[s].radius_mm * std::pow(scales_[s + 1].radius_mm / scales_[s].radius_mm, part);
      std::fill(answers.begin(), answers.end(), 0.0F);
      const std::size_t first = s > 0 ? s - 1 : 0, last = std::min(s + 2, scales_.size() - 1);
      for (std::size_t at = first; at <= last; ++at)
        answers[at] = static_cast<float>(ideal(scales_[at], tube));
      const Raw raw = raw_peak(answers.data(), 1);
      if (!measured.empty() && raw.log_radius <= measured.back().said + 1e-5F) continue;
      measured.push_back({raw.log_radius, {1.0F / raw.response, static_cast<float>(tube)}});
    }
  }
  // The last scale itself, where there is no parabola.
  const float end = parabolas_.back().log_radius;
  while (!measured.empty() && measured.back().said >= end - 1e-5F) measured.pop_back();
  measured.push_back({end, {1.0F, static_cast<float>(scales_.back().radius_mm)}});
  tabulate(measured);
}

/// In even steps of what is said.
void TubeScales::tabulate(const std::vector<Measured>& measured) {
  constexpr int kSteps = 256;
  first_said_ = measured.front().said;
  const float span = std::max(measured.back().said - first_said_, 1e-6F);
  steps_per_log_ = kSteps / span;
  std::size_t above = 0;
  for (int n = 0; n <= kSteps; ++n) {
    const float said = first_said_ + span * static_cast<float>(n) / kSteps;
    while (above + 1 < measured.size() && measured[above].said < said) ++above;
    const Measured& high = measured[above];
    const Measured& low = measured[above > 0 ? above - 1 : 0];
    const float gap = high.said - low.said;
    const float part = gap > 0.0F ? std::clamp((said - low.said) / gap, 0.0F, 1.0F) : 1.0F;
    corrections_.push_back({low.is.response + part * (high.is.response - low.is.response),
                            low.is.radius_mm + part * (high.is.radius_mm - low.is.radius_mm)});
  }
}

TubeScales::Raw TubeScales::raw_peak(const float* answers, std::ptrdiff_t stride) const {
  std::ptrdiff_t best = 0;
  const auto count = static_cast<std::ptrdiff_t>(parabolas_.size());
  float most = answers[0];
  for (std::ptrdiff_t s = 1; s < count; ++s) {
    const float answer = answers[s * stride];
    best = answer > most ? s : best;
    most = answer > most ? answer : most;
  }
  const float* here = answers + best * stride;
  const Parabola& p = parabolas_[static_cast<std::size_t>(best)];
  const Raw as_is{*here, p.log_radius};
  const bool first = best == 0, last = best + 1 == count;
  if (*here <= 0.0F || (first && last)) return as_is;
  if (first || last) {  // half the way to the only neighbour when both answer alike
    const float ratio = (first ? here[stride] : here[-stride]) / *here;
    const float least = end_ratio_[last ? 1 : 0];
    const float shift = 0.5F * std::clamp((ratio - least) / (1.0F - least), 0.0F, 1.0F);
    return {*here, p.log_radius + (first ? shift * p.step[1] : -shift * p.step[0])};
  }
  const float below = (here[0] - here[-stride]) / p.step[0];  // slopes, rising and falling
  const float above = (here[stride] - here[0]) / p.step[1];
  const float bend = (above - below) / (p.step[0] + p.step[1]);
  if (!(bend < 0.0F)) return as_is;
  const float slope = (below * p.step[1] + above * p.step[0]) / (p.step[0] + p.step[1]);
  const float shift = std::clamp(-0.5F * slope / bend, -p.step[0], p.step[1]);
  return {*here + shift * (slope + shift * bend), p.log_radius + shift};
}

TubeScales::Peak TubeScales::peak(const float* answers, std::ptrdiff_t stride) const {
  const Raw raw = raw_peak(answers, stride);
  if (raw.response <= 0.0F) return {};
  const float at = std::max((raw.log_radius - first_said_) * steps_per_log_, 0.0F);
  const std::size_t low = std::min(static_cast<std::size_t>(at), corrections_.size() - 2);
  const float part = std::min(at - static_cast<float>(low), 1.0F);
  const Peak &a = corrections_[low], &b = corrections_[low + 1];
  return {raw.response * (a.response + part * (b.response - a.response)),
          a.radius_mm + part * (b.radius_mm - a.radius_mm)};
}

}  // namespace ostia::segmentation::detail
