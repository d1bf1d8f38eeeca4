#pragma once
/// \file Places on a surface, in colour.

#include "ostia/figure/color.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/view/scene_guest.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::view {

/// Something to be seen on a surface.
struct SurfacePlace {
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< mm
  double extent_mm = 1.0;                         ///< a radius about the point; >= 0
  std::vector<std::int32_t> triangles;            ///< of the surface; may be empty
  figure::Color color;
};

/// A surface in one colour with places on it: their triangles in colour, and three circles of a ball of
/// 0.5 to 3 mm about each point, seen through the wall.
class ForecastScene final : public SceneGuest {
 public:
  /// Of places that share a triangle the first colours it. Throws InvalidInput for no triangles, a triangle
  /// or point that is not there, and places that are not finite.
  ForecastScene(const geometry::TriMesh& surface, std::vector<SurfacePlace> places);
  ~ForecastScene() override;
  /// The circles of one place alone, and thick; or all. Throws InvalidInput.
  void choose(std::optional<std::size_t> place);

  vtkProp& prop() override;
  vtkSmartPointer<vtkProp> twin() const override;
  std::vector<geometry::Vec3> outline() const override;
  std::optional<ValueScale> bar() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::view
