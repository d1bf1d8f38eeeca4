#include "registration_parts.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

namespace ostia::motion {

using geometry::TriMesh;
using geometry::Vec3;

void refuse_registration(const std::string& what) {
  throw InvalidInput("cannot register a surface: " + what);
}

void check_cage_options(int depth, double margin, double max_angle_deg, const HyperelasticWeights& energy) {
  const auto bad = [](double v, double low, double high) { return !(v >= low && v <= high); };
  if (depth < 1 || depth > 5) refuse_registration("the depth must be 1 to 5");
  if (bad(margin, 0.01, 10.0)) refuse_registration("the margin must be 0.01 to 10");
  if (bad(max_angle_deg, 1e-3, 180.0))
    refuse_registration("the angle between normals must be above 0, up to 180 degrees");
  for (const double w : {energy.length, energy.area, energy.volume})
    if (bad(w, 0.0, 1e9)) refuse_registration("the energy's weights must be 0 to 1e9");
  if (energy.length <= 0.0) refuse_registration("the weight of lengths must be positive");
}

void check_surfaces(const TriMesh& source, const TriMesh& target) {
  if (source.triangles.empty() || target.triangles.empty())
    refuse_registration("one of the two has no triangles");
}

std::vector<geometry::CagePoint> cage_points(const geometry::CageGrid& grid,
                                             const std::vector<Vec3>& points) {
  std::vector<geometry::CagePoint> places;
  places.reserve(points.size());
  for (const Vec3& p : points) places.push_back(cage_point(grid, p));
  return places;
}

std::vector<Vec3> carried_points(const std::vector<geometry::CagePoint>& places,
                                 const geometry::CageGrid& grid, const std::vector<Vec3>& control_points) {
  std::vector<Vec3> points(places.size());
  core::parallel_for(places.size(), 1024,
                     [&](std::size_t i) { points[i] = carried(grid, places[i], control_points); });
  return points;
}

TriMesh carried_mesh(const TriMesh& mesh, const std::vector<geometry::CagePoint>& places,
                     const geometry::CageGrid& grid, const std::vector<Vec3>& control_points) {
  return {carried_points(places, grid, control_points), mesh.triangles};
}

void tell_pairs(const TriMesh& source, const std::vector<SurfacePair>& pairs, RegistrationReport& report) {
  const std::vector<double> areas = SurfaceFrames(source).point_areas;
  double all = 0.0, paired = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < source.points.size(); ++i) {
    all += areas[i];
    if (pairs[i].weight <= 0.0) continue;
    paired += areas[i];
    sum += areas[i] * pairs[i].distance;
  }
  report.paired_share = paired / all;
  report.mean_distance_mm = paired > 0.0 ? sum / paired : 0.0;
}

}  // namespace ostia::motion
