#pragma once
/// \file Lines, points and texts for the 3D scene.

#include "ostia/figure/color.h"
#include "ostia/geometry/vec.h"

#include <vtkSmartPointer.h>

#include <span>
#include <string>
#include <vector>

class vtkActor;
class vtkPolyDataMapper;
class vtkTextActor;
class vtkTextProperty;

namespace ostia::view {

/// A polyline, by straight pieces.
struct SceneLine {
  std::vector<geometry::Vec3> points;
  bool closed = false;
  figure::Color color;
};

vtkSmartPointer<vtkActor> line_actor(std::span<const SceneLine> lines, double width_px);
/// Round dots, `size_px` wide on the screen.
vtkSmartPointer<vtkActor> point_actor(std::span<const geometry::Vec3> points, const figure::Color& color,
                                      double size_px);
/// Drawn over all that was drawn before, whatever lies nearer.
void draw_over_all(vtkActor& actor);
/// A text on a plate, to be put at its display position: its lower left corner.
vtkSmartPointer<vtkTextActor> label_actor(const std::string& text, const figure::Color& color,
                                          const figure::Color& plate, double size_px);
void set_font(vtkTextProperty& text, const figure::Color& color, double size_px);
/// The circle across a frame, or any closed curve of so many points.
std::vector<geometry::Vec3> circle(const geometry::Vec3& centre, const geometry::Vec3& u,
                                   const geometry::Vec3& v, double radius_mm, int count = 64);

}  // namespace ostia::view
