#include "ostia/view/forecast_scene.h"

#include "scene/flat_surface.h"
#include "scene/scene_lines.h"

#include "ostia/core/error.h"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkPropAssembly.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::view {
namespace {

using geometry::Vec3;

constexpr figure::Color sound{0.62, 0.65, 0.70, 1.0};
constexpr double least_ring_mm = 0.5, most_ring_mm = 3.0;  // of a large place the worst point
constexpr int ring_points = 48;

void check(const geometry::TriMesh& mesh, const std::vector<SurfacePlace>& places) {
  if (mesh.triangles.empty()) throw InvalidInput("the surface to be shown has no triangles");
  const auto points = static_cast<std::int32_t>(mesh.points.size());
  for (const geometry::Triangle& t : mesh.triangles)
    for (const std::int32_t corner : t)
      if (corner < 0 || corner >= points)
        throw InvalidInput("a triangle of the surface to be shown refers to point " + std::to_string(corner) +
                           ", which does not exist");
  for (const SurfacePlace& place : places) {
    if (!place.point.allFinite() || !(place.extent_mm >= 0.0) || !std::isfinite(place.extent_mm))
      throw InvalidInput("a place to be shown on the surface has coordinates that are no numbers");
    for (const std::int32_t triangle : place.triangles)
      if (triangle < 0 || static_cast<std::size_t>(triangle) >= mesh.triangles.size())
        throw InvalidInput("a place to be shown is on triangle " + std::to_string(triangle) +
                           ", which the surface has not");
  }
}

}  // namespace

struct ForecastScene::Impl {
  std::vector<Vec3> points;
  std::vector<SurfacePlace> places;
  FlatGuest drawn;
};

ForecastScene::ForecastScene(const geometry::TriMesh& surface, std::vector<SurfacePlace> places)
    : impl_(std::make_unique<Impl>()) {
  check(surface, places);
  impl_->points = surface.points;
  impl_->places = std::move(places);
  std::vector<figure::Color> colors(surface.triangles.size(), sound);
  for (auto place = impl_->places.rbegin(); place != impl_->places.rend(); ++place)
    for (const std::int32_t triangle : place->triangles)
      colors[static_cast<std::size_t>(triangle)] = place->color;
  std::vector<std::array<std::int32_t, 4>> sides;
  sides.reserve(surface.triangles.size());
  for (const geometry::Triangle& t : surface.triangles) sides.push_back({t[0], t[1], t[2], -1});
  set_flat_points(*impl_->drawn.sides, surface.points);
  set_flat_sides(*impl_->drawn.sides, sides);
  set_flat_colors(*impl_->drawn.sides, colors);
  impl_->drawn.surface->VisibilityOn();
  choose({});
}

ForecastScene::~ForecastScene() = default;

void ForecastScene::choose(std::optional<std::size_t> chosen) {
  if (chosen && *chosen >= impl_->places.size())
    throw InvalidInput("there is no place " + std::to_string(*chosen) + " on the surface that is shown");
  std::vector<SceneLine> lines;
  for (std::size_t i = 0; i < impl_->places.size(); ++i) {
    if (chosen && *chosen != i) continue;
    const SurfacePlace& place = impl_->places[i];
    const double radius = std::clamp(1.2 * place.extent_mm, least_ring_mm, most_ring_mm);
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    for (const auto& [u, v] : {std::pair(x, y), std::pair(y, z), std::pair(z, x)}) {
      SceneLine line;
      line.points = circle(place.point, u, v, radius, ring_points);
      line.color = place.color;
      line.closed = true;
      lines.push_back(std::move(line));
    }
  }
  impl_->drawn.set_lines(lines, chosen ? 3.0 : 1.5);
}

vtkProp& ForecastScene::prop() {
  return impl_->drawn.prop();
}

vtkSmartPointer<vtkProp> ForecastScene::twin() const {
  return impl_->drawn.twin();
}

std::vector<Vec3> ForecastScene::outline() const {
  return impl_->points;
}

std::optional<ValueScale> ForecastScene::bar() const {
  return {};
}

}  // namespace ostia::view
