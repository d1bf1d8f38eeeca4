#pragma once
/// \file Cursor, measurements, axes and pictures in space as VTK draws them.

#include "scene/scene_lines.h"

#include "ostia/figure/color.h"
#include "ostia/view/label_layout.h"
#include "ostia/view/scene_camera.h"
#include "ostia/view/scene_marks.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

class vtkPolyData;
class vtkProp;
class vtkRenderer;

namespace ostia::view {

/// What is to be seen; a second window takes a copy.
struct Marks {
  std::optional<SceneCursor> cursor;
  std::vector<SceneMeasurement> measurements;
  std::optional<SceneMeasurement> draft;
  std::map<ScenePlane, ScenePlanePicture> planes;
  std::vector<SceneLine> axes;
  bool axes_shown = false;
  double pixel_ratio = 1.0;
  figure::Look look = figure::Look::dark;
};

/// Props in one renderer. Each `show_` replaces what it showed before.
class MarkActors {
 public:
  explicit MarkActors(vtkRenderer& renderer);
  void show_all(const Marks& marks);
  void show_cursor(const Marks& marks);
  void show_measurements(const Marks& marks);
  void show_draft(const Marks& marks);
  void show_plane(const Marks& marks, ScenePlane plane);
  void show_axes(const Marks& marks);
  /// Puts the labels beside their places, within the picture and none over another; before each picture.
  /// The renderer is in a window. `taken`: what they keep off.
  void lay_out(const CameraPose& pose, int width_px, int height_px, double pixel_ratio,
               std::vector<LabelRect> taken);
  /// Labels as they were laid out.
  const std::vector<SceneText>& texts() const { return texts_; }

 private:
  using Props = std::vector<vtkSmartPointer<vtkProp>>;
  struct Label {
    std::vector<Vec3> places;  // it stands beside the one that is farthest to the right
    vtkSmartPointer<vtkTextActor> actor;
    std::vector<SceneCurve> curves;  // it keeps off these
    std::int32_t id = 0;             // of the measurement
    figure::Color color{};           // of a leader
  };
  void replace(Props& former, Props props);
  void add_measurement(Props& props, std::vector<Label>& labels, const SceneMeasurement& measurement,
                       const Marks& marks, bool chosen);
  vtkRenderer& renderer_;
  Props cursor_, measurements_, draft_, axes_;
  std::map<ScenePlane, Props> planes_;
  std::vector<LabelLine> lines_of(const Label& label, const CameraPose& pose, int width_px,
                                  int height_px) const;
  std::vector<Label> labels_, draft_labels_;
  std::vector<SceneText> texts_;
  std::map<std::int32_t, geometry::Vec2> offsets_;  // of labels from their anchors, as they were
  vtkSmartPointer<vtkPolyData> leaders_;            // px
};

}  // namespace ostia::view
