#pragma once
/// \file What the reader of a tree sees as an overlay: the true vessels that count.

#include "extraction/own_axes.h"

#include "ostia/experiments/reading.h"
#include "ostia/phantom/vessel_field.h"

namespace ostia::experiments {

inline constexpr int reading_angles = 24;  // of a section's wall
inline constexpr double reading_row_mm = 0.5;

/// A section of a true vessel.
struct CountedRow {
  double s_mm = 0.0;
  Vec3 foot = Vec3::Zero();    ///< on the true axis
  Vec3 middle = Vec3::Zero();  ///< of the true lumen
  double mean_mm = 0.0;        ///< its radius
  struct Ray {
    Vec3 direction = Vec3::Zero();
    double radius_mm = 0.0;
    bool seen = true;  ///< false: another vessel leaves there
  };
  std::vector<Ray> rays;
};

struct CountedVessel {
  const phantom::CoronaryVessel* vessel = nullptr;
  double from_mm = 0.0, to_mm = 0.0;  ///< what counts of it
  std::vector<CountedRow> rows;
};

/// The truth, which must outlive it. Immutable; asked from many threads.
class ReadingOverlay {
 public:
  /// Throws InvalidInput where no vessel counts.
  ReadingOverlay(const phantom::CoronaryTree& tree, const ReadingOptions& options);
  const std::vector<CountedVessel>& vessels() const { return vessels_; }
  const std::vector<OwnAxis>& axes() const { return axes_; }  ///< of all vessels, thin ones too
  /// Whether a place on a vessel's boundary lies in or beside the lumen of another.
  bool hidden(std::int32_t vessel, const Vec3& place) const;
  /// The contours between two rows, both included.
  static geometry::ContourSection section(const CountedVessel& vessel, std::size_t first, std::size_t last);

 private:
  phantom::VesselField field_;
  std::vector<OwnAxis> axes_;
  std::vector<CountedVessel> vessels_;
};

/// On the true axis.
Vec3 axis_place(const phantom::CoronaryVessel& vessel, double s_mm);

}  // namespace ostia::experiments
