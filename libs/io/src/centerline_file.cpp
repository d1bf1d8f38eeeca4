#include "ostia/io/centerline_file.h"

#include "centerline_csv.h"
#include "centerline_tracts.h"
#include "line_tree.h"
#include "surface_formats.h"
#include "vtk/xml.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/markups_file.h"
#include "ostia/io/rotterdam_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>

#include <cmath>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::Vec3;
using geometry::VesselTree;

VesselTree read_polydata_lines(const fs::path& path) {
  const vtkSmartPointer<vtkPolyData> data = read_polydata(path);
  if (has_tracts(*data)) return tree_of_groups(lines_of_tracts(*data, path), vessel_names(*data));
  if (data->GetCellData()->GetArray("RadiusFrom") && !data->GetCellData()->GetArray("GroupIds"))
    return tree_of_network(read_graph(path).graph, path);  // its points have no radius of their own
  vtkDataArray* radius = radius_array(*data);
  if (!radius) refuse(path, "its points have no array MaximumInscribedSphereRadius (or Radius)");
  vtkDataArray* group = data->GetCellData()->GetArray("GroupIds");
  vtkDataArray* vessel = data->GetCellData()->GetArray("CenterlineIds");
  std::vector<FileLine> lines;
  const vtkIdType first = data->GetNumberOfVerts();
  for (vtkIdType c = 0; c < data->GetLines()->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data->GetLines()->GetCellAtId(c, count, ids);
    FileLine line;
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
  return group ? tree_of_groups(lines, vessel_names(*data)) : tree_of_lines(lines, vessel_names(*data));
}

/// One line of x y z r, with the observers' spread or without.
VesselTree read_rotterdam_tree(const fs::path& path) {
  const RotterdamReference line = without_repeated(read_rotterdam_axis(path));
  if (line.radius.empty()) refuse(path, "its points have no radius: x y z r are expected");
  return tree_of_lines({{line.points, line.radius, 0, 0}},
                       {{0, "vessel"}});  // a file's name may be a person's
}

}  // namespace

VesselTree read_centerlines(const fs::path& path) {
  if (!fs::exists(path)) throw IoError("cannot read " + path.string() + ": there is no such file");
  if (fs::file_size(path) == 0) refuse(path, "the file is empty");
  const std::string extension = path.extension().string();
  if (is_markups_file(path)) {
    const MarkupsFile file = read_markups(path);
    for (const std::string& warning : file.warnings)
      core::log_warning(path.filename().string() + ": " + warning);
    return tree_of(file.markups, "cannot read " + path.string());
  }
  if (extension == ".csv" && is_table_of_lines(path)) return read_centerline_table(path);
  if (extension == ".vtp" || extension == ".vtk") return read_polydata_lines(path);
  if (extension == ".txt" && is_rotterdam_line(path)) return read_rotterdam_tree(path);
  if (is_graph_file(path)) return tree_of_network(read_graph(path).graph, path);
  refuse(path,
         "centerlines end in .vtp, .vtk, .csv, .mrk.json or .txt (x y z r), trees also in .swc or .gxl");
}

std::optional<geometry::BranchedLines> read_branched_lines(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".vtp" && extension != ".vtk") return std::nullopt;
  const vtkSmartPointer<vtkPolyData> data = read_polydata(path);
  if (!has_tracts(*data)) return std::nullopt;
  return branched_lines_of(*data, path);
}

void write_centerlines(const fs::path& path, const VesselTree& tree, const std::vector<AlongVessels>& along) {
  const std::string extension = path.extension().string();
  if (extension == ".vtp") return core::write_file(path, tracts_text(tree, along));
  if (extension == ".csv") return core::write_file(path, centerline_table_text(tree, along));
  if (is_markups_file(path) && extension != ".fcsv") return write_markups(path, curves_of(tree));
  throw InvalidInput("cannot write " + path.string() +
                     ": centerlines are written as .vtp, .csv or .mrk.json");
}

}  // namespace ostia::io
