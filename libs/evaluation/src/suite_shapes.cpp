// Surfaces, lines, contours and points of two runs, in millimetres.

#include "suite_files.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/evaluation/axis_error.h"
#include "ostia/evaluation/frame_hint.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/geometry/polyline.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace ostia::evaluation {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

void note(FindingKind kind, const std::string& key, const std::string& text, ComparedFile& file,
          std::vector<Finding>& findings) {
  findings.push_back({kind, file.file, key, std::nullopt, std::nullopt, 0.0, text});
  if (kind == FindingKind::regression || kind == FindingKind::missing) file.differs = true;
}

/// Adds to the file's findings why its places may be off, where units or axes explain it.
void explain(const std::vector<Vec3>& golden, const std::vector<Vec3>& result, ComparedFile& file,
             std::vector<Finding>& findings) {
  const std::string hint = hint_of_other_frame(golden, result);
  if (!hint.empty()) note(FindingKind::regression, "", hint, file, findings);
}

TriMesh read_mesh(const std::filesystem::path& path) {
  if (path.extension() == ".vtu") return geometry::boundary_triangles(io::read_volume_mesh(path));
  return io::read_surface(path).surface.mesh;
}

/// Distances between two lines, from every point of each to the other.
struct LineDistance {
  double sum_mm = 0.0, max_mm = 0.0, radius_mm = 0.0;
  std::size_t points = 0;
  double mean_mm() const { return points == 0 ? 0.0 : sum_mm / static_cast<double>(points); }
};

void add_one_way(const geometry::Centerline& from, const geometry::Centerline& to, LineDistance& total) {
  for (const AxisDeviation& d : compare_axes(to, from)) {
    total.sum_mm += d.distance_mm;
    total.max_mm = std::max(total.max_mm, d.distance_mm);
    total.radius_mm = std::max(total.radius_mm, std::abs(d.radius_mm - d.reference_radius_mm));
    ++total.points;
  }
}

void judge_lines(const LineDistance& total, const ShapeRule& rule, bool with_radius, ComparedFile& file,
                 std::vector<Finding>& findings) {
  judge_distance("mean_mm", total.mean_mm(), rule.mean_mm, file, findings);
  judge_distance("max_mm", total.max_mm, rule.max_mm, file, findings);
  if (with_radius) judge_distance("radius_mm", total.radius_mm, rule.radius_mm, file, findings);
}

std::map<std::string, geometry::Centerline> axes_by_name(const geometry::VesselTree& tree) {
  std::map<std::string, geometry::Centerline> axes;
  for (const geometry::Vessel& vessel : tree.vessels) {
    std::string name = vessel.name.empty() ? "vessel" + std::to_string(vessel.id) : vessel.name;
    while (axes.contains(name)) name += "'";
    axes[name] = vessel_axis(tree, vessel);
  }
  return axes;
}

/// From every point of a closed line to the other one, closed.
void add_closed(const std::vector<Vec3>& from, std::vector<Vec3> to, LineDistance& total) {
  to.push_back(to.front());
  for (const Vec3& p : from) {
    const double distance = (geometry::closest(to, p).point - p).norm();
    total.sum_mm += distance;
    total.max_mm = std::max(total.max_mm, distance);
    ++total.points;
  }
}

using Sections = std::map<std::string, const geometry::ContourSection*>;

Sections sections_of(const geometry::ContourSet& set) {
  Sections sections;
  for (const auto& s : set.sections)
    sections[s.section + "," + s.vessel + "," + s.boundary + "," + s.observer] = &s;
  return sections;
}

LineDistance distance_of(const geometry::ContourSection& golden, const geometry::ContourSection& result,
                         std::size_t& without_partner) {
  constexpr double same_place_mm = 0.005;
  LineDistance total;
  for (const geometry::Contour& a : golden.contours) {
    const auto partner = std::find_if(result.contours.begin(), result.contours.end(), [&](const auto& b) {
      return std::abs(a.s_mm - b.s_mm) <= same_place_mm;
    });
    if (partner == result.contours.end()) {
      ++without_partner;
      continue;
    }
    add_closed(a.points, partner->points, total);
    add_closed(partner->points, a.points, total);
  }
  return total;
}

/// Rows of numbers, columns parted by blanks.
std::vector<std::vector<double>> rows_of(const std::filesystem::path& path, const std::string& name) {
  const std::string text = core::read_file(path, 1ULL << 30);
  std::vector<std::vector<double>> rows;
  const char* at = text.data();
  const char* const end = at + text.size();
  std::size_t line = 1;
  std::vector<double> row;
  const auto finish = [&] {
    if (row.empty()) return;
    if (!rows.empty() && rows.front().size() != row.size())
      throw InvalidInput(name + ": line " + std::to_string(line) + " has another number of columns");
    rows.push_back(std::move(row));
    row.clear();
  };
  while (at < end) {
    if (*at == '\n') {
      finish();
      ++line;
      ++at;
    } else if (*at == ' ' || *at == '\t' || *at == '\r') {
      ++at;
    } else {
      double value = 0.0;
      const auto [next, error] = std::from_chars(at, end, value);
      const bool whole = next == end || *next == ' ' || *next == '\t' || *next == '\r' || *next == '\n';
      if (error != std::errc() || !whole || !std::isfinite(value))
        throw InvalidInput(name + ": line " + std::to_string(line) + ": not a row of finite numbers");
      row.push_back(value);
      at = next;
    }
  }
  finish();
  if (rows.empty()) throw InvalidInput(name + " is empty");
  if (rows.front().size() < 3) throw InvalidInput(name + ": fewer than three columns x y z");
  return rows;
}

geometry::Centerline line_of(const std::vector<std::vector<double>>& rows) {
  geometry::Centerline line;
  for (const auto& row : rows) {
    line.points.emplace_back(row[0], row[1], row[2]);
    line.radius.push_back(row.size() > 3 ? row[3] : 0.0);
  }
  line.abscissa = geometry::abscissas(line.points);
  return line;
}

}  // namespace

void compare_surface_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                           std::vector<Finding>& findings, const core::TaskContext& task) {
  const TriMesh golden = read_mesh(pair.golden), result = read_mesh(pair.result);
  explain(golden.points, result.points, file, findings);
  const SurfaceDistances d = compare_surfaces(golden, result, {}, task);
  const ShapeRule rule = rule_for(tolerances.surfaces, pair.name);
  judge_distance("mean_mm", d.msd_mm, rule.mean_mm, file, findings);
  judge_distance("max_mm", d.max_sd_mm, rule.max_mm, file, findings);
}

void compare_line_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                        std::vector<Finding>& findings) {
  const auto golden = axes_by_name(io::read_centerlines(pair.golden));
  const auto result = axes_by_name(io::read_centerlines(pair.result));
  std::vector<Vec3> golden_points, result_points;
  LineDistance total;
  for (const auto& [name, axis] : golden) {
    const auto found = result.find(name);
    if (found == result.end()) {
      note(FindingKind::missing, name, "the result does not have the vessel " + name, file, findings);
      continue;
    }
    golden_points.insert(golden_points.end(), axis.points.begin(), axis.points.end());
    result_points.insert(result_points.end(), found->second.points.begin(), found->second.points.end());
    add_one_way(axis, found->second, total);
    add_one_way(found->second, axis, total);
  }
  for (const auto& [name, axis] : result)
    if (!golden.contains(name))
      note(FindingKind::extra, name, "the golden run does not have the vessel " + name, file, findings);
  explain(golden_points, result_points, file, findings);
  judge_lines(total, rule_for(tolerances.lines, pair.name), true, file, findings);
}

void compare_contour_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                           std::vector<Finding>& findings) {
  const geometry::ContourSet golden_set = io::read_contours(pair.golden);
  const geometry::ContourSet result_set = io::read_contours(pair.result);
  const Sections golden = sections_of(golden_set), result = sections_of(result_set);
  LineDistance total;
  for (const auto& [name, section] : golden) {
    const auto found = result.find(name);
    if (found == result.end()) {
      note(FindingKind::missing, name, "the result does not have the section " + name, file, findings);
      continue;
    }
    std::size_t without_partner = 0;
    const LineDistance one = distance_of(*section, *found->second, without_partner);
    if (without_partner > 0)
      note(FindingKind::missing, name,
           std::to_string(without_partner) + " contours of section " + name + " have none at their abscissa",
           file, findings);
    total.sum_mm += one.sum_mm;
    total.points += one.points;
    total.max_mm = std::max(total.max_mm, one.max_mm);
  }
  for (const auto& item : result)
    if (!golden.contains(item.first))
      note(FindingKind::extra, item.first, "the golden run does not have the section " + item.first, file,
           findings);
  judge_lines(total, rule_for(tolerances.contours, pair.name), false, file, findings);
}

void compare_point_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                         std::vector<Finding>& findings) {
  const auto golden = line_of(rows_of(pair.golden, pair.name + " of the golden run"));
  const auto result = line_of(rows_of(pair.result, pair.name + " of the new run"));
  const ShapeRule rule = rule_for(tolerances.lines, pair.name);
  explain(golden.points, result.points, file, findings);
  if (golden.size() == 1 || result.size() == 1) {
    if (golden.size() != result.size())
      note(FindingKind::regression, "points",
           std::to_string(result.size()) + " points where there were " + std::to_string(golden.size()), file,
           findings);
    judge_distance("max_mm", (golden.points.front() - result.points.front()).norm(), rule.max_mm, file,
                   findings);
    return;
  }
  LineDistance total;
  add_one_way(golden, result, total);
  add_one_way(result, golden, total);
  judge_lines(total, rule, true, file, findings);
}

}  // namespace ostia::evaluation
