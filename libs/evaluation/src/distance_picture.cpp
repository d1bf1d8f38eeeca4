#include "ostia/evaluation/distance_picture.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::evaluation {
namespace {

using figure::Color;
using geometry::TriMesh;
using geometry::Vec3;

constexpr int bands = 9;
constexpr Color inside_color{0.00, 0.33, 0.64}, fitting_color{0.93, 0.92, 0.88},
    outside_color{0.80, 0.28, 0.0};

Vec3 normal_of(const TriMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.points[static_cast<std::size_t>(b)] - mesh.points[static_cast<std::size_t>(a)])
      .cross(mesh.points[static_cast<std::size_t>(c)] - mesh.points[static_cast<std::size_t>(a)]);
}

Vec3 centroid_of(const TriMesh& mesh, std::size_t t) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t corner : mesh.triangles[t]) sum += mesh.points[static_cast<std::size_t>(corner)];
  return sum / 3.0;
}

/// The smallest of 1, 2, 5 times a power of ten that is not below `value`.
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  return 10.0 * power;
}

double range_of(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (const double v : values)
    if (std::isfinite(v)) sizes.push_back(std::abs(v));
  if (sizes.empty()) return 0.01;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return round_up(std::max(*at, 0.001));
}

int band_of(double value, double range) {
  const double share = std::clamp(0.5 * (value / range + 1.0), 0.0, 1.0);
  return std::min(static_cast<int>(share * bands), bands - 1);
}

Color color_of(int band) {
  const double share = 2.0 * band / (bands - 1) - 1.0;
  const double strength = std::sqrt(std::abs(share));
  return share < 0.0 ? figure::mixed(fitting_color, inside_color, strength)
                     : figure::mixed(fitting_color, outside_color, strength);
}

std::string label_of(int band, double range) {
  const double width = 2.0 * range / bands, low = -range + band * width;
  if (band == 0) return "below " + core::signed_text(low + width, 3) + " mm (inside)";
  if (band == bands - 1) return "above " + core::signed_text(low, 3) + " mm (outside)";
  return core::signed_text(low, 3) + " to " + core::signed_text(low + width, 3) + " mm";
}

}  // namespace

std::vector<double> signed_distances(const TriMesh& reference, const TriMesh& result,
                                     const core::TaskContext& task) {
  if (reference.triangles.empty() || result.triangles.empty())
    throw InvalidInput("cannot measure distances between surfaces: one of them has no triangle");
  const geometry::AabbTree tree(reference);
  const bool closed = geometry::find_faults(reference, false).open_edges == 0;
  std::vector<double> distances(result.triangles.size());
  core::parallel_for(distances.size(), 256, [&](std::size_t t) {
    if (t % 256 == 0) task.throw_if_cancelled();
    const Vec3 at = centroid_of(result, t);
    const geometry::SurfacePoint nearest = tree.closest(at);
    const bool outside =
        closed
            ? !tree.inside(at)
            : (at - nearest.point).dot(normal_of(reference, static_cast<std::size_t>(nearest.triangle))) > 0;
    distances[t] = outside ? nearest.distance : -nearest.distance;
  });
  return distances;
}

figure::Picture distance_figure(const TriMesh& surface, const std::vector<double>& distance_mm,
                                const DistanceFigureOptions& options, const core::TaskContext& task) {
  if (distance_mm.size() != surface.triangles.size() || surface.triangles.empty())
    throw InvalidInput("a picture of distances needs one distance a triangle");
  const double range = options.range_mm > 0.0 ? options.range_mm : range_of(distance_mm);
  figure::Scene scene;
  figure::MeshActor actor;
  actor.mesh = surface;
  std::array<bool, bands> there{};
  for (const double d : distance_mm) {
    const int band = band_of(d, range);
    there[static_cast<std::size_t>(band)] = true;
    actor.triangle_colors.push_back(color_of(band));
  }
  scene.meshes.push_back(std::move(actor));
  for (int band = bands - 1; band >= 0; --band) {  // the legend, from far outside to far inside
    figure::MeshActor entry;
    entry.color = color_of(band);
    entry.label = label_of(band, range);
    scene.meshes.push_back(std::move(entry));
  }
  figure::RenderOptions how;
  how.width_px = options.width_px;
  how.height_px = options.height_px;
  how.title = options.title;
  return figure::scene_figure(scene, figure::cameras::broadside(surface.points), how, task);
}

}  // namespace ostia::evaluation
