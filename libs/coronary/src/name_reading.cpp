#include "name_reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ostia::coronary {
namespace {

std::vector<TreePath> multiplied(std::vector<TreePath> paths, const Vec3& signs) {
  for (TreePath& path : paths)
    for (Vec3& point : path.points) point = point.cwiseProduct(signs);
  return paths;
}

/// A way about the aorta may go round the axis before it comes to the groove; angles count from there.
void set_places(const HeartFrame& frame, std::vector<TreePath>& paths) {
  constexpr double in_groove_mm = 50.0;
  for (TreePath& path : paths) {
    path.at = frame.places(path.points);
    const double turns = std::round(path.at[path.index(in_groove_mm)].angle_deg / 360.0);
    for (HeartPlace& at : path.at) at.angle_deg -= 360.0 * turns;
  }
}

/// Each root's place once.
std::vector<Vec3> ostia_of(const std::vector<TreePath>& paths, const std::vector<PathName>& names) {
  std::vector<std::pair<std::int32_t, Vec3>> ostia;
  for (std::size_t i = 0; i < paths.size(); ++i)
    if ((names.empty() || names[i].kind != "SVG") &&
        std::none_of(ostia.begin(), ostia.end(),
                     [&](const auto& known) { return known.first == paths[i].root; }))
      ostia.emplace_back(paths[i].root, paths[i].points.front());
  std::vector<Vec3> places;
  for (const auto& [root, place] : ostia) places.push_back(place);
  return places;
}

/// The left ostium lies to the left of the right one, behind it and above it.
double of_ostia(const std::vector<TreePath>& paths, const MainVessels& main) {
  constexpr double unknown = -6.0, most = 6.0;
  const Vec3 usual(16.0, 24.0, 14.0), spread(6.0, 8.0, 9.0);  // mm
  const int left = main.lad >= 0 ? main.lad : main.lcx;
  if (left < 0 || main.rca < 0) return unknown;
  const TreePath &from_left = paths[static_cast<std::size_t>(left)],
                 &from_right = paths[static_cast<std::size_t>(main.rca)];
  if (from_left.root == from_right.root) return unknown;
  const Vec3 apart = from_left.points.front() - from_right.points.front();
  const Vec3 off = (apart - usual).cwiseQuotient(spread);
  return -(0.5 * off.cwiseAbs2()).cwiseMin(most).sum();
}

}  // namespace

NameReading read_as(const std::vector<TreePath>& paths, const Vec3& signs,
                    const std::optional<Vec3>& long_axis) {
  constexpr int turns = 3;
  constexpr double usual_tilt = 0.3;  // rad
  NameReading reading;
  reading.signs = signs;
  reading.paths = multiplied(paths, signs);
  std::optional<Vec3> known;
  if (long_axis) known = long_axis->cwiseProduct(signs);
  const auto name = [&] {
    set_places(reading.frame, reading.paths);
    reading.sided = name_sided(reading.frame, reading.paths);
  };
  reading.frame = usual_frame(ostia_of(reading.paths, {}), known);
  name();
  const HeartFrame usual = usual_frame(ostia_of(reading.paths, reading.sided.names), known);
  if ((usual.base - reading.frame.base).norm() > 0.0) {
    reading.frame = usual;  // without grafts
    name();
  }
  // The ring that the first names give makes better names, and these a better ring.
  for (int turn = 0; turn < turns && !known; ++turn) {
    const auto better = frame_of_ring(usual, groove_points(reading.paths, reading.sided.main));
    if (!better) break;
    reading.frame = *better;
    name();
  }
  const double tilt = std::acos(std::clamp(usual.long_axis.dot(reading.frame.long_axis), -1.0, 1.0));
  reading.log_likelihood = reading.sided.log_likelihood + of_ostia(reading.paths, reading.sided.main) -
                           0.5 * std::pow(tilt / usual_tilt, 2.0);
  return reading;
}

NameReading likeliest_reading(const std::vector<TreePath>& paths, const std::optional<Vec3>& long_axis) {
  constexpr double as_said = 0.9;          // of images; the other ways share the rest
  constexpr double least_otherwise = 0.6;  // of another way, to be taken
  constexpr unsigned ways = 8;
  std::vector<NameReading> readings;
  if (ostia_of(paths, {}).size() < 2) {  // one tree alone may lie in more ways than one
    readings.push_back(read_as(paths, Vec3::Ones(), long_axis));
    readings.front().probability = as_said;
    return std::move(readings.front());
  }
  for (unsigned way = 0; way < ways; ++way) {
    const auto sign = [&](unsigned axis) { return (way >> axis) & 1U ? -1.0 : 1.0; };
    readings.push_back(read_as(paths, Vec3(sign(0), sign(1), sign(2)), long_axis));
    readings.back().log_likelihood += std::log(way == 0 ? as_said : (1.0 - as_said) / (ways - 1));
  }
  auto best = std::ranges::max_element(readings, {}, &NameReading::log_likelihood);
  const double most = best->log_likelihood;
  double all = 0.0;
  for (const NameReading& one : readings) all += std::exp(one.log_likelihood - most);
  if (1.0 / all < least_otherwise) best = readings.begin();
  best->probability = std::exp(best->log_likelihood - most) / all;
  return std::move(*best);
}

bool as_given(const NameReading& reading) {
  return reading.signs.minCoeff() > 0.0;
}

std::string word(const NameReading& reading) {
  static constexpr std::array<const char*, 3> swapped{"left to right", "front to back", "head to foot"};
  std::string what;
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (reading.signs[axis] > 0.0) continue;
    what += (count > 0 ? " and " : " ") + std::string(swapped[static_cast<std::size_t>(axis)]);
    ++count;
  }
  return count == 0 ? "as given" : (count == 2 ? "turned" : "mirrored") + what;
}

}  // namespace ostia::coronary
