#pragma once
// What placing and changing a measurement is, in whichever view it is done.

#include "pictures/own_steps.h"

#include "ostia/session/workbench.h"
#include "ostia/view/handle_hit.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ostia::view {

using geometry::Vec3;

inline constexpr double handle_reach_units = 8.0;  // from a handle within which it is taken hold of
inline constexpr double trembling_units = 3.0;     // a hand that moved less has clicked

analysis::Measurement of_points(analysis::MeasureKind kind, std::vector<Vec3> points,
                                std::int32_t vessel = 0);
/// Two abscissas of a vessel, in either order (stenosis, volume).
analysis::Measurement of_stretch(analysis::MeasureKind kind, std::int32_t vessel, double a_mm, double b_mm);
analysis::Measurement ring_at(std::int32_t vessel, double s_mm);

/// Adds a measurement and selects it.
void add_measurement(session::Workbench& bench, analysis::Measurement made);

/// Abscissas at which a measurement along a vessel is taken hold of: its proximal and its distal end, the one
/// place of a ring. None for a measurement of points.
std::vector<double> ends_of(const analysis::Measurement& measurement);
/// Where one of these ends may go: on its vessel, and not past the other.
struct EndRoom {
  double from_mm = 0.0, to_mm = 0.0;
};
/// Nothing where the vessel is not there, or has no room.
std::optional<EndRoom> room_of_end(const session::Workbench& bench, const analysis::Measurement& measurement,
                                   std::size_t end);
analysis::Measurement with_end(analysis::Measurement measurement, std::size_t end, double s_mm);

/// A measurement in the hand: it is selected, and all states that it is given are one step of undo.
class HeldMeasurement {
 public:
  HeldMeasurement(session::Workbench& bench, std::int32_t id);
  const analysis::Measurement& now() const { return now_; }
  void become(analysis::Measurement next);        ///< throws as Workbench::annotate_merged does
  void take_back() { steps_.take_back(bench_); }  ///< it is what it was when it was taken

 private:
  session::Workbench& bench_;
  analysis::Measurement now_;
  std::int64_t drag_;
  OwnSteps steps_;
};

/// An end of a measurement along the selected vessel in the hand.
class HeldEnd {
 public:
  HeldEnd(session::Workbench& bench, const HandleHit& hit)
      : bench_(bench), held_(bench, hit.measurement), end_(hit.handle) {}
  const analysis::Measurement& now() const { return held_.now(); }
  double s_mm() const;        ///< where it is
  void pull_to(double s_mm);  ///< or as far towards it as there is room; throws as HeldMeasurement does
  void take_back() { held_.take_back(); }

 private:
  session::Workbench& bench_;
  HeldMeasurement held_;
  std::size_t end_;
};

}  // namespace ostia::view
