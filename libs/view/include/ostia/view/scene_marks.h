#pragma once
/// \file What stands in the 3D scene beside the wall: plain values.

#include "ostia/geometry/frame.h"
#include "ostia/geometry/vec.h"
#include "ostia/reformat/plane.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::view {

using geometry::Vec3;

/// The place that runs through all views.
struct SceneCursor {
  Vec3 place = Vec3::Zero();  ///< on the axis; a small ball
  geometry::Frame frame;      ///< across the vessel; the ring's plane
  double radius_mm = 3.0;     ///< of the ring; > 0
  double theta = 0.0;         ///< of the first CPR's plane; the second is at theta + 90 degrees
  bool plane_traces = false;  ///< where the two CPRs' planes cross the section
};

/// Pictures in space; one of each at a time.
enum class ScenePlane { cross_section, axial, coronal, sagittal, oblique };

/// A grey picture on its plane: `plane.width` x `plane.height` bytes, rows from the top.
struct ScenePlanePicture {
  reformat::Plane plane;
  std::vector<std::uint8_t> gray;
};

struct SceneMeasurement {
  std::int32_t id = 0;
  std::vector<Vec3> points;  ///< at least one
  bool closed = false;
  std::string label;  ///< beside the first point; may be empty
  bool selected = false;
};

}  // namespace ostia::view
