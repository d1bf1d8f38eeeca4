#include "mesh/mesh_input.h"

#include "input/points.h"
#include "input/table_file.h"
#include "output/refusal.h"

#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/io/surface_fields.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace ostia::app {
namespace {

using geometry::Vec3;

/// A direction is the difference of two points: that of voxels turns with the image's axes.
Vec3 parse_direction(const std::string& text, const std::string& coords, const imaging::Geometry* grid) {
  return parse_point(text, coords, grid) - parse_point("0,0,0", coords, grid);
}

meshing::PlacedPlane plane_of(const std::string& end, const std::string& origin, const std::string& normal,
                              const std::string& coords, const imaging::Geometry* grid) {
  meshing::PlacedPlane plane{end, parse_point(origin, coords, grid), parse_direction(normal, coords, grid)};
  if (plane.normal.isZero(0.0)) throw InvalidInput("the plane's normal " + normal + " has no direction");
  return plane;
}

meshing::PlacedPlane parse_plane(const std::string& text, const std::string& coords,
                                 const imaging::Geometry* grid) {
  const std::size_t equals = text.find('='), from = equals == std::string::npos ? 0 : equals + 1;
  const std::size_t colon = text.find(':', from);
  if (colon == std::string::npos || text.find(':', colon + 1) != std::string::npos)
    throw InvalidInput("\"" + text +
                       "\" is no plane: write [END=]x,y,z:nx,ny,nz, a point inside the lumen and a normal");
  return plane_of(from == 0 ? "" : text.substr(0, equals), text.substr(from, colon - from),
                  text.substr(colon + 1), coords, grid);
}

std::vector<meshing::PlacedPlane> planes_in(const std::filesystem::path& file, const std::string& coords,
                                            const imaging::Geometry* grid) {
  const Table table = read_table(file);
  std::array<std::size_t, 7> at{};
  constexpr std::array<const char*, 7> names{"end", "x", "y", "z", "nx", "ny", "nz"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::ranges::find(table.columns, names[i]);
    if (found == table.columns.end())
      throw InvalidInput(file.string() + " has no column " + names[i] +
                         "; a table of planes has end,x,y,z,nx,ny,nz");
    at[i] = static_cast<std::size_t>(found - table.columns.begin());
  }
  std::vector<meshing::PlacedPlane> planes;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::vector<std::string>& row = table.rows[r];
    try {
      planes.push_back(plane_of(row[at[0]], row[at[1]] + "," + row[at[2]] + "," + row[at[3]],
                                row[at[4]] + "," + row[at[5]] + "," + row[at[6]], coords, grid));
    } catch (const InvalidInput& error) {
      throw InvalidInput(file.string() + ", line " + std::to_string(table.lines[r]) + ": " + error.what());
    }
  }
  return planes;
}

/// The option that does what is offered.
std::string option_for(const meshing::ForecastPlace& place) {
  using meshing::OfferedRepair;
  const std::string factor = core::significant_text(place.factor, 2);
  switch (place.repair) {
    case OfferedRepair::convert_units:
      return place.factor == 1000.0 ? "--units m" : place.factor == 10.0 ? "--units cm" : "";
    case OfferedRepair::fill_holes:
      return "ostia convert --repair --fill-holes MM";
    case OfferedRepair::repair_surface:
    case OfferedRepair::orient:
      return "ostia convert --repair";
    case OfferedRepair::smaller_edges:
      return "--edge-ratio, " + factor + " times as large";
    case OfferedRepair::smooth:
      return "ostia convert --smooth 30";
    case OfferedRepair::thinner_layers:
      return "--layer-thickness, " + factor + " times as large";
    case OfferedRepair::drop_layers:
      return "--layers 0";
    case OfferedRepair::none:
      break;
  }
  return "";
}

nlohmann::json place_json(const meshing::ForecastPlace& place) {
  return {{"kind", name_of(place.kind)},
          {"fails", place.fails},
          {"point", {place.point.x(), place.point.y(), place.point.z()}},
          {"extent_mm", place.extent_mm},
          {"count", place.count},
          {"sentence", place.sentence},
          {"repair", name_of(place.repair)},
          {"way_out", place.repair_sentence},
          {"option", option_for(place)},
          {"factor", place.factor}};
}

nlohmann::json json_of(const meshing::MeshForecast& forecast) {
  nlohmann::json places = nlohmann::json::array();
  for (const meshing::ForecastPlace& place : forecast.places) places.push_back(place_json(place));
  return {{"fails", forecast.fails()}, {"places", std::move(places)}};
}

}  // namespace

std::vector<meshing::PlacedPlane> placed_planes(const MeshOptions& options, const std::string& coords,
                                                const imaging::Geometry* grid) {
  std::vector<meshing::PlacedPlane> planes;
  for (const std::string& text : options.planes) planes.push_back(parse_plane(text, coords, grid));
  if (options.planes_file.empty()) return planes;
  const std::vector<meshing::PlacedPlane> more = planes_in(options.planes_file, coords, grid);
  planes.insert(planes.end(), more.begin(), more.end());
  return planes;
}

void apply_size_array(const MeshOptions& options, const InputOptions& input, double unit_mm,
                      pipeline::ModelOptions& to) {
  if (options.size_array.empty()) return;
  const std::string file = own_name(input.input);
  if (input.input.extension() != ".vtp" && input.input.extension() != ".vtk")
    throw InvalidInput("--size-array: " + file + " has no point arrays; a surface as VTP (.vtp) has them");
  io::SurfaceWithFields read = io::read_surface_with_fields(input.input);
  for (Vec3& p : read.mesh.points) p *= unit_mm;
  const io::PointFields& fields = read.points;
  const auto found = fields.find(options.size_array);
  if (found == fields.end() || found->second.components != 1) {
    std::string all;
    for (const auto& [name, field] : fields)
      if (field.components == 1) all += (all.empty() ? "" : ", ") + name;
    throw InvalidInput("--size-array: " + file + " has no point array \"" + options.size_array +
                       "\" of one number a point; " + (all.empty() ? "it has none" : "it has " + all));
  }
  const std::vector<double>& lengths = found->second.values;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] > 0.0 && std::isfinite(lengths[i])) continue;
    const Vec3& p = read.mesh.points[i];
    const std::string place = "(" + core::significant_text(p.x(), 4) + ", " +
                              core::significant_text(p.y(), 4) + ", " + core::significant_text(p.z(), 4) +
                              ") mm";
    throw InvalidInput("--size-array: " + options.size_array + " of " + file + " is " +
                       std::to_string(lengths[i]) + " at point " + std::to_string(i) + ", " + place +
                       "; edge lengths are positive, in mm");
  }
  to.sizing.array = std::make_shared<const meshing::SizeArray>(meshing::SizeArray{read.mesh, lengths});
}

meshing::MeshForecast forecast_of(const geometry::FacedSurface& surface, const geometry::VesselTree* tree,
                                  const pipeline::ModelOptions& how, const core::TaskContext& task) {
  meshing::ForecastOptions options;
  options.tree = tree;
  options.sizing = how.sizing;
  options.layers = how.volume.layers;
  return meshing::mesh_forecast(surface, options, task);
}

std::string forecast_text(const meshing::ForecastPlace& place) {
  const std::string option = option_for(place);
  return place.sentence + (place.fails ? "; meshing may fail there: " : "; ") + place.repair_sentence +
         (option.empty() ? "" : " (" + option + ")");
}

void warn_of(const meshing::MeshForecast& forecast, bool of_the_surface, bool of_sizes) {
  std::map<meshing::TroubleKind, std::size_t> told;
  for (const meshing::ForecastPlace& place : forecast.places) ++told[place.kind];
  for (const meshing::ForecastPlace& place : forecast.places) {
    const bool surface = place.kind <= meshing::TroubleKind::self_intersections;
    const std::size_t count = std::exchange(told[place.kind], 0);
    if (count == 0 || !(surface ? of_the_surface : of_sizes)) continue;
    core::log_warning(
        forecast_text(place) +
        (count > 1 ? "; so at " + std::to_string(count) + " places (`ostia mesh` with --forecast lists them)"
                   : ""));
  }
}

std::string forecast_json(const meshing::MeshForecast& forecast) {
  return json_of(forecast).dump();
}

std::string with_forecast(const std::string& quality, const meshing::MeshForecast& forecast) {
  nlohmann::json all = nlohmann::json::parse(quality);
  all["forecast"] = json_of(forecast);
  return all.dump();
}

}  // namespace ostia::app
