#pragma once
/// \file The shape of one flow extension: rings of points from a section to a circle.

#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/frame.h"
#include "ostia/geometry/vec.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::meshing {

/// The end's section as the extension sees it.
struct Section {
  std::string name;                  ///< of the end, for messages
  std::vector<geometry::Vec3> loop;  ///< counter-clockwise seen against the axis, all in one plane
  geometry::Vec3 centre = geometry::Vec3::Zero();  ///< of its area
  geometry::Frame frame;                           ///< tangent: where the axis goes, out of the lumen
  double radius = 0.0;  ///< of the circle whose polygon of loop.size() corners has the wanted area
  double ahead = 0.0, behind = 0.0;  ///< how far the loop reaches along the axis, both >= 0
};
/// `area`: what the far end's polygon is to hold; `normal`: of the section, out of the lumen.
Section section_of(const std::string& name, const std::vector<geometry::Vec3>& loop,
                   const geometry::Vec3& direction, double area);

/// Area vector's half length, and the centre of area, of a flat polygon.
double polygon_area(const std::vector<geometry::Vec3>& loop);
geometry::Vec3 polygon_centre(const std::vector<geometry::Vec3>& loop);

/// The axis of an extension by its own abscissa: straight, or straight past the section and then a curve.
class ExtensionAxis {
 public:
  /// Straight from the section's centre.
  explicit ExtensionAxis(const Section& section);
  /// An arc that turns by `angle` (radians) towards the unit vector `side` up to the abscissa `length`.
  ExtensionAxis(const Section& section, double length, double angle, const geometry::Vec3& side);
  /// Through the points given.
  ExtensionAxis(const Section& section, const std::vector<geometry::Vec3>& through);
  geometry::Vec3 point(double s) const;
  geometry::Frame frame(double s) const;
  double length() const;                      ///< of a curve; infinite when straight
  double tightest_bend(double length) const;  ///< least radius of curvature, mm; infinite when straight

 private:
  void set_curve(std::vector<geometry::Vec3> points);
  geometry::Vec3 centre_;
  geometry::Frame frame_;
  std::optional<geometry::AxisCurve> curve_;
};

struct Rings {
  std::vector<double> abscissa;                    ///< of each ring after the section
  std::vector<std::vector<geometry::Vec3>> rings;  ///< as many points each as the section has
  std::vector<geometry::Vec3> centres;
};

/// A cylinder whose beginning is warped by a thin-plate spline that brings its first circle onto the section
/// and leaves it alone from `transition` on; every second ring is turned by half a step.
Rings extension_rings(const Section& section, const ExtensionAxis& axis, double length, double transition);

}  // namespace ostia::meshing
