#include "renderer.h"

#include "seen_pixels.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace ostia::figure {
namespace {

/// Colour times opacity, and opacity: what compositing adds up.
struct Layered {
  Vec3 color = Vec3::Zero();
  double alpha = 0.0;
  void behind(const Vec3& rgb, double a) {
    color += (1.0 - alpha) * a * rgb;
    alpha += (1.0 - alpha) * a;
  }
};

Vec3 rgb(const Color& color) {
  return {color.r, color.g, color.b};
}

std::uint32_t hashed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  return x ^ (x >> 16);
}

double fraction(double x) {
  return x - std::floor(x);
}

/// Distance of a point from a segment in the picture.
double distance_to(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t = std::clamp((p - a).dot(along) / std::max(1e-12, along.squaredNorm()), 0.0, 1.0);
  return (p - a - t * along).norm();
}

class Renderer {
 public:
  Renderer(const Scene& scene, const RayScene& rays, const View& view, const RenderOptions& options)
      : scene_(scene),
        view_(view),
        options_(options),
        centre_(rays.centre()),
        rays_(rays),
        reach_(options.occlusion_reach * rays_.diagonal_mm()),
        nudge_(1e-4 * std::max(1e-3, rays_.diagonal_mm())) {}

  Layered pixel(int x, int y) const {
    Layered sum;
    const int n = options_.samples;
    for (int s = 0; s < n * n; ++s) {
      const Vec2 at(x + (s % n + 0.5) / n, y + (s / n + 0.5) / n);
      const Layered one = sample(at, x, y, s);
      sum.color += one.color / (n * n);
      sum.alpha += one.alpha / (n * n);
    }
    return sum;
  }

 private:
  Ray ray_through(const Vec2& picture) const {
    const Vec3 across = view_.mm_per_px * ((picture.x() - 0.5 * view_.width_px) * view_.right +
                                           (picture.y() - 0.5 * view_.height_px) * view_.down);
    const Vec3 eye = view_.eye - centre_;
    if (view_.projection == Projection::orthographic) return {eye + across, view_.forward};
    return {eye, (view_.focus_distance_mm * view_.forward + across).normalized()};
  }

  Layered sample(const Vec2& at, int x, int y, int index) const {
    const Ray ray = ray_through(at);
    double far = INFINITY;
    const auto solid = rays_.first_hit(RayScene::Part::opaque, ray, 0.0, far);
    if (solid) far = solid->t;
    Layered result;
    if (rays_.has_transparent()) {
      constexpr int kMostLayers = 64;
      double near = 0.0;
      for (int layer = 0; layer < kMostLayers && result.alpha < 0.995; ++layer) {
        const auto film = rays_.first_hit(RayScene::Part::transparent, ray, near, far);
        if (!film) break;
        add_film(result, *film, ray, at);
        near = film->t + nudge_;
      }
    }
    if (solid) {
      const double open = openness(*solid, ray, x, y, index);
      result.behind(shaded(*solid, ray, at, open).first, 1.0);
    }
    return result;
  }

  /// A thin wall seen at a slant is crossed on a longer way, and hides more.
  void add_film(Layered& result, const Hit& film, const Ray& ray, const Vec2& at) const {
    auto [color, edge] = shaded(film, ray, at, 1.0);
    // What shines through is lit from behind, too.
    if (edge == 0.0) color = 0.5 * color + 0.5 * rgb(base_color(film));
    const double opacity = film.tube ? scene_.tubes[film.actor].color.a : scene_.meshes[film.actor].color.a;
    const double cosine = std::max(0.15, std::abs(rays_.shading_normal(film).dot(ray.direction)));
    const double alpha = 1.0 - std::pow(1.0 - opacity, 1.0 / cosine);
    result.behind(color, std::max(alpha, 0.7 * edge));
  }

  /// Share of the hemisphere above a point from which light comes, over directions weighted by their cosine.
  double openness(const Hit& hit, const Ray& ray, int x, int y, int index) const {
    const int count = options_.occlusion_rays;
    if (count == 0 || !(reach_ > 0.0)) return 1.0;
    const Vec3 normal = hit.normal.dot(ray.direction) > 0.0 ? Vec3(-hit.normal) : hit.normal;
    const Vec3 side = (std::abs(normal.x()) > 0.7 ? Vec3::UnitY() : Vec3::UnitX()).cross(normal).normalized();
    const Vec3 other = normal.cross(side);
    const Vec3 origin = ray.origin + hit.t * ray.direction + nudge_ * normal;
    // All of a pixel's rays are one low-discrepancy sequence (Roberts' R2), shifted from pixel to pixel.
    const std::uint32_t seed =
        hashed(static_cast<std::uint32_t>(x) * 73856093U ^ static_cast<std::uint32_t>(y) * 19349663U);
    const double shift_u = (seed & 0xFFFFU) / 65536.0;
    const double shift_v = (seed >> 16) / 65536.0;
    int blocked = 0;
    for (int i = 0; i < count; ++i) {
      const double k = static_cast<double>(index * count + i);
      const double u = fraction(shift_u + k * 0.7548776662466927);
      const double v = fraction(shift_v + k * 0.5698402909980532);
      const double r = std::sqrt(u);
      const double angle = 2.0 * std::numbers::pi * v;
      const Vec3 direction =
          r * std::cos(angle) * side + r * std::sin(angle) * other + std::sqrt(1.0 - u) * normal;
      if (rays_.occluded({origin, direction}, 0.0, reach_)) ++blocked;
    }
    return 1.0 - static_cast<double>(blocked) / count;
  }

  Color base_color(const Hit& hit) const {
    if (hit.tube) return scene_.tubes[hit.actor].color;
    const MeshActor& actor = scene_.meshes[hit.actor];
    return actor.triangle_colors.empty() ? actor.color : actor.triangle_colors[hit.triangle];
  }

  /// How much of the point is covered by a triangle edge, 0 to 1.
  double edge_cover(const Hit& hit, const Vec2& at) const {
    if (hit.tube || !scene_.meshes[hit.actor].edges) return 0.0;
    const MeshActor& actor = scene_.meshes[hit.actor];
    const geometry::Triangle& triangle = actor.mesh.triangles[hit.triangle];
    std::array<Vec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = view_.project(actor.mesh.points[static_cast<std::size_t>(triangle[k])]);
    double nearest = INFINITY;
    double longest = 1e-12;
    const bool half = !actor.half_of_quad.empty() && actor.half_of_quad[hit.triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      if (k < 2 || !half) nearest = std::min(nearest, distance_to(at, p[k], p[(k + 1) % 3]));
      longest = std::max(longest, (p[(k + 1) % 3] - p[k]).norm());
    }
    const Vec2 a = p[1] - p[0];
    const Vec2 b = p[2] - p[0];
    const double height = std::abs(a.x() * b.y() - a.y() * b.x()) / longest;
    const double width = actor.edge_width_px * options_.density;
    // Where triangles are hardly larger than the lines, full lines would leave nothing but their own colour.
    const double fade = std::clamp((height - width) / (7.0 * width), 0.04, 1.0);
    return fade * std::clamp((0.5 * width + 0.3 - nearest) / 0.6, 0.0, 1.0);
  }

  /// Light from the viewer's head and a softer one from the upper left; returns the colour and the edge's
  /// cover.
  std::pair<Vec3, double> shaded(const Hit& hit, const Ray& ray, const Vec2& at, double open) const {
    Vec3 normal = rays_.shading_normal(hit);
    const bool inside = hit.normal.dot(ray.direction) > 0.0;
    if (inside) normal = -normal;
    const Vec3 viewer = -ray.direction;
    if (normal.dot(viewer) < 0.05) normal = (normal + (0.05 - normal.dot(viewer)) * viewer).normalized();
    const Vec3 key = (0.72 * viewer - 0.40 * view_.right - 0.56 * view_.down).normalized();
    const double head = std::max(0.0, normal.dot(viewer));
    const double side = std::max(0.0, normal.dot(key));
    const double shine = std::pow(std::max(0.0, normal.dot((key + viewer).normalized())), 48.0);

    Vec3 color = rgb(base_color(hit));
    if (inside)
      color = 0.72 * color + 0.28 * Vec3(0.30, 0.29, 0.32);  // a wall's inner side, told from its outer one
    const double light = (0.28 + 0.36 * head) * (0.30 + 0.70 * open) + 0.50 * side * (0.55 + 0.45 * open);
    color = light * color + 0.13 * shine * open * Vec3::Ones();
    const double edge = edge_cover(hit, at);
    if (edge > 0.0) color += edge * (rgb(scene_.meshes[hit.actor].edge_color) - color);
    return {color.cwiseMax(0.0).cwiseMin(1.0), edge};
  }

  const Scene& scene_;
  const View& view_;
  const RenderOptions& options_;
  Vec3 centre_;
  const RayScene& rays_;
  double reach_, nudge_;
};

}  // namespace

Raster rendered(const Scene& scene, const RayScene& rays, const View& view, const RenderOptions& options,
                const core::TaskContext& task) {
  Raster raster;
  raster.width = static_cast<int>(view.width_px);
  raster.height = static_cast<int>(view.height_px);
  const Renderer renderer(scene, rays, view, options);
  const std::vector<std::uint8_t> seen = seen_pixels(scene, view);
  task.throw_if_cancelled();
  raster.rgba.assign(4 * seen.size(), 0);
  std::atomic<int> rows_done{0};
  core::parallel_for(static_cast<std::size_t>(raster.height), 4, [&](std::size_t row) {
    task.throw_if_cancelled();
    const std::size_t first = row * static_cast<std::size_t>(raster.width);
    std::uint8_t* out = raster.rgba.data() + 4 * first;
    for (int x = 0; x < raster.width; ++x, out += 4) {
      if (seen[first + static_cast<std::size_t>(x)] == 0) continue;
      const Layered sum = renderer.pixel(x, static_cast<int>(row));
      if (!(sum.alpha > 0.0)) continue;
      const auto byte = [](double c) {
        return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(c, 0.0, 1.0)));
      };
      for (int k = 0; k < 3; ++k) out[k] = byte(sum.color[k] / sum.alpha);
      out[3] = byte(sum.alpha);
    }
    task.set_progress(static_cast<double>(++rows_done) / raster.height);
  });
  return raster;
}

}  // namespace ostia::figure
