#include "ostia/solver/section.h"

#include "ostia/core/error.h"

#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace ostia::solver {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

/// Takes the facets of one face over with points of their own.
class Collector {
 public:
  Collector(const MixedMesh& mesh, Section& section) : mesh_(mesh), section_(section) {}

  void add(const std::int32_t* corners, std::size_t count) {
    std::array<std::int32_t, 4> facet = {-1, -1, -1, -1};
    for (std::size_t i = 0; i < count; ++i) facet[i] = local(corners[i]);
    section_.facets.push_back(facet);
    const auto p = [&](std::size_t i) { return section_.points[static_cast<std::size_t>(facet[i])]; };
    const Vec3 first = (p(1) - p(0)).cross(p(2) - p(0)) / 2.0;
    if (count == 3) {
      section_.area_vectors_mm2.push_back(first);
      section_.centres.emplace_back((p(0) + p(1) + p(2)) / 3.0);
      return;
    }
    const Vec3 second = (p(2) - p(0)).cross(p(3) - p(0)) / 2.0;
    const double a = first.norm(), b = second.norm();
    section_.area_vectors_mm2.push_back(first + second);
    section_.centres.emplace_back((a * (p(0) + p(1) + p(2)) + b * (p(0) + p(2) + p(3))) / (3.0 * (a + b)));
  }

 private:
  std::int32_t local(std::int32_t point) {
    const auto [place, fresh] = places_.emplace(point, static_cast<std::int32_t>(section_.points.size()));
    if (fresh) section_.points.push_back(mesh_.points[static_cast<std::size_t>(point)]);
    return place->second;
  }
  const MixedMesh& mesh_;
  Section& section_;
  std::map<std::int32_t, std::int32_t> places_;
};

}  // namespace

double Section::diameter_mm() const {
  return 2.0 * std::sqrt(area_mm2 / std::numbers::pi);
}

Section section_of(const MixedMesh& mesh, std::int32_t face_id) {
  Section section;
  Collector collector(mesh, section);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.triangle_face_ids[i] == face_id) collector.add(mesh.triangles[i].data(), 3);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    if (mesh.quad_face_ids[i] == face_id) collector.add(mesh.quads[i].data(), 4);
  if (section.facets.empty())
    throw InvalidInput("the mesh's face " + std::to_string(face_id) + " has no facets");
  Vec3 sum = Vec3::Zero();
  double areas = 0.0;
  for (const Vec3& area : section.area_vectors_mm2) {
    sum += area;
    areas += area.norm();
  }
  if (!(sum.norm() > 0.5 * areas))
    throw GeometryError("the mesh's face " + std::to_string(face_id) +
                        " is no open section of a vessel: its parts look in opposite directions");
  section.area_mm2 = sum.norm();
  section.normal = sum.normalized();
  return section;
}

}  // namespace ostia::solver
