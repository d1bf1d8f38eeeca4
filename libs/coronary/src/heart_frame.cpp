#include "heart_frame.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::coronary {
namespace {

constexpr double in_degrees = 180.0 / std::numbers::pi;
// Of the middle of the base below the ostia, which lie above it in the sinuses.
constexpr double below_ostia_mm = 20.0;

void set_axis(HeartFrame& frame, const Vec3& axis) {
  frame.long_axis = axis.normalized();
  const Vec3 head = std::abs(frame.long_axis.z()) > 0.98 ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ());
  frame.up = (head - head.dot(frame.long_axis) * frame.long_axis).normalized();
  frame.side = frame.up.cross(frame.long_axis);
}

}  // namespace

HeartPlace HeartFrame::place(const Vec3& point) const {
  const Vec3 d = point - base;
  const double x = d.dot(up), y = d.dot(side);
  return {d.dot(long_axis), std::atan2(y, x) * in_degrees, std::hypot(x, y)};
}

std::vector<HeartPlace> HeartFrame::places(const std::vector<Vec3>& path) const {
  std::vector<HeartPlace> result;
  for (const Vec3& point : path) {
    HeartPlace here = place(point);
    if (!result.empty()) {
      const double before = result.back().angle_deg;
      here.angle_deg += 360.0 * std::round((before - here.angle_deg) / 360.0);
    }
    result.push_back(here);
  }
  return result;
}

HeartFrame usual_frame(const std::vector<Vec3>& ostia, const std::optional<Vec3>& long_axis) {
  HeartFrame frame;
  set_axis(frame, long_axis.value_or(Vec3(0.62, -0.57, -0.54)));
  Vec3 middle = Vec3::Zero();
  for (const Vec3& ostium : ostia) middle += ostium / static_cast<double>(ostia.size());
  frame.base = middle - below_ostia_mm * frame.up;
  return frame;
}

std::optional<HeartFrame> frame_of_ring(const HeartFrame& usual, const std::vector<Vec3>& groove) {
  constexpr double most_turn_deg = 40.0, least_width_mm = 15.0, most_thickness_mm = 7.0;
  if (groove.size() < 40) return std::nullopt;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : groove) mean += p / static_cast<double>(groove.size());
  geometry::Mat3 spread = geometry::Mat3::Zero();
  for (const Vec3& p : groove)
    spread += (p - mean) * (p - mean).transpose() / static_cast<double>(groove.size());
  const Eigen::SelfAdjointEigenSolver<geometry::Mat3> solved(spread);
  const Vec3 widths = solved.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (widths[1] < least_width_mm || widths[0] > most_thickness_mm) return std::nullopt;
  Vec3 normal = solved.eigenvectors().col(0);
  if (normal.dot(usual.long_axis) < 0.0) normal = -normal;
  if (std::acos(std::clamp(normal.dot(usual.long_axis), -1.0, 1.0)) * in_degrees > most_turn_deg)
    return std::nullopt;
  HeartFrame frame = usual;
  set_axis(frame, normal);
  // The circle by least squares (Kasa 1976), which needs more than half of it.
  Eigen::Matrix3d system = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  for (const Vec3& p : groove) {
    const Vec3 row((p - mean).dot(frame.up), (p - mean).dot(frame.side), 1.0);
    system += row * row.transpose();
    right += row * (row.x() * row.x() + row.y() * row.y());
  }
  const Vec3 circle = system.ldlt().solve(right);
  const double x = 0.5 * circle[0], y = 0.5 * circle[1];
  const double radius = std::sqrt(std::max(0.0, circle[2] + x * x + y * y));
  if (!(radius > 25.0 && radius < 65.0)) return std::nullopt;
  frame.base = mean + x * frame.up + y * frame.side;
  return frame;
}

}  // namespace ostia::coronary
