#include "ostia/io/cage_motion_file.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ostia::io {
namespace {

using geometry::PhaseOrigin;
using geometry::Vec3;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t most_cage_bytes = 2ULL << 30;
constexpr double percents_digits = 1e9;  // kept behind the point
constexpr std::size_t least_phases = 3;  // of a periodic spline
constexpr std::size_t most_phases = 1000;

constexpr std::array<std::pair<PhaseOrigin, const char*>, 3> origins = {
    {{PhaseOrigin::at_rest, "at_rest"}, {PhaseOrigin::fitted, "fitted"}, {PhaseOrigin::bridged, "bridged"}}};

const char* name_of(PhaseOrigin origin) {
  for (const auto& [one, name] : origins)
    if (one == origin) return name;
  return "fitted";
}

/// One file's members; what is wrong with one is told with its name.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path.string()) {}

  [[noreturn]] void refuse(const std::string& field, const std::string& what) const {
    throw InvalidInput("cannot read " + path_ + ": " + field + " " + what +
                       "; see docs/schemas/cage-motion.schema.json");
  }

  const Json& member(const Json& object, const std::string& field, const std::string& name) const {
    if (!object.is_object()) refuse(field.empty() ? "the whole" : field, "is no object");
    const auto found = object.find(name);
    if (found == object.end()) refuse(joined(field, name), "is missing");
    return *found;
  }

  double number(const Json& object, const std::string& field, const std::string& name) const {
    const Json& value = member(object, field, name);
    if (!value.is_number()) refuse(joined(field, name), "is no number");
    return value.get<double>();
  }

  Vec3 vector(const Json& value, const std::string& field) const {
    if (!value.is_array() || value.size() != 3 || !value[0].is_number() || !value[1].is_number() ||
        !value[2].is_number())
      refuse(field, "is not [x, y, z]");
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
  }

  PhaseOrigin origin(const Json& phase, const std::string& field) const {
    const Json& value = member(phase, field, "origin");
    for (const auto& [origin, name] : origins)
      if (value == name) return origin;
    refuse(joined(field, "origin"), "is none of at_rest, fitted, bridged");
  }

  static std::string joined(const std::string& field, const std::string& name) {
    return field.empty() ? name : field + "." + name;
  }

 private:
  std::string path_;
};

bool is_plain_name(const std::string& name) {
  return name.find_first_of("/\\") == std::string::npos && name != "." && name != "..";
}

geometry::CageGrid grid_from(const Reader& reader, const Json& all) {
  const Json& grid = reader.member(all, "", "grid");
  geometry::CageGrid out;
  out.origin = reader.vector(reader.member(grid, "grid", "origin_mm"), "grid.origin_mm");
  out.cell_mm = reader.vector(reader.member(grid, "grid", "cell_mm"), "grid.cell_mm");
  const Json& cells = reader.member(grid, "grid", "cells");
  if (!cells.is_number_integer() || cells < 1 || cells > 256)
    reader.refuse("grid.cells", "is no whole number from 1 to 256");
  out.cells = cells.get<int>();
  return out;
}

geometry::CagePhase phase_from(const Reader& reader, const Json& phase, const std::string& field) {
  geometry::CagePhase out;
  out.phase = reader.number(phase, field, "percent") / 100.0;
  out.origin = reader.origin(phase, field);
  const Json& points = reader.member(phase, field, "control_points");
  if (!points.is_array()) reader.refuse(field + ".control_points", "is no list");
  out.control_points.reserve(points.size());
  for (const Json& p : points)
    out.control_points.push_back(
        reader.vector(p, field + ".control_points[" + std::to_string(out.control_points.size()) + "]"));
  return out;
}

Json written(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

bool is_count_of_phases(std::size_t count) {
  return count >= least_phases && count <= most_phases;
}

std::string wrong_count(std::size_t count) {
  return "are " + std::to_string(count) + "; a cycle has three at least and " + std::to_string(most_phases) +
         " at most";
}

}  // namespace

double percent_of(double phase) {
  const double percent = std::round(phase * 100.0 * percents_digits) / percents_digits;
  return std::min(percent, 100.0 - 1.0 / percents_digits);
}

CageMotionFile read_cage_motion(const std::filesystem::path& path) {
  const Reader reader(path);
  const Json all = Json::parse(core::read_file(path, most_cage_bytes), nullptr, false);
  if (all.is_discarded()) reader.refuse("the whole", "is no JSON");
  if (reader.member(all, "", "kind") != "cage-motion") reader.refuse("kind", "is not cage-motion");
  if (reader.member(all, "", "v") != 1) reader.refuse("v", "is not 1: it was written by another version");
  if (reader.member(all, "", "unit") != "mm") reader.refuse("unit", "is not mm");
  if (reader.member(all, "", "axes") != "LPS") reader.refuse("axes", "is not LPS");
  CageMotionFile file;
  file.motion.grid = grid_from(reader, all);
  const Json& shape = reader.member(all, "", "template");
  file.motion.template_phase = reader.number(shape, "template", "percent") / 100.0;
  const Json& surface = reader.member(shape, "template", "surface");
  if (!surface.is_null() && (!surface.is_string() || !is_plain_name(surface.get<std::string>())))
    reader.refuse("template.surface", "is no name of a file beside this one");
  if (surface.is_string()) file.surface = surface.get<std::string>();
  const Json& phases = reader.member(all, "", "phases");
  if (!phases.is_array()) reader.refuse("phases", "is no list");
  if (!is_count_of_phases(phases.size())) reader.refuse("phases", wrong_count(phases.size()));
  for (const Json& phase : phases)
    file.motion.phases.push_back(
        phase_from(reader, phase, "phases[" + std::to_string(file.motion.phases.size()) + "]"));
  geometry::validate(file.motion, "cannot read " + path.string() + ": the motion");
  return file;
}

void write_cage_motion(const std::filesystem::path& path, const CageMotionFile& file) {
  geometry::validate(file.motion, "cannot write " + path.string() + ": the motion");
  if (!is_count_of_phases(file.motion.phases.size()))
    throw InvalidInput("cannot write " + path.string() + ": the phases " +
                       wrong_count(file.motion.phases.size()));
  if (!is_plain_name(file.surface))
    throw InvalidInput("cannot write " + path.string() + ": the template's surface is no file beside it");
  const geometry::CageGrid& grid = file.motion.grid;
  Json all{{"v", 1},
           {"kind", "cage-motion"},
           {"unit", "mm"},
           {"axes", "LPS"},
           {"grid",
            {{"origin_mm", written(grid.origin)}, {"cell_mm", written(grid.cell_mm)}, {"cells", grid.cells}}},
           {"template",
            {{"percent", percent_of(file.motion.template_phase)},
             {"surface", file.surface.empty() ? Json(nullptr) : Json(file.surface)}}}};
  Json& phases = all["phases"] = Json::array();
  for (const geometry::CagePhase& one : file.motion.phases) {
    Json points = Json::array();
    for (const Vec3& p : one.control_points) points.push_back(written(p));
    phases.push_back({{"percent", percent_of(one.phase)},
                      {"origin", name_of(one.origin)},
                      {"control_points", std::move(points)}});
  }
  core::write_file(path, all.dump() + "\n");
}

}  // namespace ostia::io
