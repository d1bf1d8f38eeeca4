#pragma once
/// \file Nearest points in a point cloud.

#include "ostia/geometry/vec.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::geometry {

/// A k-d tree over points, built once and queried often; safe from many threads. A query point or a radius
/// that is not finite or is negative throws InvalidInput.
class KdTree {
 public:
  explicit KdTree(std::vector<Vec3> points);  ///< throws InvalidInput when empty or not finite
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  std::int32_t nearest(const Vec3& query) const;
  /// Nearest first, ties by index; all points when there are no more than `count`.
  std::vector<std::int32_t> nearest(const Vec3& query, std::size_t count) const;
  /// Points at a distance of at most `radius_mm`, in ascending order of index.
  std::vector<std::int32_t> within(const Vec3& query, double radius_mm) const;
  const std::vector<Vec3>& points() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::geometry
