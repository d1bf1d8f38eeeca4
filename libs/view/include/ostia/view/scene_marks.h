#pragma once
/// \file What stands in the 3D scene beside the wall: plain values.

#include "ostia/geometry/frame.h"
#include "ostia/geometry/vec.h"
#include "ostia/reformat/plane.h"
#include "ostia/view/label_layout.h"

#include <array>
#include <cstdint>
#include <optional>
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

/// A line of straight pieces.
struct SceneCurve {
  std::vector<Vec3> points;
  bool closed = false;
};

struct SceneMeasurement {
  std::int32_t id = 0;
  std::vector<Vec3> points;  ///< at least one; dots, and without `curves` joined by a line
  bool closed = false;       ///< that line
  std::string label;         ///< beside `label_at`; may be empty
  bool selected = false;
  std::vector<SceneCurve> curves{};  ///< its lines where they are not those from point to point
  bool dots = true;
  std::optional<Vec3> label_at{};  ///< nothing: whichever point is to the right
};
/// A frame over the picture, with squares that a hand can take hold of.
struct SceneFrame {
  std::vector<std::array<Vec3, 2>> lines;
  std::vector<Vec3> grips;
  int held = -1;  ///< which of them is held
};
/// A text of the picture as it was laid out last; px, y runs down.
struct SceneText {
  std::string text;
  LabelRect rect;
  std::vector<LabelLine> lines = {};  ///< of what it labels
};

/// The lines that are drawn of it.
std::vector<SceneCurve> curves_of(const SceneMeasurement& measurement);

}  // namespace ostia::view
