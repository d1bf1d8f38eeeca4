#pragma once
/// \file Cursor, measurements, axes and pictures in space as VTK draws them.

#include "scene_lines.h"

#include "ostia/figure/color.h"
#include "ostia/view/scene_camera.h"
#include "ostia/view/scene_marks.h"

#include <vtkSmartPointer.h>

#include <map>
#include <optional>
#include <vector>

class vtkProp;
class vtkRenderer;

namespace ostia::view {

/// What is to be seen; a second window takes a copy.
struct Marks {
  std::optional<SceneCursor> cursor;
  std::vector<SceneMeasurement> measurements;
  std::map<ScenePlane, ScenePlanePicture> planes;
  std::vector<SceneLine> axes;
  bool axes_shown = false;
  double pixel_ratio = 1.0;
  figure::Look look = figure::Look::dark;
};

/// Props in one renderer. Each `show_` replaces what it showed before.
class MarkActors {
 public:
  explicit MarkActors(vtkRenderer& renderer) : renderer_(renderer) {}
  void show_all(const Marks& marks);
  void show_cursor(const Marks& marks);
  void show_measurements(const Marks& marks);
  void show_plane(const Marks& marks, ScenePlane plane);
  void show_axes(const Marks& marks);
  /// Puts the labels beside their places; before each picture.
  void lay_out(const CameraPose& pose, int width_px, int height_px, double pixel_ratio);

 private:
  using Props = std::vector<vtkSmartPointer<vtkProp>>;
  struct Label {
    Vec3 at;
    vtkSmartPointer<vtkTextActor> actor;
  };
  void replace(Props& former, Props props);
  static void add_rimmed(Props& props, const SceneMeasurement& measurement, const figure::Color& color,
                         const figure::Color& rim, double thick_px);
  vtkRenderer& renderer_;
  Props cursor_, measurements_, axes_;
  std::map<ScenePlane, Props> planes_;
  std::vector<Label> labels_;
};

}  // namespace ostia::view
