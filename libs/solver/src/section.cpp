#include "ostia/solver/section.h"

#include "facets.h"

#include "ostia/core/error.h"

#include <cmath>
#include <numbers>
#include <span>
#include <string>

namespace ostia::solver {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

/// Takes the facets of one face over with points of their own.
class Collector {
 public:
  Collector(const MixedMesh& mesh, Section& section) : section_(section), local_(mesh, section.points) {}

  void add(std::span<const std::int32_t> corners) {
    std::array<std::int32_t, 4> facet = {-1, -1, -1, -1};
    for (std::size_t i = 0; i < corners.size(); ++i) facet[i] = local_(corners[i]);
    section_.facets.push_back(facet);
    const auto p = [&](std::size_t i) { return section_.points[static_cast<std::size_t>(facet[i])]; };
    const Vec3 first = (p(1) - p(0)).cross(p(2) - p(0)) / 2.0;
    if (corners.size() == 3) {
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
  Section& section_;
  OwnPoints local_;
};

}  // namespace

double Section::diameter_mm() const {
  return 2.0 * std::sqrt(area_mm2 / std::numbers::pi);
}

Section section_of(const MixedMesh& mesh, std::int32_t face_id) {
  Section section;
  Collector collector(mesh, section);
  for_facets_of(mesh, face_id, [&](const auto& corners) { collector.add(corners); });
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
