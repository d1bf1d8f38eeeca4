#include "ostia/io/centerline_file.h"

#include "surface_formats.h"
#include "vtk/xml.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::Centerline;
using geometry::TreeSegment;
using geometry::Vec3;
using geometry::Vessel;
using geometry::VesselTree;

constexpr double same_node_mm = 1e-6;

/// One polyline of a file.
struct Line {
  std::vector<Vec3> points;
  std::vector<double> radius;
  std::int32_t vessel = 0, group = 0;
};

/// Curvature and torsion by differences of tangents and of osculating planes, for display and statistics.
struct Bending {
  std::vector<double> curvature, torsion;
};

Bending bending(const Centerline& line) {
  const std::size_t n = line.size();
  Bending out{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  std::vector<Vec3> binormals(n, Vec3::Zero());
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double step = line.abscissa[i + 1] - line.abscissa[i - 1];
    const Vec3 change = (line.frames[i + 1].tangent - line.frames[i - 1].tangent) / step;
    out.curvature[i] = change.norm();
    binormals[i] = line.frames[i].tangent.cross(change);
  }
  for (std::size_t i = 2; i + 2 < n; ++i) {
    const Vec3 a = binormals[i - 1].normalized(), b = binormals[i + 1].normalized();
    const double angle = std::atan2(a.cross(b).dot(line.frames[i].tangent), a.dot(b));
    // A nearly straight piece has no osculating plane.
    if (out.curvature[i] > 1e-4) out.torsion[i] = angle / (line.abscissa[i + 1] - line.abscissa[i - 1]);
  }
  return out;
}

std::int32_t node_at(VesselTree& tree, const Vec3& position) {
  for (const geometry::TreeNode& known : tree.nodes) {
    if ((known.position - position).norm() <= same_node_mm) return known.id;
  }
  tree.nodes.push_back({static_cast<std::int32_t>(tree.nodes.size()), position});
  return tree.nodes.back().id;
}

/// Segments from groups, vessels from centerlines in the order they come.
VesselTree tree_of(const std::vector<Line>& lines, const std::map<std::int32_t, std::string>& names) {
  VesselTree tree;
  std::set<std::int32_t> groups;
  std::map<std::int32_t, std::size_t> vessels;
  for (const Line& line : lines) {
    if (groups.insert(line.group).second) {
      TreeSegment segment;
      segment.id = line.group;
      segment.axis.points = line.points;
      segment.axis.radius = line.radius;
      segment.from = node_at(tree, line.points.front());
      segment.to = node_at(tree, line.points.back());
      geometry::complete(segment.axis);
      tree.segments.push_back(std::move(segment));
    }
    const auto [found, added] = vessels.try_emplace(line.vessel, tree.vessels.size());
    if (added) {
      const auto name = names.find(line.vessel);
      tree.vessels.push_back(
          {line.vessel,
           name != names.end() ? name->second : "vessel_" + std::to_string(tree.vessels.size() + 1),
           {}});
    }
    tree.vessels[found->second].segments.push_back(line.group);
  }
  return tree;
}

vtkDataArray* radius_array(vtkPolyData& data) {
  for (const char* name : {"MaximumInscribedSphereRadius", "Radius", "radius"}) {
    if (vtkDataArray* array = data.GetPointData()->GetArray(name)) return array;
  }
  return nullptr;
}

std::map<std::int32_t, std::string> vessel_names(vtkPolyData& data) {
  std::map<std::int32_t, std::string> names;
  auto* array = vtkStringArray::SafeDownCast(data.GetFieldData()->GetAbstractArray("VesselNames"));
  vtkDataArray* ids = data.GetFieldData()->GetArray("VesselIds");
  for (vtkIdType i = 0; array && ids && i < std::min(array->GetNumberOfValues(), ids->GetNumberOfTuples());
       ++i) {
    names[static_cast<std::int32_t>(ids->GetTuple1(i))] = array->GetValue(i);
  }
  return names;
}

VesselTree read_polydata_lines(const fs::path& path) {
  const vtkSmartPointer<vtkPolyData> data = read_polydata(path);
  vtkDataArray* radius = radius_array(*data);
  if (!radius) refuse(path, "its points have no array MaximumInscribedSphereRadius (or Radius)");
  vtkDataArray* group = data->GetCellData()->GetArray("GroupIds");
  vtkDataArray* vessel = data->GetCellData()->GetArray("CenterlineIds");
  std::vector<Line> lines;
  const vtkIdType first = data->GetNumberOfVerts();
  for (vtkIdType c = 0; c < data->GetLines()->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data->GetLines()->GetCellAtId(c, count, ids);
    Line line;
    line.group = static_cast<std::int32_t>(group ? group->GetTuple1(first + c) : c);
    line.vessel = static_cast<std::int32_t>(vessel && group ? vessel->GetTuple1(first + c) : c);
    for (vtkIdType i = 0; i < count; ++i) {
      const Vec3 point(data->GetPoint(ids[i]));
      // Neighbours at one place have no direction between them.
      if (!line.points.empty() && (line.points.back() - point).norm() < 1e-9) continue;
      const double r = radius->GetTuple1(ids[i]);
      if (!point.allFinite() || !(r > 0.0 && std::isfinite(r)))
        refuse(path, "line " + std::to_string(c) + ", point " + std::to_string(i) +
                         " has no finite place or positive radius");
      line.points.push_back(point);
      line.radius.push_back(r);
    }
    if (line.points.size() >= 2) lines.push_back(std::move(line));
  }
  if (lines.empty()) refuse(path, "it has no lines");
  return tree_of(lines, vessel_names(*data));
}

/// Without the blanks around them.
std::vector<std::string> columns(std::string_view row, std::size_t number, const fs::path& path) {
  std::vector<std::string> out;
  core::CsvCell cell;
  do {
    cell = core::take_csv_cell(row);
    if (!cell.closed) refuse(path, "the quotation in row " + std::to_string(number) + " does not end");
    const std::size_t from = std::min(cell.text.find_first_not_of(' '), cell.text.size());
    out.push_back(cell.text.substr(from, cell.text.find_last_not_of(' ') + 1 - from));
  } while (!cell.last);
  return out;
}

VesselTree read_csv(const fs::path& path) {
  const std::string content = core::read_file(path);
  Words rows(content);
  const std::vector<std::string> header = columns(rows.line(), 1, path);
  const auto column = [&](std::string_view name) {
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? -1 : static_cast<int>(found - header.begin());
  };
  const std::array<int, 4> wanted{column("x"), column("y"), column("z"), column("radius")};
  if (*std::min_element(wanted.begin(), wanted.end()) < 0)
    refuse(path, "its first row must name the columns x,y,z,radius");
  const int vessel_column = column("vessel");
  std::vector<Line> lines;
  std::map<std::int32_t, std::string> names;
  std::string current;
  bool fresh = true;
  for (std::size_t row = 2; !rows.empty(); ++row) {
    const std::string_view text = rows.line();
    if (text.find_first_not_of(" \t") == std::string_view::npos) {
      fresh = true;
      continue;
    }
    const std::vector<std::string> cells = columns(text, row, path);
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto value = static_cast<std::size_t>(wanted[i]) < cells.size()
                             ? number<double>(cells[static_cast<std::size_t>(wanted[i])])
                             : std::nullopt;
      if (!value || !std::isfinite(*value))
        refuse(path, "row " + std::to_string(row) + ", column " +
                         header[static_cast<std::size_t>(wanted[i])] + " is no number");
      values[i] = *value;
    }
    if (!(values[3] > 0.0)) refuse(path, "row " + std::to_string(row) + ": the radius must be positive");
    const std::string name(vessel_column >= 0 && static_cast<std::size_t>(vessel_column) < cells.size()
                               ? cells[static_cast<std::size_t>(vessel_column)]
                               : "");
    if (fresh || name != current) {
      const auto id = static_cast<std::int32_t>(lines.size());
      lines.push_back({{}, {}, id, id});
      if (!name.empty()) names[id] = name;
    }
    fresh = false;
    current = name;
    lines.back().points.emplace_back(values[0], values[1], values[2]);
    lines.back().radius.push_back(values[3]);
  }
  if (lines.empty()) refuse(path, "it has no points");
  for (const Line& line : lines) {
    if (line.points.size() < 2) refuse(path, "a line has fewer than two points");
  }
  return tree_of(lines, names);
}

std::string csv_text(const VesselTree& tree) {
  std::string out = "vessel,x,y,z,radius,abscissa\n";
  for (const Vessel& vessel : tree.vessels) {
    const Centerline axis = geometry::vessel_axis(tree, vessel);
    if (vessel.name.find_first_of("\r\n") != std::string::npos)
      throw InvalidInput(
          "the vessel name " + core::csv_cell(vessel.name) +
          " has a line's end, which CSV files of centerlines cannot hold: rename it, or write .vtp");
    const std::string name = core::csv_cell(vessel.name);
    for (std::size_t i = 0; i < axis.size(); ++i) {
      std::array<char, 64> text{};
      out += name;
      for (const double value :
           {axis.points[i].x(), axis.points[i].y(), axis.points[i].z(), axis.radius[i], axis.abscissa[i]}) {
        const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
        out += ',';
        out.append(text.data(), end);
      }
      out += '\n';
    }
  }
  return out;
}

/// The arrays of all lines of a file, one point after another.
struct Columns {
  std::vector<Vec3> points, normals, tangents;
  std::vector<double> radius, abscissa, curvature, torsion;
  std::vector<std::int32_t> vessel, group, tract, blanking;
};

void append(Columns& columns, const Centerline& axis, double start_mm) {
  const Bending bends = bending(axis);
  for (std::size_t i = 0; i < axis.size(); ++i) {
    columns.points.push_back(axis.points[i]);
    columns.normals.push_back(axis.frames[i].normal);
    columns.tangents.push_back(axis.frames[i].tangent);
    columns.radius.push_back(axis.radius[i]);
    columns.abscissa.push_back(start_mm + axis.abscissa[i]);
    columns.curvature.push_back(bends.curvature[i]);
    columns.torsion.push_back(bends.torsion[i]);
  }
}

std::string polydata_of(const VesselTree& tree) {
  Columns columns;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkStringArray> names;
  names->SetName("VesselNames");
  std::vector<std::int32_t> ids;
  for (const Vessel& vessel : tree.vessels) {
    double start = 0.0;
    std::int32_t tract = 0;
    for (const std::int32_t id : vessel.segments) {
      const Centerline& axis = geometry::segment(tree, id).axis;
      lines->InsertNextCell(static_cast<int>(axis.size()));
      for (std::size_t i = 0; i < axis.size(); ++i)
        lines->InsertCellPoint(static_cast<vtkIdType>(columns.points.size() + i));
      append(columns, axis, start);
      start += axis.abscissa.back();
      columns.vessel.push_back(vessel.id);
      columns.group.push_back(id);
      columns.tract.push_back(tract++);
      columns.blanking.push_back(0);
    }
    names->InsertNextValue(vessel.name);
    ids.push_back(vessel.id);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk(columns.points));
  data->SetLines(lines);
  vtkPointData& points = *data->GetPointData();
  add_array(points, "MaximumInscribedSphereRadius", columns.radius);
  add_array(points, "Abscissas", columns.abscissa);
  add_array(points, "ParallelTransportNormals", columns.normals);
  add_array(points, "FrenetTangent", columns.tangents);
  add_array(points, "Curvature", columns.curvature);
  add_array(points, "Torsion", columns.torsion);
  vtkCellData& cells = *data->GetCellData();
  add_array(cells, "CenterlineIds", columns.vessel);
  add_array(cells, "GroupIds", columns.group);
  add_array(cells, "TractIds", columns.tract);
  add_array(cells, "Blanking", columns.blanking);
  vtkNew<vtkDataSetAttributes> holder;
  add_array(*holder, "VesselIds", ids);
  data->GetFieldData()->AddArray(holder->GetAbstractArray("VesselIds"));
  data->GetFieldData()->AddArray(names);
  return polydata_text(*data);
}

}  // namespace

VesselTree read_centerlines(const fs::path& path) {
  if (!fs::exists(path)) throw IoError("cannot read " + path.string() + ": there is no such file");
  if (fs::file_size(path) == 0) refuse(path, "the file is empty");
  const std::string extension = path.extension().string();
  if (extension == ".csv") return read_csv(path);
  if (extension == ".vtp" || extension == ".vtk") return read_polydata_lines(path);
  refuse(path, "centerlines end in .vtp, .vtk or .csv");
}

void write_centerlines(const fs::path& path, const VesselTree& tree) {
  const std::string extension = path.extension().string();
  if (extension == ".vtp") return core::write_file(path, polydata_of(tree));
  if (extension == ".csv") return core::write_file(path, csv_text(tree));
  throw InvalidInput("cannot write " + path.string() + ": centerlines are written as .vtp or .csv");
}

}  // namespace ostia::io
