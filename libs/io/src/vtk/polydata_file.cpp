#include "ostia/io/polydata_file.h"

#include "vtk/fields.h"
#include "vtk/xml.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

namespace ostia::io {
namespace {

void add_arrays(vtkDataSetAttributes& attributes, const PolydataArrays& arrays, std::size_t tuples,
                const std::string& where) {
  for (const auto& [name, values] : arrays.whole) {
    if (values.size() != tuples)
      throw InvalidInput("the array " + name + " has " + std::to_string(values.size()) + " values for " +
                         std::to_string(tuples) + " " + where);
    add_array(attributes, name.c_str(), values);
  }
  add_fields(attributes, arrays.numbers, tuples, tuples, where);
}

}  // namespace

void write_polydata(const std::filesystem::path& path, const Polydata& data) {
  vtkNew<vtkPolyData> out;
  out->SetPoints(to_vtk(data.points));
  vtkNew<vtkCellArray> cells;
  const auto points = static_cast<std::int32_t>(data.points.size());
  for (const std::vector<std::int32_t>& polygon : data.polygons) {
    cells->InsertNextCell(static_cast<int>(polygon.size()));
    for (const std::int32_t point : polygon) {
      if (point < 0 || point >= points)
        throw InvalidInput("a polygon names the point " + std::to_string(point) + " of " +
                           std::to_string(points));
      cells->InsertCellPoint(point);
    }
  }
  if (data.polygons.empty()) {
    for (std::int32_t i = 0; i < points; ++i) cells->InsertNextCell({static_cast<vtkIdType>(i)});
    out->SetVerts(cells);
  } else {
    out->SetPolys(cells);
  }
  add_arrays(*out->GetPointData(), data.at_points, data.points.size(), "points");
  const std::size_t count = data.polygons.empty() ? data.points.size() : data.polygons.size();
  add_arrays(*out->GetCellData(), data.at_cells, count, "cells");
  core::write_file(path, polydata_text(*out));
}

}  // namespace ostia::io
