#pragma once
/// \file Flat triangles and quadrilaterals, each in its own colour.

#include "scene/scene_lines.h"

#include "ostia/figure/color.h"
#include "ostia/geometry/vec.h"

#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <span>

class vtkActor;
class vtkPolyData;
class vtkProp;
class vtkPropAssembly;

namespace ostia::view {

/// A surface and lines that are seen through it, as one prop.
class FlatGuest {
 public:
  FlatGuest();
  ~FlatGuest();
  const vtkSmartPointer<vtkPolyData> sides;
  const vtkSmartPointer<vtkActor> surface;  // of `sides`; unseen at first
  void set_lines(std::span<const SceneLine> lines, double width_px);
  vtkProp& prop();
  vtkSmartPointer<vtkProp> twin() const;

 private:
  vtkSmartPointer<vtkActor> lines_;
  vtkSmartPointer<vtkPropAssembly> all_;
};

void set_flat_points(vtkPolyData& surface, std::span<const geometry::Vec3> points);
/// The fourth corner of a triangle is -1.
void set_flat_sides(vtkPolyData& surface, std::span<const std::array<std::int32_t, 4>> sides);
void set_flat_colors(vtkPolyData& surface, std::span<const figure::Color> colors);  ///< one a side

}  // namespace ostia::view
