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
  if (!data.polygons.empty() && !data.lines.empty())
    throw InvalidInput("polygons and lines do not go into one file: cells have one order");
  const auto& given = data.lines.empty() ? data.polygons : data.lines;
  vtkNew<vtkPolyData> out;
  out->SetPoints(to_vtk(data.points));
  vtkNew<vtkCellArray> cells;
  const auto points = static_cast<std::int32_t>(data.points.size());
  for (const std::vector<std::int32_t>& cell : given) {
    cells->InsertNextCell(static_cast<int>(cell.size()));
    for (const std::int32_t point : cell) {
      if (point < 0 || point >= points)
        throw InvalidInput("a polygon or line names the point " + std::to_string(point) + " of " +
                           std::to_string(points));
      cells->InsertCellPoint(point);
    }
  }
  if (given.empty()) {
    for (std::int32_t i = 0; i < points; ++i) cells->InsertNextCell({static_cast<vtkIdType>(i)});
    out->SetVerts(cells);
  } else if (data.lines.empty()) {
    out->SetPolys(cells);
  } else {
    out->SetLines(cells);
  }
  add_arrays(*out->GetPointData(), data.at_points, data.points.size(), "points");
  const std::size_t count = given.empty() ? data.points.size() : given.size();
  add_arrays(*out->GetCellData(), data.at_cells, count, "cells");
  core::write_file(path, polydata_text(*out));
}

}  // namespace ostia::io
