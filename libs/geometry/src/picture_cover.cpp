#include "picture_cover.h"

#include <algorithm>
#include <cmath>

namespace ostia::geometry::detail {
namespace {

constexpr float tile_px = 16.0f;
constexpr float least_px = 1.0f;  // that a segment is drawn wide
constexpr float enough = 4.0f;    // times: exp(-4) is two hundredths

/// What of a segment is in one tile, about.
struct Piece {
  float x, y, width;
};

int pieces_of(const PlacedSegment& one, float& length) {
  constexpr float most = 1000.0f;
  const float x = one.to_x - one.x, y = one.to_y - one.y;
  length = std::sqrt(x * x + y * y);
  return static_cast<int>(std::ceil(std::clamp(length, 1.0f, most)));
}

Piece piece(const PlacedSegment& one, int i, int count) {
  const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
  return {one.x + t * (one.to_x - one.x), one.y + t * (one.to_y - one.y),
          one.width + t * (one.to_width - one.width)};
}

}  // namespace

PictureCover::PictureCover(const BlockView& view, const Vec3& centre)
    : eye_((view.eye - centre).cast<float>()),
      tiles_mm_(static_cast<float>(view.height_px / (2.0 * view.half_height * tile_px))),
      across_(static_cast<int>(std::ceil(2.0 * view.half_width * tiles_mm_))),
      up_(static_cast<int>(std::ceil(2.0 * view.half_height * tiles_mm_))),
      cover_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(up_), 0.0f) {
  axes_.row(0) = view.right.cast<float>();
  axes_.row(1) = view.up.cast<float>();
  axes_.row(2) = -view.back.cast<float>();
}

Eigen::Vector3f PictureCover::seen(const Eigen::Vector3f& place) const {
  const Eigen::Vector3f at = axes_ * (place - eye_);
  const float tiles = tiles_mm_ / at.z();
  return {0.5f * static_cast<float>(across_) + at.x() * tiles,
          0.5f * static_cast<float>(up_) + at.y() * tiles, at.z()};
}

bool PictureCover::within(float x, float y) const {
  return x >= 0.0f && y >= 0.0f && x < static_cast<float>(across_) && y < static_cast<float>(up_);
}

std::size_t PictureCover::tile(float x, float y) const {
  return static_cast<std::size_t>(static_cast<int>(y) * across_ + static_cast<int>(x));
}

PlacedSegment PictureCover::place(const DrawnSegment& one) const {
  const Eigen::Vector3f from = seen({one.from[0], one.from[1], one.from[2]}),
                        to = seen({one.to[0], one.to[1], one.to[2]});
  return {from.x(),
          from.y(),
          2.0f * one.radius_from * tiles_mm_ / from.z(),
          to.x(),
          to.y(),
          2.0f * one.radius_to * tiles_mm_ / to.z(),
          std::min(from.z(), to.z())};
}

void PictureCover::add(const PlacedSegment& one) {
  float length = 0.0f;
  const int count = pieces_of(one, length);
  const float share = std::min(1.0f, length / static_cast<float>(count));
  for (int i = 0; i < count; ++i) {
    const Piece at = piece(one, i, count);
    if (within(at.x, at.y))
      cover_[tile(at.x, at.y)] += share * std::clamp(at.width, least_px / tile_px, 1.0f);
  }
}

bool PictureCover::hides(const PlacedSegment& one) const {
  float length = 0.0f;
  const int count = pieces_of(one, length);
  for (int i = 0; i < count; ++i) {
    const Piece at = piece(one, i, count);
    if (at.width > 1.0f) return false;
    if (within(at.x, at.y) && cover_[tile(at.x, at.y)] < enough) return false;
  }
  return true;
}

bool PictureCover::hides(const Vec3& middle, const Vec3& half) const {
  Eigen::Vector2f low(static_cast<float>(across_), static_cast<float>(up_)), high(0.0f, 0.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 side((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const Vec3 place = middle + half.cwiseProduct(side);
    const Eigen::Vector3f at = seen(place.cast<float>());
    if (!(at.z() > 0.0f)) return false;
    low = low.cwiseMin(at.head<2>());
    high = high.cwiseMax(at.head<2>());
  }
  const auto clamped = [](float at, int count) {
    return std::clamp(at, 0.0f, static_cast<float>(count - 1));
  };
  const int right = static_cast<int>(clamped(high.x(), across_)),
            top = static_cast<int>(clamped(high.y(), up_));
  for (int y = static_cast<int>(clamped(low.y(), up_)); y <= top; ++y)
    for (int x = static_cast<int>(clamped(low.x(), across_)); x <= right; ++x)
      if (cover_[static_cast<std::size_t>(y * across_ + x)] < enough) return false;
  return true;
}

}  // namespace ostia::geometry::detail
