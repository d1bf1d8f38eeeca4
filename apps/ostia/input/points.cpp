#include "input/points.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ostia::app {
namespace {

using geometry::Vec3;

double number(std::string_view text, std::string_view whole) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw InvalidInput("\"" + std::string(whole) +
                       "\" is no point: write x,y,z, three numbers in millimetres with a decimal point");
  }
  return value;
}

}  // namespace

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = std::min(text.find(separator), text.size());
    parts.push_back(text.substr(0, at));
    if (at == text.size()) return parts;
    text.remove_prefix(at + 1);
  }
}

Vec3 world_of(const Vec3& given, const std::string& coords, const imaging::Geometry* grid) {
  if (coords == "ras") return {-given.x(), -given.y(), given.z()};
  if (coords != "ijk") return given;
  if (!grid) throw InvalidInput("--coords ijk needs an image as input; a surface has no voxels");
  return grid->world(given);
}

Vec3 parse_point(std::string_view text, const std::string& coords, const imaging::Geometry* grid) {
  const std::vector<std::string_view> parts = parts_of(text, ',');
  if (parts.size() != 3)
    throw InvalidInput("\"" + std::string(text) +
                       "\" is no point: write x,y,z, three numbers in millimetres");
  return world_of({number(parts[0], text), number(parts[1], text), number(parts[2], text)}, coords, grid);
}

}  // namespace ostia::app
