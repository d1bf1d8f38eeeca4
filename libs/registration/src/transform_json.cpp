#include "ostia/registration/transform_json.h"

#include "ostia/core/error.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::registration {
namespace {

using Json = nlohmann::ordered_json;

Json numbers_of(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}
Json rows_of(const Mat3& m) {
  return Json::array({numbers_of(m.row(0)), numbers_of(m.row(1)), numbers_of(m.row(2))});
}

const Json& field_of(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name))
    throw InvalidInput(std::string("the transformation lacks its field \"") + name + "\"");
  return object[name];
}

double number_in(const Json& value, const char* name) {
  if (!value.is_number())
    throw InvalidInput(std::string("the transformation's field \"") + name + "\" must be made of numbers");
  return value.get<double>();
}

Vec3 vector_in(const Json& value, const char* name) {
  if (!value.is_array() || value.size() != 3)
    throw InvalidInput(std::string("the transformation's field \"") + name +
                       "\" must have three numbers a row");
  return {number_in(value[0], name), number_in(value[1], name), number_in(value[2], name)};
}

Mat3 matrix_in(const Json& value, const char* name) {
  if (!value.is_array() || value.size() != 3)
    throw InvalidInput(std::string("the transformation's field \"") + name + "\" must have three rows");
  Mat3 m;
  for (int row = 0; row < 3; ++row) m.row(row) = vector_in(value[row], name).transpose();
  return m;
}

SplineGrid grid_in(const Json& value) {
  SplineGrid grid;
  const Vec3 size = vector_in(field_of(value, "size"), "size");
  for (int a = 0; a < 3; ++a) {
    if (!(size[a] >= 4.0 && size[a] <= 10000.0) || size[a] != std::floor(size[a]))
      throw InvalidInput("the transformation's field \"size\" must be three whole numbers from 4 to 10000");
    grid.nodes.size[a] = static_cast<std::int64_t>(size[a]);
  }
  grid.nodes.spacing = vector_in(field_of(value, "spacing_mm"), "spacing_mm");
  grid.nodes.origin = vector_in(field_of(value, "origin_mm"), "origin_mm");
  grid.nodes.direction = matrix_in(field_of(value, "direction"), "direction");
  const Json& shifts = field_of(value, "shifts_mm");
  if (!shifts.is_array() || static_cast<std::int64_t>(shifts.size()) != 3 * grid.nodes.voxels())
    throw InvalidInput("the transformation's field \"shifts_mm\" must have three numbers for each node");
  grid.shifts_mm.reserve(shifts.size() / 3);
  for (std::size_t i = 0; i < shifts.size(); i += 3)
    grid.shifts_mm.emplace_back(number_in(shifts[i], "shifts_mm"), number_in(shifts[i + 1], "shifts_mm"),
                                number_in(shifts[i + 2], "shifts_mm"));
  return grid;
}

}  // namespace

std::string to_json(const Transform& transform) {
  Json out;
  out["linear"] = rows_of(transform.linear());
  out["offset_mm"] = numbers_of(transform.offset_mm());
  if (transform.spline()) {
    const imaging::Geometry& nodes = transform.spline()->nodes;
    Json& spline = out["spline"];
    spline["size"] = nodes.size;
    spline["spacing_mm"] = numbers_of(nodes.spacing);
    spline["origin_mm"] = numbers_of(nodes.origin);
    spline["direction"] = rows_of(nodes.direction);
    Json& shifts = spline["shifts_mm"] = Json::array();
    for (const Vec3& shift : transform.spline()->shifts_mm)
      for (const double s : shift) shifts.push_back(s);
  }
  return out.dump();
}

Transform transform_of_json(std::string_view text) {
  const Json in = Json::parse(text, nullptr, false);
  if (in.is_discarded() || !in.is_object()) throw InvalidInput("the transformation is not a JSON object");
  std::optional<SplineGrid> spline;
  if (in.contains("spline")) spline = grid_in(in["spline"]);
  return {matrix_in(field_of(in, "linear"), "linear"), vector_in(field_of(in, "offset_mm"), "offset_mm"),
          std::move(spline)};
}

}  // namespace ostia::registration
