#pragma once
/// \file A renderer that draws its props anew only when they look different.

#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderer.h>

#include <array>
#include <optional>

namespace ostia::view {

/// What lies behind what moves: the wall and the CT. Its picture, colours and depths, is kept, and put back
/// as long as neither a prop, nor the camera, nor the window's size has changed: a cursor that moves over a
/// tree of 100,000 triangles then costs two copies of the picture. A second renderer of the same window with
/// the same camera, a higher layer, and PreserveDepthBuffer draws what moves into it.
class StillRenderer final : public vtkOpenGLRenderer {
 public:
  static StillRenderer* New();
  void DeviceRender() override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  /// The last picture was the kept one.
  bool put_back() const { return put_back_; }
  /// The processor draws, and no graphics card; true before the first picture.
  bool in_software() const { return in_software_.value_or(true); }

 private:
  /// All that the picture depends on.
  struct Look {
    vtkMTimeType changed = 0;
    int props = 0;
    std::array<int, 2> size{0, 0};
    const void* window = nullptr;
    bool operator==(const Look&) const = default;
  };
  Look look();
  bool can_keep();
  void copy(vtkOpenGLFramebufferObject& from, vtkOpenGLFramebufferObject& to);
  bool make_room(const std::array<int, 2>& size);
  Look kept_of_;
  std::array<int, 2> room_{0, 0};  // of the kept picture
  bool put_back_ = false;
  std::optional<bool> in_software_;
  vtkNew<vtkOpenGLFramebufferObject> kept_;
};

}  // namespace ostia::view
