#include "scene/still_renderer.h"

#include <vtkCamera.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtk_glew.h>

#include <algorithm>
#include <string>

namespace ostia::view {

StillRenderer* StillRenderer::New() {
  auto* made = new StillRenderer;
  made->InitializeObjectBase();
  return made;
}

StillRenderer::Look StillRenderer::look() {
  Look now;
  now.changed = std::max(GetMTime(), GetActiveCamera()->GetMTime());
  vtkCollectionSimpleIterator at;
  vtkPropCollection* props = GetViewProps();
  props->InitTraversal(at);
  while (vtkProp* prop = props->GetNextProp(at)) {
    now.changed = std::max({now.changed, prop->GetMTime(), prop->GetRedrawMTime()});
    ++now.props;
  }
  const int* size = GetRenderWindow()->GetSize();
  now.size = {size[0], size[1]};
  now.window = GetRenderWindow();
  return now;
}

/// Depths of several samples a pixel cannot be copied into those of one.
bool StillRenderer::can_keep() {
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(GetRenderWindow());
  return window != nullptr && window->GetMultiSamples() == 0 && window->GetRenderFramebuffer() != nullptr;
}

void StillRenderer::copy(vtkOpenGLFramebufferObject& from, vtkOpenGLFramebufferObject& to) {
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(GetRenderWindow());
  const int* size = window->GetSize();
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  from.Bind(GL_READ_FRAMEBUFFER);
  from.ActivateReadBuffer(0);
  to.Bind(GL_DRAW_FRAMEBUFFER);
  to.ActivateDrawBuffer(0);
  state->vtkglViewport(0, 0, size[0], size[1]);
  state->vtkglScissor(0, 0, size[0], size[1]);
  state->vtkglBlitFramebuffer(0, 0, size[0], size[1], 0, 0, size[0], size[1],
                              GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  state->PopFramebufferBindings();
}

void StillRenderer::DeviceRender() {
  if (!in_software_) {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string renderer = name != nullptr ? name : "llvmpipe";
    in_software_ = false;
    for (const char* one : {"llvmpipe", "softpipe", "SWR", "Software"})
      if (renderer.find(one) != std::string::npos) in_software_ = true;
  }
  const bool keeps = can_keep();
  const Look now = look();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(GetRenderWindow());
  put_back_ = keeps && now == kept_of_;
  if (put_back_) {
    copy(*kept_, *window->GetRenderFramebuffer());
    return;
  }
  vtkOpenGLRenderer::DeviceRender();
  kept_of_ = {};
  if (!keeps) return;
  if (!make_room(now.size)) return;
  copy(*window->GetRenderFramebuffer(), *kept_);
  if (glGetError() == GL_NO_ERROR) kept_of_ = look();  // drawing itself may have touched what is drawn
}

bool StillRenderer::make_room(const std::array<int, 2>& size) {
  if (room_ == size) return true;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  kept_->SetContext(window);
  // The same formats as those of the window (with depths of 32 bits), or depths could not be copied; then
  // nothing is kept.
  const bool made = kept_->PopulateFramebuffer(size[0], size[1], true, 1, VTK_UNSIGNED_CHAR, true, 32, 0,
                                               window->GetStencilCapable() != 0);
  state->PopFramebufferBindings();
  room_ = made ? size : std::array<int, 2>{0, 0};
  return made;
}

void StillRenderer::ReleaseGraphicsResources(vtkWindow* window) {
  kept_->ReleaseGraphicsResources(window);
  kept_of_ = {};
  room_ = {0, 0};
  vtkOpenGLRenderer::ReleaseGraphicsResources(window);
}

}  // namespace ostia::view
