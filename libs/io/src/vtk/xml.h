#pragma once
/// \file Between VTK's data sets and files, with the checks that VTK leaves out.

#include "ostia/geometry/tri_mesh.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

/// Reads a VTP (or, by its extension .vtk, a legacy polydata). Throws InvalidInput for anything but a sound
/// file: entities, sizes that the file cannot hold, what VTK's reader complains of, offsets and connectivity
/// out of range.
vtkSmartPointer<vtkPolyData> read_polydata(const std::filesystem::path& path);
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::filesystem::path& path);

/// How a file's arrays are packed. Coordinates along smooth lines shrink by a sixth, and that takes longer
/// than to write them as they are.
enum class Packing { deflate, none };
/// The file's content: XML with appended data. Axes and unit are added as field data.
std::string polydata_text(vtkPolyData& data, Packing packing = Packing::deflate);
std::string grid_text(vtkUnstructuredGrid& data);

vtkSmartPointer<vtkPoints> to_vtk(const std::vector<geometry::Vec3>& points);
std::vector<geometry::Vec3> from_vtk(vtkPoints* points);
void add_array(vtkDataSetAttributes& attributes, const char* name, const std::vector<std::int32_t>& values);
void add_array(vtkDataSetAttributes& attributes, const char* name, const std::vector<double>& values);
void add_array(vtkDataSetAttributes& attributes, const char* name, const std::vector<geometry::Vec3>& values);
void add_faces(vtkDataObject& data, const std::vector<geometry::Face>& faces);
/// Faces of field data; those of `ids` that are not named there get "wall" (1) or "face_<id>". Names in an
/// array FaceNames without FaceIds beside it belong to the labels in their order, or to labels 1, 2, ...;
/// where neither fits, `warnings` gets why.
std::vector<geometry::Face> faces_of(vtkDataObject& data, const std::vector<std::int32_t>& ids,
                                     std::vector<std::string>* warnings = nullptr);

/// Polygons as fans and strips as their triangles, with VTK's cell of each.
struct PolydataTriangles {
  std::vector<geometry::Triangle> triangles;
  std::vector<vtkIdType> cells;  ///< as cell data count them: vertices, lines, polygons, strips
  std::size_t polygons = 0;      ///< of more than three corners
};
/// `data` is checked already (read_polydata). Throws InvalidInput for a polygon or strip of fewer than three
/// corners.
PolydataTriangles triangles_of(vtkPolyData& data, const std::filesystem::path& path);

/// Whether a legacy VTK file holds polygons or triangle strips; false where there is no file. Throws IoError.
bool legacy_has_polygons(const std::filesystem::path& path);

}  // namespace ostia::io
