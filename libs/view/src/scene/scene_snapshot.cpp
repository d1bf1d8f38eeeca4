// A picture of the scene from a window that is never shown.
#include "scene/tree_scene_impl.h"

#include "ostia/core/error.h"
#include "ostia/view/opengl_check.h"

#include <vtkActor.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>

#include <algorithm>
#include <chrono>
#include <string>

namespace ostia::view {
namespace {

void check(int width_px, int height_px) {
  if (std::min(width_px, height_px) < 16 || std::max(width_px, height_px) > 8192)
    throw InvalidInput("a picture of " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                       " pixels cannot be made; it takes 16 to 8192 along each side");
  static const std::optional<OpenGlTrouble> fault = check_opengl();
  if (fault) throw ResourceError("no picture of the 3D scene can be made. " + fault->text());
}

/// Renders, and again as long as a finer volume is to be had in time.
void render_refined(vtkRenderWindow& window, VolumeScene& volume, double patience_ms) {
  for (;;) {
    const auto start = std::chrono::steady_clock::now();
    window.Render();
    if (!volume.has_image() || volume.mode() == VolumeMode::off) return;
    window.WaitForCompletion();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    const VolumeQuality now = volume.quality();
    if (now == VolumeQuality::full || took.count() * next_level_cost(now) > patience_ms) return;
    volume.set_quality(finer(now));
  }
}

figure::Raster pixels_of(vtkRenderWindow& window, int width, int height) {
  vtkNew<vtkUnsignedCharArray> bytes;
  window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, bytes);
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  if (bytes->GetNumberOfValues() != static_cast<vtkIdType>(row * static_cast<std::size_t>(height)))
    throw ResourceError("the picture of the 3D scene could not be read back from the graphics driver");
  figure::Raster picture{width, height, {}};
  picture.rgba.resize(row * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    std::copy_n(bytes->GetPointer(static_cast<vtkIdType>(row) * (height - 1 - y)), row,
                picture.rgba.begin() + static_cast<std::ptrdiff_t>(row) * y);
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
  return picture;
}

}  // namespace

figure::Raster TreeScene::snapshot(int width_px, int height_px, std::optional<figure::Look> look,
                                   double patience_ms) const {
  check(width_px, height_px);
  vtkNew<vtkRenderer> renderer;
  Marks marks = impl_->marks;
  OverlaySettings settings = impl_->shown_settings();
  marks.look = settings.look = look.value_or(settings.look);
  settings.lasso.clear();
  settings.frame = {};
  add_lights(*renderer);
  apply_look(*renderer, settings.look);
  apply_pose(*renderer, pose());
  if (impl_->guest) {
    renderer->AddViewProp(impl_->guest->twin());
  } else {
    renderer->AddViewProp(impl_->wall_actor.twin());
    renderer->AddViewProp(impl_->other_actor.twin());
    renderer->AddViewProp(impl_->moving_actor.twin());
  }
  VolumeScene volume;
  volume.copy_from(impl_->volume);
  renderer->AddViewProp(volume.prop());
  MarkActors mark_actors(*renderer);
  mark_actors.show_all(marks);
  SceneOverlay overlay(*renderer);
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetShowWindow(false);
  window->SetOffScreenRendering(1);
  window->SetSize(width_px, height_px);
  window->AddRenderer(renderer);
  overlay.lay_out(pose(), width_px, height_px, settings);  // the corner stays empty
  mark_actors.lay_out(pose(), width_px, height_px, settings.pixel_ratio, overlay.taken());
  renderer->ResetCameraClippingRange();
  render_refined(*window, volume, patience_ms);
  figure::Raster picture = pixels_of(*window, width_px, height_px);
  window->RemoveRenderer(renderer);
  return picture;
}

}  // namespace ostia::view
