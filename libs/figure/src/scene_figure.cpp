#include "canvas.h"
#include "renderer.h"
#include "scale_bar.h"

#include "ostia/figure/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::figure {
namespace {

constexpr double kTitleSize = 16.0;
const Vec2 kTitleAt(16.0, 14.0);

struct TextBox {
  Vec2 low, high;
  bool overlaps(const TextBox& other) const {
    return (low.array() < other.high.array()).all() && (other.low.array() < high.array()).all();
  }
};

/// Names beside their places: on the side that faces away from the picture's centre, else on the next that is
/// free.
void draw_labels(Canvas& canvas, const View& view, const std::vector<SceneLabel>& labels,
                 const std::string& title, const Theme& look) {
  constexpr double kSize = 12.5;
  constexpr double kGap = 9.0;
  Color halo = look.background;
  halo.a = 0.85;
  std::vector<TextBox> taken;
  if (!title.empty()) taken.push_back({kTitleAt, kTitleAt + Canvas::text_size(title, kTitleSize, true)});
  for (const SceneLabel& label : labels) {
    const Vec2 at = view.project(label.position);
    const Vec2 size = Canvas::text_size(label.text, kSize, true);
    std::array<Vec2, 4> corners{
        at + Vec2(kGap, -0.5 * size.y()), at + Vec2(-kGap - size.x(), -0.5 * size.y()),
        at + Vec2(-0.5 * size.x(), -kGap - size.y()), at + Vec2(-0.5 * size.x(), kGap)};
    const Vec2 outwards = at - 0.5 * Vec2(view.width_px, view.height_px);
    std::stable_sort(corners.begin(), corners.end(), [&](const Vec2& a, const Vec2& b) {
      const auto share = [&](const Vec2& corner) {
        return outwards.dot((corner + 0.5 * size - at).cwiseQuotient(size + Vec2(kGap, kGap)));
      };
      return share(a) > share(b);
    });
    const auto free = [&](const Vec2& corner) {
      const TextBox box{corner, corner + size};
      const bool within = (box.low.array() >= 2.0).all() && box.high.x() <= view.width_px - 2.0 &&
                          box.high.y() <= view.height_px - 2.0;
      return within &&
             std::none_of(taken.begin(), taken.end(), [&](const TextBox& t) { return t.overlaps(box); });
    };
    const auto place = std::find_if(corners.begin(), corners.end(), free);
    const Vec2 corner = place == corners.end() ? corners[0] : *place;
    taken.push_back({corner, corner + size});
    canvas.disc(at, 4.0, halo);
    canvas.disc(at, 2.4, look.foreground);
    canvas.text(corner, label.text, {.size_px = kSize, .color = look.foreground, .bold = true, .halo = halo});
  }
}

/// Small axes to the left, back and head of the patient, the nearest drawn last.
void draw_axes(Canvas& canvas, const View& view, const Theme& look) {
  struct Axis {
    Vec3 direction;
    const char* letter;
    Color color;
  };
  std::array<Axis, 3> axes{{{Vec3::UnitX(), "L", {0.88, 0.33, 0.29}},
                            {Vec3::UnitY(), "P", {0.25, 0.68, 0.38}},
                            {Vec3::UnitZ(), "S", {0.33, 0.56, 0.92}}}};
  std::sort(axes.begin(), axes.end(), [&](const Axis& a, const Axis& b) {
    return a.direction.dot(view.forward) > b.direction.dot(view.forward);
  });
  constexpr double kLength = 34.0;
  const Vec2 origin(58.0, view.height_px - 58.0);
  for (const Axis& axis : axes) {
    const Vec2 along(axis.direction.dot(view.right), axis.direction.dot(view.down));
    const double share = along.norm();
    const Vec2 tip = origin + kLength * along;
    canvas.line(origin, tip, axis.color, 2.4);
    if (share > 0.12) {
      const Vec2 unit = along / share;
      const Vec2 side(-unit.y(), unit.x());
      canvas.polygon({tip + 6.0 * unit, tip + 4.0 * side, tip - 4.0 * side}, axis.color);
    } else {
      canvas.disc(tip, 3.4, axis.color);  // towards or away from the viewer
    }
    const Vec2 letter =
        origin + kLength * along + 15.0 * (share > 0.12 ? Vec2(along / share) : Vec2(-0.71, 0.71));
    canvas.text(letter, axis.letter,
                {.size_px = 12.5,
                 .color = axis.color,
                 .bold = true,
                 .across = Align::middle,
                 .along = Align::middle,
                 .halo = look.background});
  }
}

void draw_legend(Canvas& canvas, const Scene& scene, double width_px, const Theme& look) {
  constexpr double kSize = 12.5;
  double y = 24.0;
  const auto entry = [&](const std::string& label, const Color& color, bool line) {
    if (label.empty()) return;
    const double x = width_px - 16.0;
    Color solid = color;
    solid.a = 1.0;
    if (line) {
      canvas.line({x - 16.0, y}, {x, y}, solid, 3.5);
    } else {
      solid.a = std::max(0.35, color.a);
      canvas.fill(x - 14.0, y - 7.0, 14.0, 14.0, solid);
      canvas.frame(x - 14.0, y - 7.0, 14.0, 14.0, look.muted, 0.8);
    }
    canvas.text({x - 24.0, y}, label,
                {.size_px = kSize,
                 .color = look.foreground,
                 .across = Align::end,
                 .along = Align::middle,
                 .halo = look.background});
    y += 22.0;
  };
  for (const MeshActor& actor : scene.meshes) entry(actor.label, actor.color, false);
  for (const TubeActor& tube : scene.tubes) entry(tube.label, tube.color, tube.points.size() > 1);
}

/// The raster with what is written over it.
Picture dressed(const Raster& raster, const Scene& scene, const Camera& camera,
                const RenderOptions& options) {
  const double width = options.width_px;
  const double height = options.height_px;
  const View view = fitted_view(scene, camera, width, height);
  const Theme look = theme(options.look);
  return drawn(options.width_px, options.height_px, [&](Canvas& canvas) {
    canvas.fill(0, 0, width, height, look.background);
    canvas.image(raster, 0, 0, width, height);
    draw_labels(canvas, view, scene.labels, options.title, look);
    if (options.orientation_axes) draw_axes(canvas, view, look);
    if (options.legend) draw_legend(canvas, scene, width, look);
    if (options.scale_bar) {
      draw_scale_bar(canvas, {width - 18.0, height - 18.0}, view.mm_per_px, 0.25 * width, look.foreground,
                     look.background);
    }
    if (!options.title.empty()) {
      canvas.text(kTitleAt, options.title,
                  {.size_px = kTitleSize, .color = look.foreground, .bold = true, .halo = look.background});
    }
  });
}

Vec3 middle_of(const Scene& scene) {
  geometry::Box3 box;
  for (const MeshActor& actor : scene.meshes)
    for (const Vec3& p : actor.mesh.points) box.extend(p);
  for (const TubeActor& tube : scene.tubes)
    for (const Vec3& p : tube.points) box.extend(p);
  return box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.center());
}

}  // namespace

Picture scene_figure(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const core::TaskContext& task) {
  return dressed(render(scene, camera, options, task), scene, camera, options);
}

std::vector<Picture> scene_figures(const Scene& scene, const std::vector<SceneSight>& sights,
                                   const RenderOptions& options, const core::TaskContext& task) {
  validate(scene, options);
  const RayScene rays(scene, middle_of(scene));
  std::vector<Picture> pictures;
  for (const SceneSight& sight : sights) {
    const auto done = [&](std::size_t count) {
      return static_cast<double>(count) / static_cast<double>(sights.size());
    };
    RenderOptions of_sight = options;
    of_sight.title = sight.title;
    const Raster raster = rendered(scene, rays, raster_view(scene, sight.camera, of_sight), of_sight,
                                   task.sub(done(pictures.size()), done(pictures.size() + 1)));
    pictures.push_back(dressed(raster, scene, sight.camera, of_sight));
  }
  return pictures;
}

}  // namespace ostia::figure
