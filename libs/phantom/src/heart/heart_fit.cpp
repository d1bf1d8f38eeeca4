#include "heart/heart_fit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Mat3;
using Parameters = Eigen::Matrix<double, 9, 1>;  // rotation vector, shift, logarithms of the sizes

constexpr double height_mm = 3.0, groove_mm = 6.0, ostium_mm = 6.0, size_share = 0.08;
constexpr double farthest_mm = 25.0;  // what is farther off counts as that

HeartFit fit_of(const Parameters& p, const HeartFit& start, const Vec3& centre) {
  HeartFit fit;
  const Vec3 turn = p.head<3>();
  const double angle = turn.norm();
  const Mat3 more =
      angle > 0.0 ? Eigen::AngleAxisd(angle, Vec3(turn / angle)).toRotationMatrix() : Mat3(Mat3::Identity());
  fit.rotation = more * start.rotation;
  fit.shift = start.shift + p.segment<3>(3) + (start.rotation * centre - fit.rotation * centre);
  for (int a = 0; a < 3; ++a) fit.size[a] = std::exp(p[6 + a]);
  return fit;
}

/// Signed, mm: how far a mark is above its usual height, and beside its groove.
struct Off {
  double height = 0.0, groove = 0.0;
};
Off off_of(const HeartShape& heart, const HeartFit& fit, const CourseMark& mark) {
  const HeartPlace place = heart_place(heart, resized(heart, fit, fit.placed(mark.world)));
  Off off;
  off.height =
      std::clamp(place.outwards_mm - usual_height_mm(heart, mark.groove, place), -farthest_mm, farthest_mm);
  const HeartPlace groove = in_groove(heart, mark.groove, place);
  const double wide = std::sqrt(std::max(0.05, 1.0 - place.depth * place.depth));
  off.groove =
      (place.phi_rad - groove.phi_rad) * wide * 0.5 * (heart.half_width_right_mm + heart.half_width_up_mm);
  if (mark.groove == Groove::atrioventricular) off.groove = (place.depth - groove.depth) * heart.length_mm;
  off.groove = std::clamp(off.groove, -farthest_mm, farthest_mm);
  return off;
}

Eigen::VectorXd residuals(const HeartShape& heart, const HeartFit& fit, const Parameters& p,
                          const std::vector<CourseMark>& marks, const Ostia* patient) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(2 * marks.size() + 6 + 6));
  Eigen::Index n = 0;
  for (const CourseMark& mark : marks) {
    const Off off = off_of(heart, fit, mark);
    // Marks of one vessel are not independent.
    out[n++] = 0.4 * mark.weight * off.height / height_mm;
    out[n++] = 0.4 * mark.weight * off.groove / groove_mm;
  }
  const Ostia usual = usual_ostia(heart.root);
  for (const bool left : {true, false}) {
    Vec3 away = Vec3::Zero();
    if (patient != nullptr)
      away = resized(heart, fit, fit.placed(left ? patient->left : patient->right)) -
             (left ? usual.left : usual.right);
    for (int a = 0; a < 3; ++a) out[n++] = away[a] / ostium_mm;
  }
  for (int a = 0; a < 3; ++a) out[n++] = p[6 + a] / size_share;
  constexpr double usual_turn = 20.0 * std::numbers::pi / 180.0;
  for (int a = 0; a < 3; ++a) out[n++] = p[a] / usual_turn;
  return out;
}

}  // namespace

Vec3 resized(const HeartShape& heart, const HeartFit& fit, const Vec3& placed) {
  const Vec3 d = placed - heart.base;
  return heart.base + d.dot(heart.right) / fit.size.x() * heart.right +
         d.dot(heart.up) / fit.size.y() * heart.up + d.dot(heart.long_axis) / fit.size.z() * heart.long_axis;
}

Vec3 unresized(const HeartShape& heart, const HeartFit& fit, const Vec3& own) {
  HeartFit back;
  back.size = fit.size.cwiseInverse();
  return resized(heart, back, own);
}

Ostia usual_ostia(const AorticRoot& root) {
  const Vec3 level = root.annulus + 0.62 * root.sinus_height_mm * root.axis;
  return {level + (root.sinus_radius_mm - 0.6) * root.left_sinus,
          level + (root.sinus_radius_mm - 0.6) * root.right_sinus};
}

Mat3 turned_to_heart(const HeartShape& heart, const Vec3& long_axis) {
  if (long_axis.norm() < 0.5) return Mat3::Identity();
  return Eigen::Quaterniond::FromTwoVectors(long_axis, heart.long_axis).toRotationMatrix();
}

HeartFit fit_heart(const HeartShape& heart, const std::vector<CourseMark>& marks, const Ostia* patient,
                   const Vec3& long_axis) {
  HeartFit start;
  start.rotation = turned_to_heart(heart, long_axis);
  const Ostia usual = usual_ostia(heart.root);
  Vec3 centre = Vec3::Zero();
  for (const CourseMark& mark : marks) centre += mark.world / static_cast<double>(marks.size());
  start.shift = heart.base + 0.25 * heart.length_mm * heart.long_axis - start.rotation * centre;
  if (patient != nullptr)
    start.shift =
        0.5 * (usual.left + usual.right) - start.rotation * (0.5 * (patient->left + patient->right));

  Parameters p = Parameters::Zero();
  const auto at = [&](const Parameters& q) {
    return residuals(heart, fit_of(q, start, centre), q, marks, patient);
  };
  Eigen::VectorXd r = at(p);
  double damping = 1e-2;
  for (int round = 0; round < 60 && damping < 1e8; ++round) {
    Eigen::MatrixXd slope(r.size(), 9);
    for (int k = 0; k < 9; ++k) {
      const double h = k >= 3 && k < 6 ? 1e-3 : 1e-5;
      Parameters more = p, less = p;
      more[k] += h;
      less[k] -= h;
      slope.col(k) = (at(more) - at(less)) / (2.0 * h);
    }
    const Eigen::Matrix<double, 9, 9> normal = slope.transpose() * slope;
    const Parameters down = slope.transpose() * r;
    bool better = false;
    double gained = 0.0;
    while (!better && damping < 1e8) {
      Eigen::Matrix<double, 9, 9> damped = normal;
      for (int k = 0; k < 9; ++k) damped(k, k) += damping * (normal(k, k) + 1e-9);
      const Parameters next = p - damped.ldlt().solve(down);
      const Eigen::VectorXd there = at(next);
      better = there.allFinite() && there.squaredNorm() < r.squaredNorm();
      damping *= better ? 0.2 : 5.0;
      if (!better) continue;
      gained = r.squaredNorm() - there.squaredNorm();
      p = next;
      r = there;
    }
    if (gained < 1e-9 * r.squaredNorm()) break;
  }
  HeartFit fit = fit_of(p, start, centre);
  double height = 0.0, groove = 0.0, n = 0.0, in_grooves = 0.0;
  for (const CourseMark& mark : marks) {
    const Off off = off_of(heart, fit, mark);
    height += off.height * off.height;
    n += 1.0;
    if (mark.groove == Groove::none) continue;
    groove += off.groove * off.groove;
    in_grooves += 1.0;
  }
  fit.height_mm = std::sqrt(height / std::max(1.0, n));
  fit.groove_mm = std::sqrt(groove / std::max(1.0, in_grooves));
  return fit;
}

}  // namespace ostia::phantom
