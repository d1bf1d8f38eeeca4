#pragma once
/// \file The branches of a network as smooth axes with radii.

#include "stretch.h"

#include "ostia/geometry/frame.h"
#include "ostia/geometry/vessel_graph.h"

#include <vector>

namespace ostia::reconstruction {

using geometry::Vec3;

/// One branch, sampled finely from its proximal to its distal end.
struct Tube {
  std::int32_t start = 0, end = 0;  ///< points of the graph
  std::vector<Vec3> points;
  std::vector<double> radius, abscissa, curvature;
  std::vector<double> factor;  ///< of the radius, where it had to be narrowed; 1 elsewhere
  std::vector<geometry::Frame> frames;
  std::vector<EllipticSection> shapes;  ///< empty: circles
  std::vector<Stretch> stretch;         ///< the same in the frames
  std::vector<std::size_t> knots;       ///< those of the points that are the graph's
  bool inlet = false, outlet = false;   ///< nothing else joins at its start or end

  double length() const { return abscissa.back(); }
};

struct TubePlace {
  Vec3 point = Vec3::Zero();
  double radius = 0.0;
  geometry::Frame frame;
  Stretch stretch;
};
TubePlace at(const Tube& tube, double abscissa);

/// Without `sections`: circles.
std::vector<Tube> tubes_of(const geometry::VesselGraph& graph, const EllipticSections* sections = nullptr);

/// One end of a branch.
struct TubeEnd {
  std::int32_t tube = 0;
  bool distal = false;
};
/// Of each point of the graph the ends of branches that meet there; none where a vessel only begins or ends.
using TubeEnds = std::vector<std::vector<TubeEnd>>;
TubeEnds ends_of(const std::vector<Tube>& tubes, std::size_t points);
/// Abscissas, frames, curvatures and the shapes in the frames anew, from the points.
void measure(Tube& tube);

}  // namespace ostia::reconstruction
