#pragma once
/// \file A small picture at the lower left of the 3D view, and how much room its texts take.

#include "ostia/figure/picture.h"
#include "ostia/view/scene_marks.h"

#include <vtkSmartPointer.h>

#include <optional>
#include <string>

class vtkRenderer;
class vtkTextActor;
class vtkTexturedActor2D;

namespace ostia::view {

/// Where a text is in a picture of that height, px; nothing where it is not shown. The renderer is in a
/// window.
std::optional<LabelRect> rect_of(vtkTextActor& text, vtkRenderer& renderer, int height_px);

class SceneCorner {
 public:
  explicit SceneCorner(vtkRenderer& renderer);
  /// An empty picture: nothing. `text`: what is written in it.
  void show(const figure::Raster& picture, std::string text);
  /// Its lower left corner, px from the picture's. Before each picture.
  void lay_out(int left, int low, int height_px);
  const std::string& text() const { return text_; }
  const std::optional<LabelRect>& rect() const { return rect_; }  ///< as it was laid out

 private:
  vtkSmartPointer<vtkTexturedActor2D> actor_;
  int width_ = 0, height_ = 0;
  std::string text_;
  std::optional<LabelRect> rect_;
};

}  // namespace ostia::view
