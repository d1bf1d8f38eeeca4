#pragma once
/// \file The tree's lumen as a target of a front, and where a way that enters it joins the axis.

#include "block_grid.h"

#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/minimal_path.h"
#include "ostia/segmentation/seeds.h"

#include <optional>
#include <vector>

namespace ostia::segmentation::detail {

/// The axes of a tree near a place, made ready for questions.
class PathTarget {
 public:
  /// Only what lies within `reach_mm` of `centre` and inside the image counts.
  PathTarget(const imaging::ImageVolume& image, const geometry::VesselTree& tree, const Vec3& centre,
             double reach_mm);

  bool empty() const { return samples_.empty(); }
  bool hit(const Voxel& v) const { return marks_.get(v) >= 0; }
  /// The vessel in whose lumen a place lies, if any.
  std::optional<std::int32_t> vessel_around(const Vec3& place) const;
  /// Axis points within `radius_mm` of a place; the nearest ones where these are few.
  std::vector<Vec3> axis_points_near(const Vec3& place, double radius_mm, std::size_t fewest) const;

  /// Where a line that begins in a vessel's lumen joins its axis.
  struct Joint {
    std::size_t first_free = 0;  ///< index of the first point clear of the parent
    PathJunction junction;
  };
  /// Of the way as the front found it: the first point outside of the lumen, and the axis beside it.
  Joint entry(const Voxel& reached, const std::vector<Vec3>& way) const;
  /// Of a centred line that begins with `entry`: what lies closer to the parent than its own radius is not to
  /// be trusted, for there a front takes short cuts and two lumina look like one. The line is taken as
  /// straight from where it is clear back to the axis.
  Joint rejoined(const Voxel& reached, const std::vector<Vec3>& line, double radius_mm) const;

 private:
  struct Sample {
    Vec3 point;
    double radius;
    std::size_t segment;
  };
  void add(const imaging::ImageVolume& image, std::size_t segment, const Vec3& centre, double reach_mm);
  void mark(const imaging::Geometry& geometry, const Sample& sample);
  PathJunction owned(std::size_t segment, const Vec3& point) const;
  const Sample& met(const Voxel& reached) const {
    return samples_[static_cast<std::size_t>(marks_.get(reached))];
  }
  /// The vessel that owns a sample, and its axis from the root: a branch may meet it beyond the segment.
  const geometry::Vessel& owner(std::size_t segment) const;
  /// The radius at a place of the vessel's axis, and who owns it there.
  const Sample& sample_at(const geometry::Vessel& vessel, const Vec3& place) const;

  const geometry::VesselTree& tree_;
  std::vector<Sample> samples_;
  BlockGrid<std::int32_t> marks_;  // sample that owns a voxel, or -1
};

}  // namespace ostia::segmentation::detail
