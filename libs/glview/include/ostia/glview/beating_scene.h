#pragma once
/// \file A vessel tree that beats on the graphics card: OpenGL 3.3. See docs/reference/live.md.

#include "ostia/figure/picture.h"
#include "ostia/glview/carm_camera.h"
#include "ostia/glview/shown_surface.h"
#include "ostia/glview/surface_values.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace ostia::glview {

/// A part of the window, px from its lower left corner.
struct Viewport {
  int x = 0, y = 0, width = 1, height = 1;
  double aspect() const { return static_cast<double>(width) / height; }
};

/// Behind the lit tree.
inline constexpr figure::Color scene_backdrop{0.07, 0.08, 0.09, 1.0};

struct SceneLook {
  SurfaceValue value = SurfaceValue::none;
  ValueRange range{};
  bool shaded = true;               ///< else every colour is exactly the bar's
  double absorption_per_mm = 0.35;  ///< of the contrast agent, in `x_ray`
};

/// The OpenGL context in which it is made must be current whenever it is used, and when it ends. Drawing
/// leaves the framebuffer that was bound bound.
class BeatingScene {
 public:
  /// Throws InvalidInput (MovingCage), ResourceError or NumericalError with what the driver says.
  BeatingScene(const ShownSurface& surface, const motion::MovingCage& cage);
  ~BeatingScene();
  BeatingScene(const BeatingScene&) = delete;
  BeatingScene& operator=(const BeatingScene&) = delete;

  /// For SurfaceValue::stretch and ::bending, which are not shown without. A surface that has its directions
  /// brings them. Throws InvalidInput for those of another surface.
  void set_directions(const std::vector<Direction>& along);
  /// For SurfaceValue::bending, which is not shown without. Throws InvalidInput for another surface's.
  void set_bending(const BendingTable& table);
  /// The heart's phase for the pictures from now on; velocities are those of cycles of `interval_s`.
  void set_phase(double phase, double interval_s = 1.0);
  /// Fills the viewport. The lit tree fills all of the framebuffer with its backdrop first: what stands
  /// beside the viewport is drawn afterwards.
  void draw(const Camera& camera, const SceneLook& look, const Viewport& viewport);
  // What the card makes of the vertices now. Slow: for tests.
  std::vector<Eigen::Vector3f> places();   ///< mm
  std::vector<Eigen::Vector3f> normals();  ///< unit
  /// As shares of the look's range.
  std::vector<float> values(const SceneLook& look);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// True where the current context can draw the scene: OpenGL 3.3 or more.
bool has_opengl_33();
/// What draws: "llvmpipe (LLVM 15.0.6, 256 bits)".
std::string renderer_name();
/// One colour over a part of the bound framebuffer: the cheapest background.
void fill(const Viewport& viewport, const figure::Color& color);
/// The same, with nothing in its depths; it is where TreeDrawing draws next.
void begin_part(const Viewport& viewport, const figure::Color& color);
/// What stands in the bound framebuffer.
figure::Raster read_pixels(int width, int height);

}  // namespace ostia::glview
