#pragma once
/// \file A lumen against an observer's contours, in the contours' own planes: cheap enough to be asked while
/// somebody draws.

#include "ostia/geometry/contour_set.h"

#include <memory>
#include <vector>

namespace ostia::evaluation {

using geometry::Vec3;

/// Two closed lines across a vessel, in the plane of the reference's mean normal.
struct OutlineDifference {
  double mean_mm = 0.0;  ///< distance of each line from the other, over both lines' lengths
  double max_mm = 0.0;   ///< the larger of the two one-sided maxima
  double reference_mm2 = 0.0, result_mm2 = 0.0;
  double dice = 0.0;  ///< of what they enclose
  double area_difference_mm2() const { return result_mm2 - reference_mm2; }
};
/// Points in order around, the first not repeated, either way round. Distances at places 0.1 mm apart;
/// overlap along lines 0.05 mm apart. Throws InvalidInput for fewer than three points or points that are not
/// finite.
OutlineDifference compare_outlines(const geometry::Contour& reference, const std::vector<Vec3>& result);

/// Sums of distances between surfaces over their area; they add up over strips, sections and vessels.
struct AreaDistances {
  double area_mm2 = 0.0;  ///< of both surfaces
  double sum = 0.0;       ///< of distance times area
  double squares = 0.0;
  double max_mm = 0.0;
  double mean_mm() const;  ///< MSD, NaN without area
  double rms_mm() const;
  AreaDistances& operator+=(const AreaDistances& other);
};

struct RuledOptions {
  double sample_mm = 0.6;  ///< triangles are asked at least this densely, > 0
};

/// MSD between the ruled surface (`surface_of`) of an observer's contours and that of a lumen's outlines in
/// the same planes, so that both end there and nothing has to be clipped: the mean over both surfaces,
/// weighted by area, of the exact distance from one to the other, as LumenResult has it of a whole wall.
/// After a change only the strips between changed outlines are asked again, and those of the reference that
/// are no farther from them than they were from the wall before; the sums are those of a comparison made
/// afresh.
class RuledComparison {
 public:
  /// Throws InvalidInput for a section with a fault, or options without a size.
  explicit RuledComparison(geometry::ContourSection reference, const RuledOptions& options = {});
  ~RuledComparison();
  RuledComparison(RuledComparison&&) noexcept;
  RuledComparison& operator=(RuledComparison&&) noexcept;

  /// One outline for each contour of the reference, empty where there is none; `changed` are the indices of
  /// those that are not what they were (all, the first time). A strip without an outline on either of its
  /// sides, or with one that crosses itself, counts on neither surface. Throws InvalidInput for another
  /// number of outlines.
  void update(const std::vector<std::vector<Vec3>>& outlines, const std::vector<std::size_t>& changed);
  AreaDistances distances() const;
  double missing_mm() const;  ///< length of the strips that do not count

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::evaluation
