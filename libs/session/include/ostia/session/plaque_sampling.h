#pragma once
/// \file What of a vessel's plaque is looked at: its pieces in a picture, a stenosis, a curve along the
/// vessel.

#include "ostia/session/outer_walls.h"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ostia::session {

/// From the axis outwards at one place and angle. Refers to the walls that it was asked of.
struct PlaqueRay {
  double lumen_mm = 0.0, outer_mm = 0.0;
  std::span<const std::optional<analysis::PlaqueClass>> pieces;  ///< equal ones, from the lumen outwards
  /// Nothing within the lumen, outside the wall, or where the wall is a thin one.
  std::optional<analysis::PlaqueClass> at(double rho_mm) const {
    if (!(rho_mm >= lumen_mm && rho_mm < outer_mm) || pieces.empty()) return std::nullopt;
    const auto count = static_cast<double>(pieces.size());
    const auto piece = static_cast<std::size_t>((rho_mm - lumen_mm) / (outer_mm - lumen_mm) * count);
    return pieces[piece < pieces.size() ? piece : pieces.size() - 1];
  }
};

/// The walls as they are at the place itself, the pieces of the slab and ray of the maps next to it. Nothing
/// beyond the stretch that was measured, or without maps. `theta` as in geometry::radial_direction.
std::optional<PlaqueRay> plaque_ray(const VesselWalls& walls, double s_mm, double theta);

/// Of a stenosis, cut to what was measured.
struct LesionPlaque {
  double from_mm = 0.0, to_mm = 0.0;
  analysis::PlaqueVolumes volumes;
  std::optional<double> remodelling_index;
};
/// Nothing where none of it was measured.
std::optional<LesionPlaque> plaque_of(const VesselWalls& walls, const analysis::Stenosis& lesion);

/// Diameter of the circle with the area within the outer wall, by abscissa: (s, diameter), one a slab.
std::vector<std::pair<double, double>> outer_diameters_mm(const VesselWalls& walls);

}  // namespace ostia::session
