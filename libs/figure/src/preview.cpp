#include "ostia/figure/preview.h"

#include "ostia/core/error.h"
#include "ostia/figure/scene.h"
#include "ostia/figure/strip_figure.h"
#include "ostia/reformat/curved_reformation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::figure {
namespace {

constexpr int preview_width_px = 380, preview_height_px = 300;
constexpr std::size_t most_looked_at = 2000;  // points that a camera is chosen by
constexpr std::size_t most_triangles_with_edges = 6000;
constexpr double tallest_slice_px = 120.0;
constexpr double level_hu = 250.0, window_hu = 900.0;

RenderOptions preview_options() {
  RenderOptions options;
  options.width_px = preview_width_px;
  options.height_px = preview_height_px;
  options.samples = 2;
  options.occlusion_rays = 0;
  options.legend = false;
  return options;
}

Camera camera_for(const std::vector<Vec3>& points) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / most_looked_at);
  std::vector<Vec3> some;
  for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
  return cameras::broadside(some);
}

Picture preview_of(MeshActor actor) {
  if (actor.mesh.triangles.empty()) throw InvalidInput("there is no triangle to be seen");
  const Camera camera = camera_for(actor.mesh.points);
  Scene scene;
  scene.meshes.push_back(std::move(actor));
  return scene_figure(scene, camera, preview_options());
}

/// Columns and rows of a picture of voxels, and whether rows rise from the bottom.
struct SliceOf {
  std::size_t column, row, across;
  bool upwards;
};
constexpr std::array<SliceOf, 3> middle_slices{{{0, 1, 2, false}, {0, 2, 1, true}, {1, 2, 0, true}}};

struct GreyRange {
  double low = 0.0, high = 1.0;
};

template <class T>
double voxel_at(const imaging::Volume<T>& volume, const SliceOf& slice, double across, double down) {
  std::array<std::int64_t, 3> at{};
  const auto place = [&](std::size_t axis, double share) {
    const auto count = volume.geometry.size[axis];
    at[axis] =
        std::clamp<std::int64_t>(static_cast<std::int64_t>(share * static_cast<double>(count)), 0, count - 1);
  };
  place(slice.column, across);
  place(slice.row, slice.upwards ? 1.0 - down : down);
  place(slice.across, 0.5);
  return static_cast<double>(volume(at[0], at[1], at[2]));
}

template <class T>
void require_voxels(const imaging::Volume<T>& volume) {
  if (volume.voxels.empty()) throw InvalidInput("there is no voxel to be seen");
}

/// Of all voxels in the three slices, so that all are shown alike.
template <class T>
GreyRange range_seen(const imaging::Volume<T>& volume) {
  constexpr int steps = 256;
  require_voxels(volume);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const SliceOf& slice : middle_slices)
    for (int y = 0; y < steps; ++y)
      for (int x = 0; x < steps; ++x) {
        const double value = voxel_at(volume, slice, (x + 0.5) / steps, (y + 0.5) / steps);
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
      }
  if (!(low < high)) return {std::min(low, 0.0), std::min(low, 0.0) + 1.0};
  return {low, high};
}

template <class T>
Picture slice_picture(const imaging::Volume<T>& volume, const SliceOf& slice, double px_per_mm,
                      const GreyRange& range) {
  const auto pixels = [&](std::size_t axis) {
    const double mm = static_cast<double>(volume.geometry.size[axis]) *
                      volume.geometry.spacing[static_cast<Eigen::Index>(axis)];
    return std::max(2, static_cast<int>(std::lround(mm * px_per_mm)));
  };
  Raster raster{pixels(slice.column), pixels(slice.row), {}};
  raster.rgba.reserve(4 * static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height));
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const double value = voxel_at(volume, slice, (x + 0.5) / raster.width, (y + 0.5) / raster.height);
      const double share = std::isfinite(value) ? (value - range.low) / (range.high - range.low) : 0.0;
      const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
      raster.rgba.insert(raster.rgba.end(), {grey, grey, grey, 255});
    }
  return picture_of(raster);
}

template <class T>
Picture slices_of(const imaging::Volume<T>& volume, const GreyRange& range) {
  require_voxels(volume);
  double tallest_mm = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    tallest_mm = std::max(tallest_mm, static_cast<double>(volume.geometry.size[axis]) *
                                          volume.geometry.spacing[static_cast<Eigen::Index>(axis)]);
  std::vector<Picture> panels;
  for (const SliceOf& slice : middle_slices)
    panels.push_back(slice_picture(volume, slice, tallest_slice_px / tallest_mm, range));
  GridOptions options;
  options.gap_px = 6;
  return grid(panels, options);
}

}  // namespace

Picture surface_preview(const geometry::TriMesh& surface) {
  MeshActor actor;
  actor.mesh = surface;
  return preview_of(std::move(actor));
}

Picture mesh_preview(const geometry::MixedMesh& mesh) {
  MeshActor actor;
  actor.mesh.points = mesh.points;
  actor.mesh.triangles = mesh.triangles;
  actor.half_of_quad.assign(mesh.triangles.size(), false);
  for (const geometry::Quad& quad : mesh.quads) {
    actor.mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    actor.mesh.triangles.push_back({quad[2], quad[3], quad[0]});
    actor.half_of_quad.insert(actor.half_of_quad.end(), 2, true);
  }
  actor.shading = Shading::flat;
  actor.edges = actor.mesh.triangles.size() <= most_triangles_with_edges;
  return preview_of(std::move(actor));
}

Picture tree_preview(const geometry::VesselTree& tree) {
  std::vector<NamedTube> tubes;
  for (const geometry::Vessel& vessel : tree.vessels) {
    geometry::Centerline axis = geometry::vessel_axis(tree, vessel);
    tubes.push_back({vessel.name, std::move(axis.points), std::move(axis.radius)});
  }
  return tube_preview(tubes);
}

Picture tube_preview(const std::vector<NamedTube>& tubes) {
  Scene scene;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const NamedTube& one = tubes[i];
    if (one.points.empty()) continue;
    points.insert(points.end(), one.points.begin(), one.points.end());
    scene.labels.push_back({one.points.back(), one.name});
    scene.tubes.push_back({one.points, one.radius_mm, palette(i), {}});
  }
  if (points.empty()) throw InvalidInput("there is no vessel to be seen");
  return scene_figure(scene, camera_for(points), preview_options());
}

Picture volume_preview(const imaging::ImageVolume& image) {
  return slices_of(image, {level_hu - window_hu / 2.0, level_hu + window_hu / 2.0});
}
Picture volume_preview(const imaging::MaskVolume& mask) {
  return slices_of(mask, range_seen(mask));
}
Picture volume_preview(const imaging::FloatVolume& values) {
  return slices_of(values, range_seen(values));
}

Picture vessel_preview(const imaging::ImageVolume& image, const VesselView& view,
                       const core::TaskContext& task) {
  if (!view.axis) throw InvalidInput("there is no axis to look along");
  constexpr double across_mm = 16.0, longest_px = 420.0;
  reformat::CurvedOptions options;
  options.theta_deg = view.theta_deg;
  options.width = static_cast<int>(std::lround(across_mm / options.pixel_mm));
  options.height = std::max(2, static_cast<int>(std::ceil(view.axis->length() / options.pixel_mm)));
  const reformat::CurvedReformation first(view.axis, options);
  std::vector<StripPanel> panels;
  for (const reformat::CurvedReformation& one : {first, first.twin()})
    panels.push_back({std::to_string(std::lround(one.options().theta_deg)) + "\xC2\xB0",
                      options.width,
                      options.height,
                      reformat::reformatted(image, one, imaging::Interpolation::trilinear, task).values,
                      {}});
  StripFigureOptions how;
  how.title = view.name;
  how.pixel_mm = options.pixel_mm;
  how.px_per_mm = std::clamp(longest_px / view.axis->length(), 0.5, 8.0);
  how.level_hu = level_hu;
  how.window_hu = window_hu;
  return strip_figure(panels, {}, how);
}

}  // namespace ostia::figure
