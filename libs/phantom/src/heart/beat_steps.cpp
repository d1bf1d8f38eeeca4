#include "heart/beat_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

/// The left ventricle's axis beside the heart's, as a share of the half width: away from the right ventricle.
constexpr double axis_share = -0.22;

/// 1 below `from`, 0 above `to`.
ValueSlope fall(double x, double from, double to) {
  const ValueSlope s = smooth_step(x, from, to);
  return {1.0 - s.value, -s.slope};
}

struct Window {
  double value = 1.0;
  Vec3 gradient = Vec3::Zero();
};

/// How free a place is to move: 1 at the heart, 0 at the breastbone, the ribs (the inside of the chest as
/// body_thorax.cpp has it) and from the front of the spine on.
Window within_chest(const Vec3& p) {
  constexpr double middle_x = -8.0, middle_y = 16.0, half_x = 120.0, half_y = 87.5;
  constexpr double front_from = 0.6, front_to = 1.0, back_from = 32.0, back_to = 66.0;
  const double u = (p.x() - middle_x) / half_x, v = (p.y() - middle_y) / half_y;
  const double m = std::sqrt(u * u + v * v);
  const ValueSlope front = fall(m, front_from, front_to), back = fall(p.y(), back_from, back_to);
  Window w;
  w.value = front.value * back.value;
  if (front.slope != 0.0) w.gradient = front.slope * back.value / m * Vec3(u / half_x, v / half_y, 0.0);
  w.gradient.y() += front.value * back.slope;
  return w;
}

/// x with f(x).value = target; f rises everywhere. Newton's steps, halved intervals where they leave them.
template <class F>
double solved(double target, const F& f) {
  constexpr double reach_mm = 64.0, tolerance_mm = 1e-11;
  double low = target - reach_mm, high = target + reach_mm, x = target;
  for (int i = 0; i < 80; ++i) {
    const ValueSlope at = f(x);
    const double off = at.value - target;
    (off > 0.0 ? high : low) = x;
    double next = x - off / at.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::abs(next - x);
    x = next;
    if (change < tolerance_mm) break;
  }
  return x;
}

}  // namespace

BeatSteps::Local BeatSteps::local(const Vec3& p) const {
  const Vec3 l = frame_.axes.transpose() * (p - frame_.base);
  return {l.x() - axis_share * frame_.half_right_mm, l.y(), l.z()};
}

Vec3 BeatSteps::world(const Local& l) const {
  return frame_.base + frame_.axes * Vec3(l.right + axis_share * frame_.half_right_mm, l.up, l.along);
}

Vec3 BeatSteps::turned(const Vec3& p, double sense) const {
  if (state_.twist == 0.0) return p;
  const Local l = local(p);
  const double length = frame_.length_mm, rho = std::hypot(l.right, l.up);
  const double towards_apex = smooth_step(l.along, 0.05 * length, 0.85 * length).value;
  double degrees = amplitudes_.base_rotation_deg +
                   towards_apex * (amplitudes_.apex_rotation_deg - amplitudes_.base_rotation_deg);
  degrees *= smooth_step(l.along, -45.0, -5.0).value * fall(l.along, length, length + 30.0).value;
  // Near the apex the ribs are close.
  const double from = 32.0 - 18.0 * towards_apex, to = 70.0 - 44.0 * towards_apex;
  degrees *= fall(rho, from, to).value;
  // `right`, `up` and the long axis are left-handed: counter-clockwise seen from the apex is from up to
  // right.
  const double angle = -sense * state_.twist * degrees * std::numbers::pi / 180.0;
  if (angle == 0.0) return p;
  const double c = std::cos(angle), s = std::sin(angle);
  return world({c * l.right - s * l.up, s * l.right + c * l.up, l.along});
}

/// Where a place `rho` from the axis goes on its ray, whose direction is `unit` (with the place's height).
ValueSlope BeatSteps::contracted_radius(double rho, const Local& unit) const {
  constexpr double inner_from = 10.0, inner_to = 38.0, outer_from = 54.0, outer_to = 90.0;
  const double inside = amplitudes_.endocardial_contraction, outside = amplitudes_.epicardial_contraction;
  const double height = smooth_step(unit.along, -36.0, 24.0).value *
                        fall(unit.along, frame_.length_mm, frame_.length_mm + 26.0).value;
  const ValueSlope inner = fall(rho, inner_from, inner_to), outer = fall(rho, outer_from, outer_to);
  const Window chest = within_chest(world({rho * unit.right, rho * unit.up, unit.along}));
  const double chest_slope = chest.gradient.dot(frame_.axes * Vec3(unit.right, unit.up, 0.0));
  const double share = outside + (inside - outside) * inner.value;
  const double share_slope = (inside - outside) * inner.slope;
  const double amount = state_.contraction * height;
  const double k = amount * share * outer.value * chest.value;
  const double k_slope = amount * (share_slope * outer.value * chest.value +
                                   share * outer.slope * chest.value + share * outer.value * chest_slope);
  return {rho * (1.0 - k), 1.0 - k - rho * k_slope};
}

Vec3 BeatSteps::contracted(const Vec3& p, double* jacobian) const {
  if (jacobian != nullptr) *jacobian = 1.0;
  const Local l = local(p);
  const double rho = std::hypot(l.right, l.up);
  if (rho < 1e-12) {
    if (jacobian != nullptr) *jacobian = std::pow(contracted_radius(0.0, {1.0, 0.0, l.along}).slope, 2.0);
    return p;
  }
  const Local unit{l.right / rho, l.up / rho, l.along};
  const ValueSlope now = contracted_radius(rho, unit);
  if (jacobian != nullptr) *jacobian = now.value / rho * now.slope;
  return world({now.value * unit.right, now.value * unit.up, l.along});
}

Vec3 BeatSteps::before_contraction(const Vec3& p) const {
  const Local l = local(p);
  const double rho = std::hypot(l.right, l.up);
  if (rho < 1e-12) return p;
  const Local unit{l.right / rho, l.up / rho, l.along};
  const double before = solved(rho, [&](double x) { return contracted_radius(x, unit); });
  return world({before * unit.right, before * unit.up, l.along});
}

/// Where a place goes on its parallel to the long axis.
ValueSlope BeatSteps::descended_place(double along, const Local& at) const {
  constexpr double roof = -76.0, base = -12.0;  // the great vessels hold the atria's roof
  const double length = frame_.length_mm;
  const double right = at.right + axis_share * frame_.half_right_mm;
  const double q = std::hypot(right / frame_.half_right_mm, at.up / frame_.half_up_mm);
  const double excursion = amplitudes_.left_excursion_mm +
                           smooth_step(right, -0.5 * frame_.half_right_mm, frame_.half_right_mm).value *
                               (amplitudes_.right_excursion_mm - amplitudes_.left_excursion_mm);
  const double amount = state_.descent * excursion * fall(q, 1.3, 2.1).value;
  const ValueSlope above = smooth_step(along, roof, base), below = fall(along, -6.0, length + 6.0);
  const Window chest = within_chest(world({at.right, at.up, along}));
  const double chest_slope = chest.gradient.dot(frame_.axes.col(2));
  return {along + amount * above.value * below.value * chest.value,
          1.0 + amount * (above.slope * below.value * chest.value + above.value * below.slope * chest.value +
                          above.value * below.value * chest_slope)};
}

Vec3 BeatSteps::descended(const Vec3& p, double* jacobian) const {
  const Local l = local(p);
  const ValueSlope now = descended_place(l.along, l);
  if (jacobian != nullptr) *jacobian = now.slope;
  return world({l.right, l.up, now.value});
}

Vec3 BeatSteps::before_descent(const Vec3& p) const {
  const Local l = local(p);
  return world({l.right, l.up, solved(l.along, [&](double x) { return descended_place(x, l); })});
}

/// Where a place `way_mm` from `foot` along the shift's direction goes on that line.
ValueSlope BeatSteps::shifted_place(double way_mm, const Vec3& foot, const Vec3& direction) const {
  const Vec3 p = foot + way_mm * direction;
  const Vec3 from_middle = p - frame_.base - 0.3 * frame_.length_mm * frame_.axes.col(2);
  const double distance = from_middle.norm();
  const ValueSlope near = fall(distance, 0.6 * frame_.length_mm, 1.15 * frame_.length_mm);
  const Window chest = within_chest(p);
  const double near_slope = near.slope == 0.0 ? 0.0 : near.slope * from_middle.dot(direction) / distance;
  const double amount = state_.contraction * amplitudes_.shift_mm.norm();
  return {way_mm + amount * near.value * chest.value,
          1.0 + amount * (near_slope * chest.value + near.value * chest.gradient.dot(direction))};
}

Vec3 BeatSteps::shifted(const Vec3& p, double* jacobian) const {
  if (jacobian != nullptr) *jacobian = 1.0;
  const double size = amplitudes_.shift_mm.norm();
  if (size < 1e-12 || state_.contraction == 0.0) return p;
  const Vec3 direction = amplitudes_.shift_mm / size;
  const ValueSlope now = shifted_place(0.0, p, direction);
  if (jacobian != nullptr) *jacobian = now.slope;
  return p + now.value * direction;
}

Vec3 BeatSteps::before_shift(const Vec3& p) const {
  const double size = amplitudes_.shift_mm.norm();
  if (size < 1e-12 || state_.contraction == 0.0) return p;
  const Vec3 direction = amplitudes_.shift_mm / size;
  return p + solved(0.0, [&](double x) { return shifted_place(x, p, direction); }) * direction;
}

}  // namespace ostia::phantom
