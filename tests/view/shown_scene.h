#pragma once
/// \file A 3D scene in a window that is never shown, and trees of known place in it.

#include "vessel_trees.h"

#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/view/tree_scene.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

namespace ostia::view::testing {

struct Pixel {
  int r = 0, g = 0, b = 0;
  int brightness() const { return r + g + b; }
  int difference(const Pixel& other) const {
    return std::abs(r - other.r) + std::abs(g - other.g) + std::abs(b - other.b);
  }
};

/// Pixels from the lower left corner, as display coordinates count them.
struct Shot {
  int width = 0, height = 0;
  std::vector<Pixel> pixels;
  Pixel at(const geometry::Vec2& display) const {
    return pixels[static_cast<std::size_t>(display.y()) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(display.x())];
  }
  Pixel background() const {
    return pixels[static_cast<std::size_t>(width) * static_cast<std::size_t>(height) - 1];
  }
  /// How many pixels are not the background's colour.
  int painted() const {
    int count = 0;
    for (const Pixel& pixel : pixels) count += pixel.difference(background()) > 12 ? 1 : 0;
    return count;
  }
};

/// 400 x 300 pixels, nothing but what is asked for.
struct ShownScene {
  TreeScene scene;
  vtkNew<vtkRenderWindow> window;
  ShownScene() {
    window->SetMultiSamples(0);
    window->SetOffScreenRendering(1);
    window->SetSize(400, 300);
    scene.attach(*window);
    scene.set_marker_shown(false);
    scene.set_scale_bar_shown(false);
  }
  Shot shoot() {
    window->Render();
    vtkNew<vtkUnsignedCharArray> bytes;
    window->GetRGBACharPixelData(0, 0, 399, 299, 0, bytes);
    Shot shot{400, 300, {}};
    for (vtkIdType i = 0; i < bytes->GetNumberOfValues(); i += 4)
      shot.pixels.push_back({bytes->GetValue(i), bytes->GetValue(i + 1), bytes->GetValue(i + 2)});
    return shot;
  }
};

struct Tree {
  lumen::LumenModel model;
  std::shared_ptr<const geometry::TriMesh> wall;
};

/// A straight vessel (id 4) of radius 2 mm, from the origin 40 mm along +z.
inline Tree straight_tree() {
  Tree tree;
  tree.model = lumen::model_of_tubes(lumen::testing::straight_vessel(40.0, 2.0));
  tree.wall = std::make_shared<const geometry::TriMesh>(lumen::surface_of(tree.model, 0.25));
  return tree;
}

/// A parent along +z that ends at the origin, and two children of 30 mm that part in the xz plane.
inline Tree y_tree() {
  Tree tree;
  tree.model =
      lumen::model_of_tubes(lumen::testing::tree_of(geometry::y_junction(20.0, 30.0, 2.0, 1.5, 80.0)));
  tree.wall = std::make_shared<const geometry::TriMesh>(lumen::surface_of(tree.model, 0.25));
  return tree;
}

}  // namespace ostia::view::testing
