#pragma once
/// \file Radial walls from surfaces and contours.

#include "wall/sampling.h"

#include "ostia/geometry/aabb_tree.h"

namespace ostia::lumen {

/// A vessel that a wall is to be made for.
struct StartVessel {
  const geometry::Vessel* vessel = nullptr;
  std::shared_ptr<const AxisCurve> axis;
  double own_from_mm = 0.0;
  EvenTable radius;  ///< of its own segments
};
StartVessel start_vessel(const geometry::VesselTree& tree, const geometry::Vessel& vessel);
RadialWall tube_of(const StartVessel& start);
struct NewWall;
/// Over the vessel's own part.
RadialWall wall_of(const NewWall& wall, const StartVessel& start);

/// r at equal steps of the abscissa and of the angle, C1 between them and around.
class WallTable {
 public:
  WallTable(double from_mm, double step_mm, int rings, int around);
  double& at(int ring, int k) { return values_[index(ring, k)]; }
  double at(int ring, int k) const { return values_[index(ring, k)]; }
  int rings() const { return rings_; }
  int around() const { return around_; }
  double s(int ring) const { return from_ + step_ * ring; }
  double operator()(double s_mm, double theta) const;

 private:
  double from_, step_;
  int rings_, around_;
  std::vector<double> values_;
  std::size_t index(int ring, int k) const {
    return static_cast<std::size_t>(ring) * static_cast<std::size_t>(around_) +
           static_cast<std::size_t>((k % around_ + around_) % around_);
  }
};

/// Along rays from the axis to the surface's nearest crossing. Rays that leave through a side branch or find
/// nothing take their neighbours' distance; where none finds a wall it is a tube.
RadialWall wall_on_surface(const StartVessel& start, const geometry::TriMesh& surface,
                           const geometry::AabbTree& shells, const core::TaskContext& task);

/// Throws InvalidInput for a section with a fault, of a vessel that the tree does not have, or that overlaps
/// another of the same vessel.
void check_contours(const geometry::VesselTree& tree, const geometry::ContourSet& contours);
RadialWall wall_through_contours(const StartVessel& start, const geometry::ContourSet& contours);

}  // namespace ostia::lumen
