#pragma once
// What placing and changing a measurement is, in whichever view it is done.

#include "ostia/session/workbench.h"

#include <cstdint>
#include <vector>

namespace ostia::view {

using geometry::Vec3;

analysis::Measurement of_points(analysis::MeasureKind kind, std::vector<Vec3> points,
                                std::int32_t vessel = 0);
/// Two abscissas of a vessel, in either order (stenosis, volume).
analysis::Measurement of_stretch(analysis::MeasureKind kind, std::int32_t vessel, double a_mm, double b_mm);
analysis::Measurement ring_at(std::int32_t vessel, double s_mm);

/// Adds a measurement and selects it.
void add_measurement(session::Workbench& bench, analysis::Measurement made);

/// A measurement in the hand: it is selected, and all states that it is given are one step of undo.
class HeldMeasurement {
 public:
  HeldMeasurement(session::Workbench& bench, std::int32_t id);
  const analysis::Measurement& now() const { return now_; }
  void become(analysis::Measurement next);  ///< throws as Workbench::annotate_merged does

 private:
  session::Workbench& bench_;
  analysis::Measurement now_;
  std::int64_t drag_;
};

}  // namespace ostia::view
