#pragma once
/// \file Vessel-like shapes whose axis, radius, distance, area and volume are known exactly. For tests,
/// benchmarks and the built-in case.

#include "ostia/geometry/centerline.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::geometry {

/// A tube around an axis: the union of the balls of radius r(s) about c(s). Axis and radius are densely
/// sampled from exact formulas; between samples both are linear (a chain of cone-spheres), so `tube_distance`
/// is exact for what is described.
struct AnalyticTube {
  std::string name;
  Centerline axis;  ///< with exact points and radii
};

/// One or more tubes joined (a Y, a coronary-like tree).
struct AnalyticShape {
  std::vector<AnalyticTube> tubes;
  Box3 box;  ///< around everything, 2 mm to spare
};

AnalyticShape straight_tube(double length_mm, double radius_mm, double step_mm = 0.1);  ///< along +z from 0
AnalyticShape tapered_tube(double length_mm, double radius_start_mm, double radius_end_mm,
                           double step_mm = 0.1);
AnalyticShape helix_tube(double helix_radius_mm, double pitch_mm, double turns, double radius_mm,
                         double step_mm = 0.1);
AnalyticShape torus(double ring_radius_mm, double radius_mm,
                    double step_mm = 0.05);  ///< closed axis in the xy plane
/// Radius r0 but for a cosine-shaped narrowing: r(s) = r0 (1 - severity/2 (1 + cos(2 pi (s -
/// centre)/length))) within it.
AnalyticShape stenosed_tube(double length_mm, double radius_mm, double severity, double centre_mm,
                            double stenosis_length_mm, double step_mm = 0.1);
/// A parent along +z that ends at the origin, where two children begin along +z and bend away on arcs in the
/// xz plane until they make `angle_deg` between them; straight from there.
AnalyticShape y_junction(double parent_length_mm, double child_length_mm, double parent_radius_mm,
                         double child_radius_mm, double angle_deg, double step_mm = 0.1);
/// A coronary-like tree: a root and three side branches (five ends in all), gently curved (curvature radius
/// 15 mm or more) and tapering 2.0 -> 0.8 mm, about 195 mm in all. Side branches begin on the parent's axis
/// along it and bend away by 48 to 62 degrees.
AnalyticShape coronary_like_tree(double step_mm = 0.1);

/// Exact signed distance-like function: min over tubes of min over s of |p - c(s)| - r(s); negative inside.
/// (The power-like distance of cone-spheres: exact on the surface.)
class TubeDistance {
 public:
  explicit TubeDistance(const AnalyticShape& shape);
  double operator()(const Vec3& point) const;
  /// Where on which tube the minimum is attained. (point - axis_point) is along the gradient, which has unit
  /// length.
  struct Nearest {
    std::size_t tube;
    double abscissa;
    double radius;
    Vec3 axis_point;
    double distance;
  };
  Nearest nearest(const Vec3& point) const;

 private:
  struct Piece {
    Vec3 a, b;
    double ra, rb, sa, sb;
    std::size_t tube;
  };
  std::vector<Piece> pieces_;
  struct Node {
    Box3 box;
    double radius;
    std::int32_t left, right, first, last;
  };  // box of the axis, largest radius in it
  std::int32_t build(std::int32_t first, std::int32_t last);
  Nearest nearest_on(const Piece& piece, const Vec3& point) const;
  std::vector<Node> nodes_;
};

/// A surface whose vertices lie on the shape to 1e-9 mm: marching cubes at `spacing_mm` with each vertex at
/// the exact root on its grid edge, or beside it on the surface where that root is next to a grid node. With
/// `open_ends` each tube's free ends (not inside another tube, not closed) are cut flat by the plane through
/// the axis' end point normal to it; the holes' borders lie on that plane and on the surface. Throws
/// InvalidInput for a spacing that is not positive. See docs/methods/isosurface.md.
TriMesh surface_of(const AnalyticShape& shape, double spacing_mm, bool open_ends);
/// The same by marching cubes alone (vertices by linear interpolation): the raw surface with needle triangles
/// that real data give.
TriMesh raw_surface_of(const AnalyticShape& shape, double spacing_mm, bool open_ends);
/// A structured tube surface, `around` vertices a ring, exact vertices, rings no farther apart than
/// `step_mm`; open and flat at both ends, closed where the axis is. For tubes that stand alone.
TriMesh structured_surface(const AnalyticTube& tube, int around, double step_mm);

}  // namespace ostia::geometry
