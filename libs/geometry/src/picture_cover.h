#pragma once
/// \file How often nearer segments cover a picture, tile by tile: what lies behind many is not seen.

#include "ostia/geometry/segment_blocks.h"

#include <vector>

namespace ostia::geometry::detail {

/// Places and widths in tiles of 16 pixels, from the picture's lower left corner. Where depth is not
/// positive, the segment reaches behind the eye, and the rest tells nothing.
struct PlacedSegment {
  float x, y, width, to_x, to_y, to_width;
  float depth;  ///< of the nearer end, mm
};

/// Segments at random places of a tile that have c times its area in all leave the share exp(-c) of it
/// uncovered, as a Poisson process does. What lies behind is hidden where that is below two hundredths.
class PictureCover {
 public:
  /// Places are from `centre`.
  PictureCover(const BlockView& view, const Vec3& centre);
  PlacedSegment place(const DrawnSegment& segment) const;
  /// Counts a segment before the eye, though no more than a tile's width of it.
  void add(const PlacedSegment& segment);
  bool hides(const PlacedSegment& segment) const;  ///< no segment that is wider than a tile
  /// A box with sides along the axes; none that reaches behind the eye.
  bool hides(const Vec3& middle, const Vec3& half) const;

 private:
  Eigen::Vector3f eye_;
  Eigen::Matrix3f axes_;  ///< rows: right, up, into the picture
  float tiles_mm_;        ///< tiles to a mm at depth 1 mm
  int across_, up_;
  std::vector<float> cover_;
  Eigen::Vector3f seen(const Eigen::Vector3f& place) const;
  std::size_t tile(float x, float y) const;
  bool within(float x, float y) const;
};

}  // namespace ostia::geometry::detail
