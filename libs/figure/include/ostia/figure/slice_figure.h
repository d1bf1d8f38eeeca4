#pragma once
/// \file A slice of a CT image as a radiologist reads it, with rulers from which seed points can be read.

#include "ostia/figure/picture.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/reformat/plane_image.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::figure {

using geometry::Vec2;
using geometry::Vec3;

/// Lines in or near the plane, world mm (lumen sections, say); drawn projected onto the plane.
struct SliceContour {
  std::vector<std::vector<Vec3>> lines{};
  Color color = colors::contour;
  double width_px = 1.6;
  std::string label{};  ///< named in the legend unless empty
};

struct SlicePoint {
  Vec3 position = Vec3::Zero();  ///< world mm
  std::string label{};
  Color color = colors::centerline;
};

struct SliceFigureOptions {
  std::string title{};
  double level_hu = 250.0;  ///< shown mid-grey
  double window_hu =
      900.0;  ///< width of what is shown between black and white, > 0; 900/250 suits contrast-filled arteries
  int image_width_px = 560;  ///< of the image alone; its height follows, 16 to 16,000
  Look look = Look::dark;
  bool rulers = true;
  bool scale_bar = true;
  bool patient_letters = true;
  double point_distance_mm = 3.0;   ///< points farther from the plane are left out
  std::optional<Vec3> crosshair{};  ///< thin lines through this point's projection
  bool plane_name = true;           ///< "axial  z = 12.3 mm" in the corner; not for what is no plane of space
};

/// 0 (black) to 255 (white); NaN, outside the image, is 0.
std::uint8_t grey_level(double value_hu, double level_hu, double window_hu);
Raster grey_raster(const reformat::PlaneImage& image, double level_hu, double window_hu);

/// What a ruler along a picture axis says. Where the axis runs along a world axis (within 0.1 degree) its
/// ticks are LPS coordinates in mm ("x", "y" or "z"); elsewhere they are distances from the picture's centre.
struct Ruler {
  std::string label{};  ///< "x (mm)" or "mm from the centre"
  struct Tick {
    double position_px = 0.0;  ///< along the axis, in image pixels of the plane
    double value_mm = 0.0;
    bool major = true;
  };
  std::vector<Tick> ticks{};
};
Ruler horizontal_ruler(const reformat::Plane& plane, int about_ticks = 7);
Ruler vertical_ruler(const reformat::Plane& plane, int about_ticks = 7);

/// Throws InvalidInput for an invalid plane, options out of range, or values that do not fill the plane.
Picture slice_figure(const reformat::PlaneImage& image, const std::vector<SliceContour>& contours = {},
                     const std::vector<SlicePoint>& points = {}, const SliceFigureOptions& options = {});

/// Axial, coronal and sagittal slices through a point in one row, with the surface's sections and a
/// crosshair.
Picture three_planes(const imaging::ImageVolume& image, const Vec3& position,
                     const std::vector<geometry::TriMesh>& surfaces,
                     const std::vector<SlicePoint>& points = {}, const SliceFigureOptions& options = {});

}  // namespace ostia::figure
