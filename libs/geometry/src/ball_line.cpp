#include "ostia/geometry/ball_line.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::geometry {
namespace {

constexpr std::size_t pieces_of_block = 16;

}  // namespace

BallLine::BallLine(const Centerline& line) : points_(line.points), radius_(line.radius) {
  if (points_.size() < 2 || radius_.size() != points_.size())
    throw InvalidInput("a line of balls has " + std::to_string(points_.size()) + " points and " +
                       std::to_string(radius_.size()) + " radii; give two points at least, a radius each");
  for (std::size_t first = 0; first + 1 < points_.size(); first += pieces_of_block) {
    const std::size_t last = std::min(first + pieces_of_block, points_.size() - 1);
    Box3 box;
    Block block;
    for (std::size_t i = first; i <= last; ++i) {
      box.extend(points_[i]);
      block.radius = std::max(block.radius, radius_[i]);
    }
    block.centre = box.center();
    for (std::size_t i = first; i <= last; ++i)
      block.reach = std::max(block.reach, (points_[i] - block.centre).norm());
    blocks_.push_back(block);
  }
}

void BallLine::look_at(std::size_t piece, const Vec3& x, Nearest& best) const {
  const Vec3 along = points_[piece + 1] - points_[piece], to = x - points_[piece];
  const double widening = radius_[piece + 1] - radius_[piece];
  const double curvature = along.squaredNorm() - widening * widening;
  const auto value = [&](double t) {
    const double radius = radius_[piece] + t * widening;
    return (to - t * along).squaredNorm() - radius * radius;
  };
  const auto offer = [&](double t) {
    const double v = value(t);
    if (v < best.value) best = {v, t >= 1.0 ? LinePlace{piece + 1, 0.0} : LinePlace{piece, t}};
  };
  // Where one end's ball holds the other's, the deepest is at an end.
  if (!(curvature > 0.0)) {
    offer(0.0);
    return offer(1.0);
  }
  offer(std::clamp((along.dot(to) + widening * radius_[piece]) / curvature, 0.0, 1.0));
}

BallLine::Nearest BallLine::nearest(const Vec3& x) const {
  Nearest best;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const double gap = std::max(0.0, (x - blocks_[b].centre).norm() - blocks_[b].reach);
    if (gap * gap - blocks_[b].radius * blocks_[b].radius > best.value) continue;
    const std::size_t first = b * pieces_of_block;
    const std::size_t last = std::min(first + pieces_of_block, points_.size() - 1);
    for (std::size_t piece = first; piece < last; ++piece) look_at(piece, x, best);
  }
  return best;
}

}  // namespace ostia::geometry
