#include "ostia/session/plaque_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::session {

std::optional<PlaqueRay> plaque_ray(const VesselWalls& walls, double s_mm, double theta) {
  const analysis::PlaqueProfile& plaque = walls.plaque;
  if (walls.maps.empty() || !(s_mm >= plaque.from_mm && s_mm <= plaque.to_mm)) return std::nullopt;
  const double slabs = static_cast<double>(walls.maps.size());
  const double along = (s_mm - plaque.from_mm) / (plaque.to_mm - plaque.from_mm) * slabs;
  const analysis::PlaqueMap& map = walls.maps[static_cast<std::size_t>(std::min(along, slabs - 1.0))];
  const double turns = theta / (2.0 * std::numbers::pi);
  const int ray = std::min(map.around - 1, static_cast<int>((turns - std::floor(turns)) * map.around));
  PlaqueRay out;
  out.lumen_mm = walls.lumen.at(s_mm, theta);
  out.outer_mm = std::max(out.lumen_mm, walls.outer.surface.at(s_mm, theta));
  out.pieces = std::span(map.pieces)
                   .subspan(static_cast<std::size_t>(ray) * static_cast<std::size_t>(map.deep),
                            static_cast<std::size_t>(map.deep));
  return out;
}

std::optional<LesionPlaque> plaque_of(const VesselWalls& walls, const analysis::Stenosis& lesion) {
  LesionPlaque out;
  out.from_mm = std::max(lesion.from_mm, walls.plaque.from_mm);
  out.to_mm = std::min(lesion.to_mm, walls.plaque.to_mm);
  if (!(out.from_mm < out.to_mm)) return std::nullopt;
  out.volumes = analysis::plaque_between(walls.plaque, out.from_mm, out.to_mm);
  out.remodelling_index = analysis::remodelling_index(walls.plaque, lesion);
  return out;
}

std::vector<std::pair<double, double>> outer_diameters_mm(const VesselWalls& walls) {
  std::vector<std::pair<double, double>> out;
  for (const analysis::PlaqueSlab& slab : walls.plaque.slabs)
    out.emplace_back(slab.s_mm, 2.0 * std::sqrt(slab.vessel_mm2 / std::numbers::pi));
  return out;
}

}  // namespace ostia::session
