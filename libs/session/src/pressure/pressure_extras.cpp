#include "pressure/pressure_extras.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/polydata_file.h"

namespace ostia::session {
namespace {

io::Polydata polydata_of(const PressureWall& wall) {
  io::Polydata data;
  data.points = wall.wall.points;
  for (const auto& triangle : wall.wall.triangles)
    data.polygons.push_back({triangle[0], triangle[1], triangle[2]});
  const WallPressures& at = wall.at_points;
  data.at_points.numbers["FFR"] = {1, at.ffr};
  data.at_points.numbers["RestingPdPa"] = {1, at.resting_ratio};
  data.at_points.numbers["Pressure_mmHg"] = {1, at.pressure_mmhg};
  data.at_points.numbers["WallShear_Pa"] = {1, at.wall_shear_pa};
  data.at_points.numbers["Abscissas"] = {1, at.s_mm};
  data.at_points.whole["Vessel"] = at.vessel;
  data.at_points.whole["Branch"] = at.branch;
  data.at_points.whole["Occluded"] = at.occluded;
  return data;
}

}  // namespace

void write_pressure_extras(const std::filesystem::path& folder, const PressureReport& report) {
  if (report.wall) io::write_polydata(folder / "wall.vtp", polydata_of(*report.wall));
  for (const hemodynamics::NetworkFormat format : report.options.exports)
    for (const hemodynamics::NetworkFile& file : hemodynamics::export_network(
             *report.network, report.hyperaemia.boundary, report.hyperaemia.solution, format))
      core::write_file(folder / file.name, core::redacted(file.text));
}

}  // namespace ostia::session
