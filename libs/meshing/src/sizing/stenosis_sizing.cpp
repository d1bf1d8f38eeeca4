#include "ostia/meshing/stenosis_sizing.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::meshing {
namespace {

using geometry::Centerline;

/// Largest radius between two abscissas.
double widest(const Centerline& axis, double from_mm, double to_mm) {
  double radius = 0.0;
  for (std::size_t i = 0; i < axis.size(); ++i)
    if (axis.abscissa[i] >= from_mm && axis.abscissa[i] <= to_mm) radius = std::max(radius, axis.radius[i]);
  return radius;
}

/// How much narrower the vessel is at its point i than on both sides.
double narrowing_at(const Centerline& axis, std::size_t i, const ThroatOptions& options) {
  const double near = options.window_diameters * 2.0 * axis.radius[i], here = axis.abscissa[i];
  // A tight throat's own diameters reach no healthy vessel: the window is of the vessel's about it.
  const double window = options.window_diameters * 2.0 * widest(axis, here - near, here + near);
  const double healthy = std::min(widest(axis, here - window, here), widest(axis, here, here + window));
  return healthy > 0.0 ? 1.0 - axis.radius[i] / healthy : 0.0;
}

double length_about(const Centerline& axis, const std::vector<double>& narrowing, std::size_t i) {
  std::size_t first = i, last = i;
  while (first > 0 && narrowing[first - 1] >= 0.5 * narrowing[i]) --first;
  while (last + 1 < axis.size() && narrowing[last + 1] >= 0.5 * narrowing[i]) ++last;
  return axis.abscissa[last] - axis.abscissa[first];
}

void find_in(const Centerline& axis, std::int32_t vessel, const ThroatOptions& options,
             std::vector<Throat>& found) {
  std::vector<double> narrowing(axis.size());
  for (std::size_t i = 0; i < axis.size(); ++i) narrowing[i] = narrowing_at(axis, i, options);
  std::vector<std::size_t> order(axis.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return narrowing[a] > narrowing[b]; });
  struct Place {
    double abscissa;
    Throat throat;
  };
  std::vector<Place> places;
  for (const std::size_t i : order) {
    if (narrowing[i] < options.least_narrowing) break;
    const bool known = std::any_of(places.begin(), places.end(), [&](const Place& place) {
      return std::abs(axis.abscissa[i] - place.abscissa) <=
             std::max(place.throat.length_mm, 2.0 * place.throat.radius_mm);
    });
    if (!known)
      places.push_back(
          {axis.abscissa[i],
           {vessel, axis.points[i], axis.radius[i], narrowing[i], length_about(axis, narrowing, i)}});
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.abscissa < b.abscissa; });
  for (const Place& place : places) {
    // Vessels share their way from the root.
    const bool shared = std::any_of(found.begin(), found.end(), [&](const Throat& other) {
      return (other.place - place.throat.place).norm() <= 1e-6;
    });
    if (!shared) found.push_back(place.throat);
  }
}

}  // namespace

void validate(const ThroatOptions& options) {
  if (!(options.least_narrowing >= 0.05 && options.least_narrowing <= 0.95))
    throw InvalidInput("throats: least_narrowing " + std::to_string(options.least_narrowing) +
                       " must lie in [0.05, 0.95]");
  if (!(options.window_diameters >= 1.0 && options.window_diameters <= 50.0))
    throw InvalidInput("throats: window_diameters " + std::to_string(options.window_diameters) +
                       " must lie in [1, 50]");
}

std::vector<Throat> find_throats(const geometry::VesselTree& tree, const ThroatOptions& options) {
  validate(options);
  std::vector<Throat> found;
  for (const geometry::Vessel& vessel : tree.vessels) {
    const Centerline axis = geometry::vessel_axis(tree, vessel);
    for (const double radius : axis.radius)
      if (!(radius >= 0.0) || !std::isfinite(radius))
        throw InvalidInput("throats: " + vessel.name + " has a radius of " + std::to_string(radius) +
                           " mm; it must be finite and not negative");
    find_in(axis, vessel.id, options, found);
  }
  return found;
}

std::vector<SizeFocus> size_foci(const std::vector<Throat>& throats, double share, double beyond_diameters) {
  if (!(beyond_diameters >= 0.0 && beyond_diameters <= 20.0))
    throw InvalidInput("throats: " + std::to_string(beyond_diameters) + " diameters must lie in [0, 20]");
  if (!(share >= 0.05 && share <= 1.0))
    throw InvalidInput("throats: share " + std::to_string(share) + " must lie in [0.05, 1]");
  std::vector<SizeFocus> foci;
  for (const Throat& throat : throats) {
    const double healthy_mm = 2.0 * throat.radius_mm / (1.0 - throat.narrowing);
    foci.push_back({throat.place, 0.5 * throat.length_mm + healthy_mm * (0.5 + beyond_diameters), share});
  }
  return foci;
}

SizingOptions at_throats(SizingOptions sizing, const geometry::VesselTree& axes,
                         const geometry::TriMesh& wall) {
  if (sizing.throat_share == 1.0) return sizing;
  const geometry::AabbTree tree(wall);
  geometry::VesselTree measured = axes;
  for (geometry::TreeSegment& segment : measured.segments)
    for (std::size_t i = 0; i < segment.axis.size(); ++i)
      segment.axis.radius[i] = tree.closest(segment.axis.points[i]).distance;
  for (const SizeFocus& focus : size_foci(find_throats(measured), sizing.throat_share))
    sizing.foci.push_back(focus);
  return sizing;
}

}  // namespace ostia::meshing
