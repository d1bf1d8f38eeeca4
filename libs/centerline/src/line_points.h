#pragma once
// Nearest points of a line whose points follow one another closely.

#include "ostia/geometry/vec.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ostia::centerline::detail {

/// Runs of points in boxes, and runs of these in boxes: less work than a tree, since neighbours along the
/// line are neighbours in space, and so are queries that follow one another. Points have to be finite.
class LinePoints {
 public:
  explicit LinePoints(const std::vector<geometry::Vec3>& points);

  /// The point nearest to `query`, of equally near ones the first; -1 where none is nearer than the root of
  /// `within_squared`. `run` is a place to begin at, from an earlier query or 0, and where this one ended: it
  /// changes the work alone.
  std::int32_t nearest(const geometry::Vec3& query, double within_squared, std::size_t& run) const;

 private:
  struct Nearest {
    double squared;
    std::int32_t point = -1;
  };
  void search_run(std::size_t run, const geometry::Vec3& query, Nearest& best) const;

  const std::vector<geometry::Vec3>& points_;
  std::vector<geometry::Box3> runs_, groups_;  // each of the next so many points or runs
};

}  // namespace ostia::centerline::detail
