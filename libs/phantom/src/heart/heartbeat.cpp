#include "ostia/phantom/heartbeat.h"

#include "body/smooth_step.h"
#include "heart/beat_steps.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::phantom {
namespace {

using geometry::Mat3;

// Of the cycle, percent: when the parts of the beat begin and how long they last.
constexpr double atria_from = 82.0, atria_to = 97.0;
constexpr double rest_at_end_systole = 5.0, filling_lasts = 26.0;
constexpr double untwisting_lasts = 17.0;
/// Slow filling in mid-diastole, as a share of the whole path.
constexpr double slow_share = 0.03;

constexpr std::uint64_t first_beat_index = 0x42454154000000;  // of the seed's numbers
constexpr double difference_mm = 1e-3;

void require_beat(double value, double least, double most, const char* what) {
  if (!(value >= least && value <= most))
    throw InvalidInput(std::string("heartbeat: ") + what + " is " + std::to_string(value) +
                       "; it must lie in [" + std::to_string(least) + ", " + std::to_string(most) + "]");
}

double step(double x, double from, double to) {
  return smooth_step(x, from, to).value;
}

}  // namespace

BeatAmplitudes draw_beat(std::uint64_t seed) {
  std::uint64_t index = first_beat_index;
  const auto about = [&](double mean, double deviation) {
    return mean + deviation * std::clamp(normal(seed, index++), -2.0, 2.0);
  };
  BeatAmplitudes a;
  a.heart_rate_per_min = about(60.0, 4.0);
  a.left_excursion_mm = about(12.5, 1.0);
  a.right_excursion_mm = about(18.5, 1.2);
  a.atrial_share = about(0.12, 0.015);
  a.epicardial_contraction = about(0.08, 0.008);
  a.endocardial_contraction = about(0.28, 0.02);
  a.base_rotation_deg = about(-3.75, 0.8);
  a.apex_rotation_deg = about(9.6, 1.5);
  a.shift_mm = Vec3(about(-1.2, 0.4), about(0.6, 0.4), about(-2.2, 0.4));
  a.end_systole_percent = about(34.5, 0.7);
  return a;
}

void validate(const BeatAmplitudes& a) {
  require_beat(a.heart_rate_per_min, 20.0, 240.0, "the heart rate (1/min)");
  require_beat(a.left_excursion_mm, 0.0, 20.0, "the path of the left base (mm)");
  require_beat(a.right_excursion_mm, 0.0, 28.0, "the path of the right base (mm)");
  require_beat(a.atrial_share, 0.0, 0.4, "the share of the atria's contraction");
  require_beat(a.epicardial_contraction, 0.0, 0.2, "the epicardium's contraction");
  require_beat(a.endocardial_contraction, a.epicardial_contraction, 0.5, "the endocardium's contraction");
  require_beat(a.base_rotation_deg, -20.0, 20.0, "the base's rotation (degrees)");
  require_beat(a.apex_rotation_deg, -30.0, 30.0, "the apex's rotation (degrees)");
  require_beat(a.shift_mm.norm(), 0.0, 8.0, "the shift (mm)");
  require_beat(a.end_systole_percent, 30.0, 38.5, "the end of systole (percent)");
}

BeatState beat_state(const BeatAmplitudes& a, double percent) {
  // From the template's rest on, so that no part of the beat runs over the seam.
  constexpr double seam = 70.0;
  double p = std::fmod(percent - seam, 100.0);
  if (p < 0.0) p += 100.0;
  p += seam;
  const double systole_to = 100.0 + a.end_systole_percent;
  const double filling_from = systole_to + rest_at_end_systole;
  const double down = 1.0 - a.atrial_share;
  BeatState state;
  state.descent = step(p, atria_to, systole_to) - a.atrial_share * step(p, atria_from, atria_to) -
                  down * step(p, filling_from, filling_from + filling_lasts);
  state.contraction = state.descent / down;
  state.descent += slow_share * std::sin(2.0 * std::numbers::pi * (p - template_percent) / 100.0);
  state.twist =
      step(p, atria_to + 2.0, systole_to) - step(p, systole_to + 1.0, systole_to + 1.0 + untwisting_lasts);
  return state;
}

BeatPhase::BeatPhase(const BeatFrame& frame, const BeatAmplitudes& amplitudes, double percent)
    : frame_(frame), amplitudes_(amplitudes), state_(beat_state(amplitudes, percent)), percent_(percent) {
  still_ = state_.descent == 0.0 && state_.contraction == 0.0 && state_.twist == 0.0;
}

Vec3 BeatPhase::at(const Vec3& template_point) const {
  if (still_) return template_point;
  const BeatSteps steps(frame_, amplitudes_, state_);
  return steps.shifted(steps.descended(steps.contracted(steps.turned(template_point, 1.0))));
}

Vec3 BeatPhase::template_of(const Vec3& point) const {
  if (still_) return point;
  const BeatSteps steps(frame_, amplitudes_, state_);
  return steps.turned(steps.before_contraction(steps.before_descent(steps.before_shift(point))), -1.0);
}

double BeatPhase::jacobian(const Vec3& template_point) const {
  if (still_) return 1.0;
  const BeatSteps steps(frame_, amplitudes_, state_);
  double all = 1.0, one = 1.0;
  Vec3 p = steps.contracted(steps.turned(template_point, 1.0), &one);  // a turn keeps volumes
  all *= one;
  p = steps.descended(p, &one);
  all *= one;
  steps.shifted(p, &one);
  return all * one;
}

Mat3 BeatPhase::gradient(const Vec3& template_point) const {
  if (still_) return Mat3::Identity();
  Mat3 out;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 d = difference_mm * Vec3::Unit(axis);
    out.col(axis) = (at(template_point + d) - at(template_point - d)) / (2.0 * difference_mm);
  }
  return out;
}

double BeatPhase::growth_across(const Vec3& template_point, const Vec3& tangent) const {
  if (still_) return 1.0;
  const Mat3 f = gradient(template_point);
  return std::sqrt(f.determinant() / (f * tangent).norm());
}

Heartbeat::Heartbeat(const HeartShape& heart, const BeatAmplitudes& amplitudes) : amplitudes_(amplitudes) {
  validate(amplitudes);
  frame_.base = heart.base;
  frame_.axes << heart.right, heart.up, heart.long_axis;
  frame_.half_right_mm = heart.half_width_right_mm;
  frame_.half_up_mm = heart.half_width_up_mm;
  frame_.length_mm = heart.length_mm;
}

Heartbeat draw_heartbeat(const HeartShape& heart, std::uint64_t seed) {
  return {heart, draw_beat(seed)};
}

std::vector<Vec3> moved(const std::vector<Vec3>& points, const BeatPhase& phase) {
  std::vector<Vec3> out(points.size());
  core::parallel_for(points.size(), 1024, [&](std::size_t i) { out[i] = phase.at(points[i]); });
  return out;
}

geometry::TriMesh moved(const geometry::TriMesh& mesh, const BeatPhase& phase) {
  return {moved(mesh.points, phase), mesh.triangles};
}

}  // namespace ostia::phantom
