#pragma once
/// \file A scene prepared for ray casting.

#include "ostia/figure/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::figure {

struct Ray {
  Vec3 origin = Vec3::Zero(), direction = Vec3::UnitZ();
};

/// Where a ray meets the scene.
struct Hit {
  double t = 0.0;
  bool tube = false;
  std::size_t actor = 0;     ///< index into the scene's meshes or tubes
  std::size_t triangle = 0;  ///< of a mesh
  Vec3 barycentric = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< geometric, unit, outward
};

/// Embree's hierarchies over a scene: one of what is opaque and one of what shines through. Positions are
/// single precision about `centre`. Queries are const and safe from many threads.
class RayScene {
 public:
  RayScene(const Scene& scene, const Vec3& centre);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  enum class Part { opaque, transparent };
  std::optional<Hit> first_hit(Part part, const Ray& ray, double near_mm, double far_mm) const;
  /// Whether something opaque lies on the ray nearer than `far_mm`.
  bool occluded(const Ray& ray, double near_mm, double far_mm) const;
  bool has_transparent() const;
  const Vec3& centre() const;
  double diagonal_mm() const;
  /// The shading normal: interpolated between the corners of smooth meshes, else the geometric one. Unit.
  Vec3 shading_normal(const Hit& hit) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Normals of each triangle's three corners: means of the triangles about the vertex, weighted by area, that
/// are bent less than `crease_deg` against the triangle itself.
std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(const geometry::TriMesh& mesh, double crease_deg);

}  // namespace ostia::figure
