#include "seen_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ostia::figure {
namespace {

constexpr double margin_px = 1.0;  // rays are of single precision

/// What a picture's part, between two corners, covers of its pixels.
class PixelMask {
 public:
  explicit PixelMask(const View& view)
      : view_(view),
        width_(static_cast<int>(view.width_px)),
        height_(static_cast<int>(view.height_px)),
        seen_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0) {}

  /// In perspective what reaches behind the eye has no outline.
  bool is_before_eye(const Vec3& p) const {
    return view_.projection == Projection::orthographic ||
           (p - view_.eye).dot(view_.forward) > 1e-3 * view_.focus_distance_mm;
  }
  void add(const Vec2& low, const Vec2& high) {
    const auto pixel = [](double px, int most) {
      return static_cast<int>(std::clamp(std::floor(px), -1.0, static_cast<double>(most)));
    };
    const int x0 = std::max(0, pixel(low.x() - margin_px, width_));
    const int x1 = std::min(width_ - 1, pixel(high.x() + margin_px, width_));
    const int y0 = std::max(0, pixel(low.y() - margin_px, height_));
    const int y1 = std::min(height_ - 1, pixel(high.y() + margin_px, height_));
    for (int y = y0; x0 <= x1 && y <= y1; ++y)
      std::fill_n(seen_.begin() + static_cast<std::ptrdiff_t>(y) * width_ + x0, x1 - x0 + 1, std::uint8_t{1});
  }
  void add_all() { std::fill(seen_.begin(), seen_.end(), std::uint8_t{1}); }
  std::vector<std::uint8_t> take() { return std::move(seen_); }

 private:
  const View& view_;
  int width_, height_;
  std::vector<std::uint8_t> seen_;
};

/// A box of a picture that grows with the points it has to hold.
struct PixelBox {
  Vec2 low = Vec2::Constant(INFINITY), high = Vec2::Constant(-INFINITY);
  void include(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

/// The corners of a ball's cube: what is drawn between two balls lies within those of both.
void include_ball(const View& view, const Vec3& centre, double radius_mm, PixelMask& mask, PixelBox& box,
                  bool& before_eye) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = centre + radius_mm * Vec3((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                                             (corner & 4) != 0 ? 1.0 : -1.0);
    before_eye = before_eye && mask.is_before_eye(p);
    box.include(view.project(p));
  }
}

/// False where it reaches behind the eye.
bool add_mesh(const geometry::TriMesh& mesh, const View& view, PixelMask& mask) {
  std::vector<Vec2> at(mesh.points.size());
  std::vector<char> before_eye(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    at[i] = view.project(mesh.points[i]);
    before_eye[i] = mask.is_before_eye(mesh.points[i]) ? 1 : 0;
  }
  for (const geometry::Triangle& triangle : mesh.triangles) {
    PixelBox box;
    for (const std::int32_t corner : triangle) {
      if (before_eye[static_cast<std::size_t>(corner)] == 0) return false;
      box.include(at[static_cast<std::size_t>(corner)]);
    }
    mask.add(box.low, box.high);
  }
  return true;
}

bool add_tube(const TubeActor& tube, const View& view, PixelMask& mask) {
  const auto radius_mm = [&](std::size_t i) { return tube.radius_mm[tube.radius_mm.size() > 1 ? i : 0]; };
  const std::size_t last = tube.points.size() - 1;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, last); ++i) {
    PixelBox box;
    bool before_eye = true;
    for (const std::size_t end : {i, std::min(i + 1, last)})
      include_ball(view, tube.points[end], radius_mm(end), mask, box, before_eye);
    if (!before_eye) return false;
    mask.add(box.low, box.high);
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> seen_pixels(const Scene& scene, const View& view) {
  PixelMask mask(view);
  const bool outlined = std::all_of(scene.meshes.begin(), scene.meshes.end(),
                                    [&](const MeshActor& one) { return add_mesh(one.mesh, view, mask); }) &&
                        std::all_of(scene.tubes.begin(), scene.tubes.end(),
                                    [&](const TubeActor& one) { return add_tube(one, view, mask); });
  if (!outlined) mask.add_all();
  return mask.take();
}

}  // namespace ostia::figure
