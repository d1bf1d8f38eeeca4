#include "ostia/view/surface_field_scene.h"

#include "scene/wall_actor.h"
#include "scene/wall_change.h"

#include "ostia/core/error.h"

#include <vtkActor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::view {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

const geometry::TriMesh& checked(const geometry::TriMesh& mesh) {
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  if (mesh.triangles.empty()) throw InvalidInput("the surface to be shown has no triangles");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::int32_t corner : mesh.triangles[i])
      if (corner < 0 || corner >= count)
        throw InvalidInput("triangle " + std::to_string(i) + " of the surface to be shown has a corner " +
                           std::to_string(corner) + ", there are " + std::to_string(count) + " points");
  return mesh;
}

/// Each triangle with corners of its own, so that it can have a colour of its own.
struct Loose {
  geometry::TriMesh mesh;
  std::vector<Eigen::Vector3f> normals;
};

Loose loosened(const geometry::TriMesh& mesh, const std::vector<Eigen::Vector3f>& normals) {
  Loose loose;
  for (const geometry::Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(loose.mesh.points.size());
    loose.mesh.triangles.push_back({first, first + 1, first + 2});
    for (const std::int32_t corner : t) {
      loose.mesh.points.push_back(mesh.points[static_cast<std::size_t>(corner)]);
      loose.normals.push_back(normals[static_cast<std::size_t>(corner)]);
    }
  }
  return loose;
}

}  // namespace

FieldSurface::FieldSurface(geometry::TriMesh surface) : mesh_(std::move(surface)), tree_(checked(mesh_)) {}

std::pair<double, double> automatic_range(std::span<const double> values) {
  std::vector<double> known;
  std::ranges::copy_if(values, std::back_inserter(known), [](double v) { return std::isfinite(v); });
  if (known.empty()) return {0.0, 1.0};
  std::ranges::sort(known);
  const auto ranked = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(known.size()));
    return known[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  };
  const double low = ranked(0.02), high = ranked(0.98);
  const double room = 1e-6 * std::max({std::abs(low), std::abs(high), 1e-300});
  if (high - low > room) return {low, high};
  const double half = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
  return {low - half, low + half};
}

struct SurfaceFieldScene::Impl {
  std::shared_ptr<const FieldSurface> surface;
  std::vector<Eigen::Vector3f> normals;
  WallActor actor;
  std::vector<double> values;
  FieldAt at = FieldAt::points;
  std::optional<FieldAt> drawn;  // as what the actor has its points
  std::optional<ValueScale> scale;

  void draw() {
    if (drawn == at) return;
    drawn = at;
    const auto all = [](std::size_t) { return true; };
    if (at == FieldAt::points) {
      actor.set_points(surface->mesh(), normals);
      actor.set_triangles(surface->mesh(), all);
    } else {
      const Loose loose = loosened(surface->mesh(), normals);
      actor.set_points(loose.mesh, loose.normals);
      actor.set_triangles(loose.mesh, all);
    }
  }
};

SurfaceFieldScene::SurfaceFieldScene(std::shared_ptr<const FieldSurface> surface)
    : impl_(std::make_unique<Impl>()) {
  if (!surface) throw InvalidInput("there is no surface to be shown");
  impl_->surface = std::move(surface);
  impl_->normals = smooth_normals(impl_->surface->mesh());
}

SurfaceFieldScene::~SurfaceFieldScene() = default;

void SurfaceFieldScene::set_values(std::vector<double> values, FieldAt at, const ValueScale& scale) {
  validate(scale);
  const geometry::TriMesh& mesh = impl_->surface->mesh();
  const std::size_t wanted = at == FieldAt::points ? mesh.points.size() : mesh.triangles.size();
  if (values.size() != wanted)
    throw InvalidInput(std::to_string(values.size()) + " values were given for a surface of " +
                       std::to_string(wanted) + (at == FieldAt::points ? " points" : " triangles"));
  impl_->values = std::move(values);
  impl_->at = at;
  impl_->scale = scale;
  impl_->draw();
  const std::size_t corners = at == FieldAt::points ? wanted : 3 * wanted;
  impl_->actor.set_colors(corners, [&](std::size_t i) {
    const double value = impl_->values[at == FieldAt::points ? i : i / 3];
    const double t = (value - scale.low) / (scale.high - scale.low);
    return scale_color(scale.colors, std::isfinite(value) ? t : not_known);
  });
}

std::optional<double> SurfaceFieldScene::value_at(const SceneRay& ray) const {
  if (!impl_->scale) return {};
  const auto hit = impl_->surface->tree().first_hit(ray.origin, ray.direction);
  if (!hit) return {};
  const auto triangle = static_cast<std::size_t>(hit->triangle);
  if (impl_->at == FieldAt::triangles) return impl_->values[triangle];
  const geometry::TriMesh& mesh = impl_->surface->mesh();
  const geometry::Triangle& t = mesh.triangles[triangle];
  const auto corner = [&](std::size_t c) -> const geometry::Vec3& {
    return mesh.points[static_cast<std::size_t>(t[c])];
  };
  const geometry::Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  double value = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const geometry::Vec3 part =
        (corner((c + 2) % 3) - corner((c + 1) % 3)).cross(hit->point - corner((c + 1) % 3));
    const double weight = part.dot(normal) / normal.squaredNorm();
    value += weight * impl_->values[static_cast<std::size_t>(t[c])];
  }
  return std::isfinite(value) ? value : not_known;
}

vtkProp& SurfaceFieldScene::prop() {
  return *impl_->actor.prop();
}

vtkSmartPointer<vtkProp> SurfaceFieldScene::twin() const {
  return impl_->actor.twin();
}

std::vector<geometry::Vec3> SurfaceFieldScene::outline() const {
  return impl_->surface->mesh().points;
}

std::optional<ValueScale> SurfaceFieldScene::bar() const {
  return impl_->scale;
}

}  // namespace ostia::view
