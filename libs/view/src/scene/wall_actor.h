#pragma once
/// \file The wall of the tree as VTK draws it.

#include "ostia/figure/color.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/view/value_scale.h"
#include "ostia/view/wall_owner.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

class vtkActor;
class vtkCellArray;
class vtkFloatArray;
class vtkPolyData;
class vtkTypeInt32Array;
class vtkUnsignedCharArray;

namespace ostia::view {

/// Points, triangles and colours in VTK's arrays, which an update writes anew and never allocates for less
/// than they hold.
class WallActor {
 public:
  WallActor();
  ~WallActor();
  vtkActor* prop() const;
  /// Another actor over the same arrays, for a second window.
  vtkSmartPointer<vtkActor> twin() const;

  /// One unit normal a point.
  void set_points(const geometry::TriMesh& mesh, const std::vector<Eigen::Vector3f>& normals);
  /// The triangles that are visible.
  void set_triangles(const geometry::TriMesh& mesh, const std::function<bool(std::size_t triangle)>& visible);
  /// Of the triangles that are there, those that are wanted, by their corners.
  void keep_triangles(const std::function<bool(const geometry::Triangle& corners)>& wanted);
  /// One colour a point.
  void set_colors(std::size_t count, const std::function<figure::Color(std::size_t point)>& color_of);
  void set_opacity(double opacity);
  void set_hidden(bool hidden);  ///< whatever it holds
  void clear();

 private:
  void take_corners(vtkIdType triangles);
  bool hidden_ = false;

  vtkSmartPointer<vtkActor> actor_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkFloatArray> points_, normals_;
  vtkSmartPointer<vtkUnsignedCharArray> colors_;
  vtkSmartPointer<vtkTypeInt32Array> offsets_, corners_;
  vtkSmartPointer<vtkCellArray> cells_;
};

}  // namespace ostia::view
