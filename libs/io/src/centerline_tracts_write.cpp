// Writes centerlines split into tracts, with the arrays that VMTK's scripts read.

#include "centerline_tracts.h"

#include "ostia/geometry/line_geometry.h"
#include "ostia/geometry/polyline.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <set>

namespace ostia::io {
namespace {

using geometry::BranchedLine;
using geometry::LineGeometry;
using geometry::LinePlace;
using geometry::Tract;
using geometry::Vec3;
using geometry::VesselTree;

/// The arrays of all tracts of a file, one point after another.
struct TractColumns {
  std::vector<Vec3> points, transported, tangents, normals, binormals;
  std::vector<double> radius, abscissa, curvature, torsion;
  std::vector<std::int32_t> segment;
  std::vector<std::int32_t> vessel, group, tract, blanking;
  std::vector<double> length, tortuosity;
  std::vector<std::vector<double>> along;  ///< one for each AlongVessels
};

/// A direction between two points' directions.
Vec3 unit_at(const std::vector<Vec3>& directions, const LinePlace& place) {
  const Vec3 between = geometry::value_at(directions, place);
  return between.norm() > 1e-9 ? Vec3(between.normalized()) : directions[place.piece];
}

void add_tract_points(const BranchedLine& line, const LineGeometry& bends,
                      const std::vector<Vec3>& transported, const Tract& tract, TractColumns& columns) {
  for (const LinePlace& place : tract.places) {
    columns.points.push_back(geometry::value_at(line.axis.points, place));
    columns.radius.push_back(geometry::value_at(line.axis.radius, place));
    columns.abscissa.push_back(geometry::value_at(line.axis.abscissa, place));
    columns.transported.push_back(unit_at(transported, place));
    columns.tangents.push_back(unit_at(bends.tangent, place));
    columns.normals.push_back(unit_at(bends.normal, place));
    columns.binormals.push_back(unit_at(bends.binormal, place));
    columns.curvature.push_back(geometry::value_at(bends.curvature, place));
    columns.torsion.push_back(geometry::value_at(bends.torsion, place));
    columns.segment.push_back(place.t == 0.0 ? line.segments[place.piece] : -1);
  }
}

void add_branched_line(const BranchedLine& line, const std::vector<AlongVessels>& along, vtkCellArray& cells,
                       TractColumns& columns) {
  std::vector<Vec3> transported;
  for (const geometry::Frame& frame : line.axis.frames) transported.push_back(frame.normal);
  const LineGeometry bends = geometry::line_geometry(line.axis.points, transported);
  for (std::size_t t = 0; t < line.tracts.size(); ++t) {
    const Tract& tract = line.tracts[t];
    const auto first = static_cast<vtkIdType>(columns.points.size());
    cells.InsertNextCell(static_cast<int>(tract.places.size()));
    for (std::size_t i = 0; i < tract.places.size(); ++i)
      cells.InsertCellPoint(first + static_cast<vtkIdType>(i));
    add_tract_points(line, bends, transported, tract, columns);
    for (std::size_t k = 0; k < along.size(); ++k)
      for (std::size_t i = columns.along[k].size(); i < columns.abscissa.size(); ++i)
        columns.along[k].push_back(along[k].at(line.vessel, columns.abscissa[i]));
    const std::vector<Vec3> points(columns.points.begin() + first, columns.points.end());
    columns.length.push_back(geometry::length(points));
    columns.tortuosity.push_back(geometry::tortuosity(points));
    columns.vessel.push_back(line.vessel);
    columns.group.push_back(tract.group);
    columns.tract.push_back(static_cast<std::int32_t>(t));
    columns.blanking.push_back(tract.blanked ? 1 : 0);
  }
}

template <class Values>
void add_tree_field(vtkPolyData& data, const char* name, const Values& values) {
  vtkNew<vtkDataSetAttributes> holder;
  add_array(*holder, name, values);
  data.GetFieldData()->AddArray(holder->GetAbstractArray(name));
}

/// What the vessels' lines do not say: their names, and where each segment begins.
void add_tree_fields(const VesselTree& tree, vtkPolyData& data) {
  vtkNew<vtkStringArray> names;
  names->SetName("VesselNames");
  std::vector<std::int32_t> vessels, segments;
  std::vector<Vec3> starts;
  std::vector<double> radii;
  std::set<std::int32_t> written;
  for (const geometry::Vessel& vessel : tree.vessels) {
    vessels.push_back(vessel.id);
    names->InsertNextValue(vessel.name);
    for (const std::int32_t id : vessel.segments) {
      if (!written.insert(id).second) continue;
      const geometry::Centerline& axis = geometry::segment(tree, id).axis;
      segments.push_back(id);
      starts.push_back(axis.points.front());
      radii.push_back(axis.radius.front());
    }
  }
  add_tree_field(data, "VesselIds", vessels);
  data.GetFieldData()->AddArray(names);
  add_tree_field(data, "SegmentStartIds", segments);
  add_tree_field(data, "SegmentStartPoints", starts);
  add_tree_field(data, "SegmentStartRadii", radii);
}

}  // namespace

std::string tracts_text(const VesselTree& tree, const std::vector<AlongVessels>& along) {
  TractColumns columns;
  columns.along.resize(along.size());
  vtkNew<vtkCellArray> lines;
  for (const BranchedLine& line : geometry::branch_groups(tree).lines)
    add_branched_line(line, along, *lines, columns);
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk(columns.points));
  data->SetLines(lines);
  vtkPointData& points = *data->GetPointData();
  add_array(points, "MaximumInscribedSphereRadius", columns.radius);
  add_array(points, "Abscissas", columns.abscissa);
  add_array(points, "ParallelTransportNormals", columns.transported);
  add_array(points, "Curvature", columns.curvature);
  add_array(points, "Torsion", columns.torsion);
  add_array(points, "FrenetTangent", columns.tangents);
  add_array(points, "FrenetNormal", columns.normals);
  add_array(points, "FrenetBinormal", columns.binormals);
  add_array(points, "SegmentIds", columns.segment);
  for (std::size_t k = 0; k < along.size(); ++k) add_array(points, along[k].name.c_str(), columns.along[k]);
  vtkCellData& cells = *data->GetCellData();
  add_array(cells, "CenterlineIds", columns.vessel);
  add_array(cells, "TractIds", columns.tract);
  add_array(cells, "Blanking", columns.blanking);
  add_array(cells, "GroupIds", columns.group);
  add_array(cells, "Length", columns.length);
  add_array(cells, "Tortuosity", columns.tortuosity);
  add_tree_fields(tree, *data);
  return polydata_text(*data, Packing::none);
}

}  // namespace ostia::io
