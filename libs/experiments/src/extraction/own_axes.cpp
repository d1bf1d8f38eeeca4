#include "extraction/own_axes.h"

#include "ostia/geometry/polyline.h"
#include "ostia/lumen/lumen_model.h"

#include <cmath>
#include <limits>

namespace ostia::experiments {

std::vector<OwnAxis> own_axes(const geometry::VesselTree& tree) {
  constexpr double rounding_mm = 1e-6;
  std::vector<OwnAxis> axes;
  for (const geometry::Vessel& vessel : tree.vessels) {
    const geometry::Centerline whole = geometry::vessel_axis(tree, vessel);
    OwnAxis own{vessel.id, vessel.name, lumen::own_from_mm(tree, vessel.id), {}, {}};
    for (std::size_t i = 0; i < whole.size(); ++i) {
      if (whole.abscissa[i] < own.from_mm - rounding_mm) continue;
      own.points.push_back(whole.points[i]);
      own.radius_mm.push_back(whole.radius[i]);
    }
    if (own.points.size() >= 2) axes.push_back(std::move(own));
  }
  return axes;
}

NearestAxis nearest_axis(const std::vector<OwnAxis>& axes, const geometry::Vec3& place) {
  NearestAxis best;
  best.away_mm = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const geometry::PolylineLocation at = geometry::closest(axes[i].points, place);
    const double away = (at.point - place).norm();
    if (away >= best.away_mm) continue;
    const std::vector<double>& radius = axes[i].radius_mm;
    best = {i, at.abscissa, away, std::lerp(radius[at.segment], radius[at.segment + 1], at.t)};
  }
  return best;
}

}  // namespace ostia::experiments
