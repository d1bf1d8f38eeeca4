#include "ostia/geometry/frame.h"

#include "ostia/core/error.h"

#include <cmath>
#include <string>

namespace ostia::geometry {
namespace {

// A normal closer to its tangent than this (sine of the angle) has lost its direction to rounding.
constexpr double smallest_sine = 1e-9;

Vec3 piece_direction(const std::vector<Vec3>& points, std::size_t i) {
  const Vec3 step = points[i + 1] - points[i];
  const double norm = step.norm();
  if (!(norm > 0.0) || !std::isfinite(norm)) {
    throw InvalidInput("points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                       " of the curve coincide or are not finite; a frame needs distinct neighbours");
  }
  return step / norm;
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double norm = v.norm();
  return norm > smallest_sine ? Vec3(v / norm) : otherwise;
}

Vec3 unit_normal_part(const Vec3& v, const Vec3& tangent) {
  const Vec3 part = v - v.dot(tangent) * tangent;
  const double norm = part.norm();
  if (!(norm > smallest_sine * v.norm())) {
    throw InvalidInput(
        "the first normal of the curve is zero or along its tangent; give one that crosses it");
  }
  return part / norm;
}

Frame frame_of(const Vec3& tangent, const Vec3& normal) {
  return {tangent, normal, tangent.cross(normal)};
}

// The first reflection carries the frame over to the next point, the second turns its tangent into the next
// one; together they are a rotation, and it has no part about the tangent up to fourth order.
Vec3 transport(const Vec3& step, const Vec3& tangent, const Vec3& normal, const Vec3& next_tangent) {
  const double c1 = step.squaredNorm();
  const Vec3 normal_mirrored = normal - (2.0 / c1) * step.dot(normal) * step;
  const Vec3 tangent_mirrored = tangent - (2.0 / c1) * step.dot(tangent) * step;
  const Vec3 gap = next_tangent - tangent_mirrored;
  const double c2 = gap.squaredNorm();
  if (c2 < smallest_sine * smallest_sine) return normal_mirrored;
  return normal_mirrored - (2.0 / c2) * gap.dot(normal_mirrored) * gap;
}

}  // namespace

Vec3 radial_direction(const Frame& frame, double theta) {
  return std::cos(theta) * frame.normal - std::sin(theta) * frame.binormal;
}

double angle_of(const Frame& frame, const Vec3& direction) {
  const double x = direction.dot(frame.normal), y = -direction.dot(frame.binormal);
  return x == 0.0 && y == 0.0 ? 0.0 : std::atan2(y, x);
}

Frame interpolated(const Frame& a, const Frame& b, double t) {
  const Vec3 tangent = unit_or((1.0 - t) * a.tangent + t * b.tangent, a.tangent);
  return frame_of(tangent, unit_normal_part((1.0 - t) * a.normal + t * b.normal, tangent));
}

Vec3 initial_normal(const Vec3& tangent) {
  const Vec3 t = tangent.normalized();
  const Vec3 reference = std::abs(t.z()) > 0.999 ? Vec3::UnitX() : Vec3::UnitZ();
  return (reference - reference.dot(t) * t).normalized();
}

std::vector<Vec3> tangents(const std::vector<Vec3>& points) {
  const std::size_t n = points.size();
  if (n < 2) {
    throw InvalidInput("the tangents of a curve need at least two points, this one has " + std::to_string(n));
  }
  std::vector<Vec3> direction(n - 1);
  std::vector<double> h(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    direction[i] = piece_direction(points, i);
    h[i] = (points[i + 1] - points[i]).norm();
  }
  if (n == 2) return {direction[0], direction[0]};

  std::vector<Vec3> result(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    // Exact for parabolas; a curve that turns back on itself keeps the direction it came with.
    const Vec3 derivative = (h[i] * direction[i - 1] + h[i - 1] * direction[i]) / (h[i - 1] + h[i]);
    result[i] = unit_or(derivative, direction[i - 1]);
  }
  const auto one_sided = [](const Vec3& first, const Vec3& second, double h_first, double h_second) {
    return unit_or(first + (first - second) * (h_first / (h_first + h_second)), first);
  };
  result.front() = one_sided(direction[0], direction[1], h[0], h[1]);
  result.back() = one_sided(direction[n - 2], direction[n - 3], h[n - 2], h[n - 3]);
  return result;
}

std::vector<Frame> rotation_minimising_frames(const std::vector<Vec3>& points,
                                              const std::vector<Vec3>& tangents, const Vec3& first_normal) {
  const std::size_t n = points.size();
  if (n < 2)
    throw InvalidInput("frames along a curve need at least two points, this one has " + std::to_string(n));
  if (tangents.size() != n) {
    throw InvalidInput("frames along a curve of " + std::to_string(n) + " points got " +
                       std::to_string(tangents.size()) + " tangents; give one a point");
  }
  std::vector<Frame> frames;
  frames.reserve(n);
  frames.push_back(frame_of(tangents[0], unit_normal_part(first_normal, tangents[0])));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    piece_direction(points, i);  // refuses coincident neighbours
    const Vec3 next = transport(points[i + 1] - points[i], tangents[i], frames[i].normal, tangents[i + 1]);
    // Normal to the tangent by construction; the projection only keeps rounding from adding up.
    frames.push_back(frame_of(tangents[i + 1], unit_normal_part(next, tangents[i + 1])));
  }
  return frames;
}

std::vector<Frame> rotation_minimising_frames(const std::vector<Vec3>& points) {
  const std::vector<Vec3> t = tangents(points);
  return rotation_minimising_frames(points, t, initial_normal(t.front()));
}

}  // namespace ostia::geometry
