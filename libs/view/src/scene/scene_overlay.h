#pragma once
/// \file What lies flat over the 3D picture: the cube with the patient's directions, the C-arm's angles, a
/// scale bar, the bar of a colour scale, a line that is being drawn.

#include "scene/scene_corner.h"

#include "ostia/figure/color.h"
#include "ostia/view/scene_camera.h"
#include "ostia/view/scene_marks.h"
#include "ostia/view/value_scale.h"

#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <vector>

class vtkActor2D;
class vtkPolyData;
class vtkRenderer;
class vtkTextActor;

namespace ostia::view {

struct OverlaySettings {
  bool marker_shown = true, scale_bar_shown = true, angles_shown = false;
  double pixel_ratio = 1.0;
  figure::Look look = figure::Look::dark;
  std::optional<ValueScale> color_bar;
  SceneFrame frame;
  std::vector<geometry::Vec2> lasso;  // px from the lower left corner; closed when it is shown
};

/// A round length (1, 2, 5 and their tens) that takes between a tenth and a quarter of the width.
double scale_bar_mm(double mm_per_px, int width_px);

/// Its props, laid out anew before each picture.
class SceneOverlay {
 public:
  explicit SceneOverlay(vtkRenderer& renderer);
  SceneCorner& corner() { return corner_; }
  /// Texts as they were laid out. The renderer is in a window, as for `lay_out`.
  std::vector<SceneText> texts() const;
  /// What no label may cover: texts, cube, bar and corner.
  std::vector<LabelRect> taken() const;
  void lay_out(const CameraPose& pose, int width_px, int height_px, const OverlaySettings& settings);

 private:
  struct Flat {
    vtkSmartPointer<vtkPolyData> shape;
    vtkSmartPointer<vtkActor2D> actor;
  };
  static Flat make_flat(vtkRenderer& renderer);
  vtkSmartPointer<vtkTextActor> make_text(vtkRenderer& renderer);
  void lay_out_marker(const CameraPose& pose, const OverlaySettings& settings);
  void lay_out_scale_bar(const CameraPose& pose, int width_px, int height_px,
                         const OverlaySettings& settings);
  void lay_out_angles(const CameraPose& pose, int height_px, const OverlaySettings& settings);
  void lay_out_lasso(const OverlaySettings& settings);
  void lay_out_frame(const CameraPose& pose, int width_px, int height_px, const OverlaySettings& settings);
  void lay_out_color_bar(int width_px, int height_px, const OverlaySettings& settings);
  /// Its middle, or its end at the right, moves inwards where the picture would cut it off; a text that is
  /// too long for it is written smaller.
  void keep_within(vtkTextActor& text, int width_px, double room_px);
  vtkRenderer& renderer_;
  SceneCorner corner_;
  int height_px_ = 0;
  std::vector<LabelRect> pictures_;  // cube and bar
  Flat cube_, ruler_, bar_, lasso_, frame_, grips_;
  std::array<vtkSmartPointer<vtkTextActor>, 6> letters_;
  vtkSmartPointer<vtkTextActor> ruler_text_, bar_title_, angles_;
  std::array<vtkSmartPointer<vtkTextActor>, 3> bar_texts_;
};

}  // namespace ostia::view
