#include "ostia/io/contour_file.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::io {
namespace {

using geometry::Contour;
using geometry::ContourSection;
using geometry::Vec3;
using nlohmann::json;

constexpr std::uint64_t most_contour_bytes = 2ULL << 30;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& field,
                         const std::string& what) {
  throw InvalidInput(path.string() + ": " + field + ": " + what +
                     "; the format is described in docs/reference/contours.md");
}

const json& member(const std::filesystem::path& path, const json& object, const std::string& where,
                   const char* name) {
  if (!object.is_object() || !object.contains(name)) refuse(path, where + name, "is missing");
  return object[name];
}

std::string text_of(const std::filesystem::path& path, const json& object, const std::string& where,
                    const char* name) {
  const json& value = member(path, object, where, name);
  if (!value.is_string() || value.get<std::string>().empty())
    refuse(path, where + name, "must be a text that is not empty");
  return value.get<std::string>();
}

double number_of(const std::filesystem::path& path, const json& value, const std::string& where) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    refuse(path, where, "must be a finite number");
  return value.get<double>();
}

Contour contour_of(const std::filesystem::path& path, const json& value, const std::string& where) {
  Contour contour;
  contour.s_mm = number_of(path, member(path, value, where, "s_mm"), where + "s_mm");
  const json& points = member(path, value, where, "points");
  if (!points.is_array()) refuse(path, where + "points", "must be a list of [x, y, z]");
  for (const json& p : points) {
    if (!p.is_array() || p.size() != 3) refuse(path, where + "points", "must be a list of [x, y, z]");
    contour.points.emplace_back(number_of(path, p[0], where + "points"),
                                number_of(path, p[1], where + "points"),
                                number_of(path, p[2], where + "points"));
  }
  return contour;
}

ContourSection section_of(const std::filesystem::path& path, const json& value, const std::string& where) {
  ContourSection section;
  section.section = text_of(path, value, where, "section");
  section.vessel = text_of(path, value, where, "vessel");
  section.observer = text_of(path, value, where, "observer");
  section.boundary = text_of(path, value, where, "boundary");
  if (section.boundary != "lumen" && section.boundary != "wall")
    refuse(path, where + "boundary", "must be lumen or wall, is " + section.boundary);
  const std::string health = text_of(path, value, where, "health");
  if (health != "healthy" && health != "diseased")
    refuse(path, where + "health", "must be healthy or diseased, is " + health);
  section.health = health == "diseased" ? geometry::Health::diseased : geometry::Health::healthy;
  const json& contours = member(path, value, where, "contours");
  if (!contours.is_array()) refuse(path, where + "contours", "must be a list");
  for (std::size_t i = 0; i < contours.size(); ++i)
    section.contours.push_back(contour_of(path, contours[i], where + "contours[" + std::to_string(i) + "]."));
  if (const auto fault = geometry::find_fault(section))
    refuse(path, where + "contours",
           "section " + section.section + " of " + section.observer + ": " + *fault);
  return section;
}

void require_text(const std::filesystem::path& path, const json& all, const char* name, const char* value) {
  const json& found = member(path, all, "", name);
  if (found != value)
    refuse(path, name, "must be " + std::string(value) + ", is " + found.dump() + "; convert the file first");
}

void add_coordinate(std::string& out, double value) {
  const std::string text = core::trimmed_text(value, 6);
  out += text == "-0" ? "0" : text;
}

void add_section(std::string& out, const ContourSection& section) {
  out += "{\"section\":" + json(section.section).dump() + ",\"vessel\":" + json(section.vessel).dump() +
         ",\"observer\":" + json(section.observer).dump() + ",\"boundary\":" + json(section.boundary).dump() +
         ",\"health\":\"" + (section.health == geometry::Health::diseased ? "diseased" : "healthy") +
         "\",\"contours\":[";
  bool first_contour = true;
  for (const Contour& contour : section.contours) {
    out += first_contour ? "\n{\"s_mm\":" : ",\n{\"s_mm\":";
    first_contour = false;
    add_coordinate(out, contour.s_mm);
    out += ",\"points\":[";
    bool first_point = true;
    for (const Vec3& p : contour.points) {
      out += first_point ? "[" : ",[";
      first_point = false;
      for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) out += ',';
        add_coordinate(out, p[axis]);
      }
      out += ']';
    }
    out += "]}";
  }
  out += "]}";
}

}  // namespace

geometry::ContourSet read_contours(const std::filesystem::path& path) {
  const std::string text = core::read_file(path, most_contour_bytes);
  if (text.empty()) throw InvalidInput(path.string() + " is empty; a file of contours is expected");
  json all;
  try {
    all = json::parse(text);
  } catch (const json::exception& error) {
    throw InvalidInput(path.string() + ": is no JSON: " + error.what());
  }
  if (!all.is_object()) refuse(path, "content", "must be one object");
  if (member(path, all, "", "v") != 1) refuse(path, "v", "must be 1");
  require_text(path, all, "unit", "mm");
  require_text(path, all, "axes", "LPS");
  const json& sections = member(path, all, "", "sections");
  if (!sections.is_array()) refuse(path, "sections", "must be a list");
  geometry::ContourSet set;
  for (std::size_t i = 0; i < sections.size(); ++i)
    set.sections.push_back(section_of(path, sections[i], "sections[" + std::to_string(i) + "]."));
  return set;
}

void write_contours(const std::filesystem::path& path, const geometry::ContourSet& contours) {
  std::string out = "{\"v\":1,\"unit\":\"mm\",\"axes\":\"LPS\",\"sections\":[";
  bool first = true;
  for (const ContourSection& section : contours.sections) {
    out += first ? "\n" : ",\n";
    first = false;
    add_section(out, section);
  }
  out += "\n]}\n";
  core::write_file(path, out);
}

}  // namespace ostia::io
