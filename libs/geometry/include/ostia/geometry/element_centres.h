#pragma once
/// \file Where a volume mesh's elements are.

#include "ostia/geometry/mixed_mesh.h"

namespace ostia::geometry {

/// The mean of the points with these indices; there is at least one.
template <class Indices>
Vec3 mean_point(const Indices& indices, const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t p : indices) sum += points[static_cast<std::size_t>(p)];
  return sum / static_cast<double>(indices.size());
}

/// The mean of an element's corners, mm; tetrahedra are counted first, then prisms.
inline Vec3 element_centre(const MixedMesh& mesh, std::size_t element) {
  const std::size_t tetrahedra = mesh.tetrahedra.size();
  return element < tetrahedra ? mean_point(mesh.tetrahedra[element], mesh.points)
                              : mean_point(mesh.prisms[element - tetrahedra], mesh.points);
}

inline std::vector<Vec3> element_centres(const MixedMesh& mesh) {
  std::vector<Vec3> centres(mesh.tetrahedra.size() + mesh.prisms.size());
  for (std::size_t e = 0; e < centres.size(); ++e) centres[e] = element_centre(mesh, e);
  return centres;
}

}  // namespace ostia::geometry
