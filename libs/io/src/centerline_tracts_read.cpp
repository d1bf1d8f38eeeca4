// Reads centerlines that are split into tracts.

#include "centerline_tracts.h"
#include "surface_formats.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace ostia::io {
namespace fs = std::filesystem;

namespace {

using geometry::BranchedLine;
using geometry::BranchedLines;
using geometry::Vec3;

// Nearer neighbours are one point: there is no direction between them.
constexpr double one_point_mm = 1e-9;
// A branch is led from the end of the one before to its own course within so many radii.
constexpr double led_radii = 2.0;

/// A cell of the file.
struct TractCell {
  std::int32_t vessel = 0, tract = 0, group = 0;
  bool blanked = false;
  std::vector<vtkIdType> ids;
};

vtkDataArray* tract_array(vtkPolyData& data, const char* name) {
  vtkDataArray* array = data.GetCellData()->GetArray(name);
  return array && array->GetNumberOfTuples() >= data.GetNumberOfCells() ? array : nullptr;
}

vtkDataArray* segment_array(vtkPolyData& data) {
  vtkDataArray* array = data.GetPointData()->GetArray("SegmentIds");
  return array && array->GetNumberOfTuples() >= data.GetNumberOfPoints() ? array : nullptr;
}

/// Vessels in the order in which they come, their tracts in that of TractIds.
std::vector<TractCell> tract_cells(vtkPolyData& data) {
  vtkDataArray *vessels = tract_array(data, "CenterlineIds"), *groups = tract_array(data, "GroupIds"),
               *tracts = tract_array(data, "TractIds"), *blanking = tract_array(data, "Blanking");
  std::vector<TractCell> cells;
  std::map<std::int32_t, std::size_t> order;
  const vtkIdType first = data.GetNumberOfVerts();
  for (vtkIdType c = 0; c < data.GetLines()->GetNumberOfCells(); ++c) {
    const auto number = [&](vtkDataArray* array) {
      return static_cast<std::int32_t>(array ? array->GetTuple1(first + c) : 0.0);
    };
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data.GetLines()->GetCellAtId(c, count, ids);
    cells.push_back(
        {number(vessels), number(tracts), number(groups), number(blanking) == 1, {ids, ids + count}});
    order.try_emplace(cells.back().vessel, order.size());
  }
  std::stable_sort(cells.begin(), cells.end(), [&](const TractCell& a, const TractCell& b) {
    return std::pair(order[a.vessel], a.tract) < std::pair(order[b.vessel], b.tract);
  });
  return cells;
}

/// A point of the file that may stand in a line.
struct FilePoint {
  Vec3 place;
  double radius = 0.0;
};
FilePoint checked_point(vtkPolyData& data, vtkDataArray& radius, vtkIdType id, const fs::path& path) {
  const FilePoint point{Vec3(data.GetPoint(id)), radius.GetTuple1(id)};
  if (!point.place.allFinite() || !(point.radius > 0.0 && std::isfinite(point.radius)))
    refuse(path, "point " + std::to_string(id) + " has no finite place or positive radius");
  return point;
}

vtkDataArray& checked_radius(vtkPolyData& data, const fs::path& path) {
  vtkDataArray* radius = radius_array(data);
  if (!radius || radius->GetNumberOfTuples() < data.GetNumberOfPoints())
    refuse(path, "its points have no array MaximumInscribedSphereRadius (or Radius)");
  return *radius;
}

/// First points of segments, which the lines of vessels share with the segment before.
std::map<std::int32_t, FilePoint> segment_starts(vtkPolyData& data) {
  std::map<std::int32_t, FilePoint> starts;
  vtkFieldData& fields = *data.GetFieldData();
  vtkDataArray *ids = fields.GetArray("SegmentStartIds"), *points = fields.GetArray("SegmentStartPoints"),
               *radii = fields.GetArray("SegmentStartRadii");
  if (!ids || !points || !radii || points->GetNumberOfComponents() != 3) return starts;
  const vtkIdType count =
      std::min({ids->GetNumberOfTuples(), points->GetNumberOfTuples(), radii->GetNumberOfTuples()});
  for (vtkIdType i = 0; i < count; ++i)
    starts[static_cast<std::int32_t>(ids->GetTuple1(i))] = {Vec3(points->GetTuple3(i)), radii->GetTuple1(i)};
  return starts;
}

void append_point(FileLine& line, const FilePoint& point) {
  if (!line.points.empty() && (line.points.back() - point.place).norm() < one_point_mm) return;
  line.points.push_back(point.place);
  line.radius.push_back(point.radius);
}

std::vector<FileLine> lines_of_segments(vtkPolyData& data, vtkDataArray& segments, const fs::path& path) {
  vtkDataArray& radius = checked_radius(data, path);
  const std::map<std::int32_t, FilePoint> starts = segment_starts(data);
  std::vector<FileLine> lines;
  for (const TractCell& cell : tract_cells(data)) {
    for (const vtkIdType id : cell.ids) {
      const auto segment = static_cast<std::int32_t>(segments.GetTuple1(id));
      if (segment < 0) continue;  // a place between the tree's own points
      const bool same_vessel = !lines.empty() && lines.back().vessel == cell.vessel;
      const FilePoint point = checked_point(data, radius, id, path);
      if (!same_vessel || lines.back().group != segment) {
        // The point where tracts meet is written twice; it is not where a segment begins anew.
        FileLine line{{}, {}, cell.vessel, segment};
        const auto start = starts.find(segment);
        if (start != starts.end())
          append_point(line, start->second);
        else if (same_vessel)
          append_point(line, {lines.back().points.back(), lines.back().radius.back()});
        lines.push_back(std::move(line));
      }
      append_point(lines.back(), point);
    }
  }
  for (const FileLine& line : lines)
    if (line.points.size() < 2)
      refuse(path, "its segment " + std::to_string(line.group) + " has fewer than two points");
  return lines;
}

/// The line's beginning moved to a place, and led over to its own course.
void lead_from(const Vec3& place, FileLine& line) {
  const Vec3 jump = place - line.points.front();
  const std::vector<double> s = geometry::abscissas(line.points);
  const double reach = std::min(led_radii * line.radius.front(), s.back());
  for (std::size_t i = 0; i + 1 < line.points.size() && s[i] < reach; ++i) {
    const double t = s[i] / reach;
    line.points[i] += (1.0 - t * t * (3.0 - 2.0 * t)) * jump;
  }
  line.points.front() = place;
}

std::vector<FileLine> lines_of_groups(const BranchedLines& branched) {
  std::vector<FileLine> lines;
  std::map<std::int32_t, Vec3> ends;  // of groups
  std::int32_t next = 0;
  for (const BranchedLine& line : branched.lines)
    for (const geometry::Tract& tract : line.tracts) next = std::max(next, tract.group + 1);
  for (const BranchedLine& line : branched.lines) {
    FileLine pending;
    std::optional<Vec3> before;
    const auto finish = [&](std::int32_t group) {
      const auto known = ends.find(group);
      if (known == ends.end() && before) lead_from(*before, pending);
      before = known == ends.end() ? pending.points.back() : known->second;
      ends.try_emplace(group, *before);
      pending.vessel = line.vessel;
      pending.group = group;
      lines.push_back(std::move(pending));
      pending = {};
    };
    for (const geometry::Tract& tract : line.tracts) {
      for (const geometry::LinePlace& place : tract.places)
        append_point(pending, {line.axis.points[place.piece], line.axis.radius[place.piece]});
      if (!tract.blanked) finish(tract.group);
    }
    if (pending.points.size() >= 2) finish(next++);  // it ends within a bifurcation
  }
  return lines;
}

}  // namespace

vtkDataArray* radius_array(vtkPolyData& data) {
  for (const char* name : {"MaximumInscribedSphereRadius", "Radius", "radius"}) {
    if (vtkDataArray* array = data.GetPointData()->GetArray(name)) return array;
  }
  return nullptr;
}

VesselNames vessel_names(vtkPolyData& data) {
  VesselNames names;
  auto* array = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray("VesselNames"));
  vtkDataArray* ids = data.GetFieldData()->GetArray("VesselIds");
  for (vtkIdType i = 0; array && ids && i < std::min(array->GetNumberOfValues(), ids->GetNumberOfTuples());
       ++i) {
    names[static_cast<std::int32_t>(ids->GetTuple1(i))] = array->GetValue(i);
  }
  return names;
}

bool has_tracts(vtkPolyData& data) {
  for (const char* name : {"CenterlineIds", "GroupIds", "TractIds", "Blanking"})
    if (!tract_array(data, name)) return false;
  if (segment_array(data)) return true;
  const std::vector<TractCell> cells = tract_cells(data);
  return std::any_of(cells.begin(), cells.end(), [](const TractCell& cell) { return cell.blanked; });
}

std::vector<FileLine> lines_of_tracts(vtkPolyData& data, const fs::path& path) {
  if (vtkDataArray* segments = segment_array(data)) return lines_of_segments(data, *segments, path);
  return lines_of_groups(branched_lines_of(data, path));
}

BranchedLines branched_lines_of(vtkPolyData& data, const fs::path& path) {
  vtkDataArray& radius = checked_radius(data, path);
  BranchedLines out;
  for (const TractCell& cell : tract_cells(data)) {
    if (out.lines.empty() || out.lines.back().vessel != cell.vessel)
      out.lines.push_back({cell.vessel, {}, {}, {}});
    BranchedLine& line = out.lines.back();
    FileLine so_far{std::move(line.axis.points), std::move(line.axis.radius), 0, 0};
    const std::size_t first = so_far.points.empty() ? 0 : so_far.points.size() - 1;
    for (const vtkIdType id : cell.ids) append_point(so_far, checked_point(data, radius, id, path));
    line.axis.points = std::move(so_far.points);
    line.axis.radius = std::move(so_far.radius);
    geometry::Tract tract{cell.group, cell.blanked, {}};
    for (std::size_t i = first; i < line.axis.points.size(); ++i) tract.places.push_back({i, 0.0});
    if (tract.places.size() >= 2) line.tracts.push_back(std::move(tract));
    out.groups = std::max(out.groups, cell.group + 1);
  }
  std::erase_if(out.lines, [](const BranchedLine& line) { return line.tracts.empty(); });
  if (out.lines.empty()) refuse(path, "it has no lines");
  for (BranchedLine& line : out.lines) geometry::complete(line.axis);
  return out;
}

}  // namespace ostia::io
