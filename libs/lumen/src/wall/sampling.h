#pragma once
/// \file What starting walls and the editing of axes share: rings, caps, and whether an axis can bear a wall.

#include "ostia/lumen/start_surface.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::lumen {

using geometry::AxisCurve;

enum class CapSide { before, beyond };  ///< proximal of the first ring, distal of the last

/// A function of the abscissa given at equal steps, as a C1 curve through its values (Catmull-Rom);
/// straight lines stay straight. Clamped to its ends.
class EvenTable {
 public:
  EvenTable() = default;
  EvenTable(double from, double step, std::vector<double> values);
  double at(double s) const;

 private:
  double from_ = 0.0, step_ = 1.0;
  std::vector<double> values_;
};

/// Derivative at `s` of a function known in [low, high]: of the quartic through five neighbours.
double slope_of(const std::function<double(double)>& f, double s, double low, double high, double step);

/// Rounded samples that close a wall at the abscissa `at`, as high as its mean radius there; about
/// `spacing_mm` apart. Their abscissas are those of their feet.
std::vector<SurfaceSample> cap_of(const AxisCurve& axis, const RadialWall& wall, double at, CapSide side,
                                  double spacing_mm, int least_around);

/// The radius of a vessel's own segments along its whole axis, evened over a few tenths of a millimetre.
/// Before the own stretch it is the first own radius.
EvenTable own_radius(const geometry::VesselTree& tree, const geometry::Vessel& vessel, const AxisCurve& axis,
                     double own_from_mm);

/// "vessel 4 (LAD)"
std::string vessel_label(const geometry::Vessel& vessel);

/// The vessel's axis. Throws InvalidInput, naming vessel and abscissa, for fewer than three points, radii
/// that are not positive, an own stretch shorter than its radius, a kink or a loop.
std::shared_ptr<const AxisCurve> checked_axis(const geometry::VesselTree& tree,
                                              const geometry::Vessel& vessel);

}  // namespace ostia::lumen
