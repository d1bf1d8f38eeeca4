#include "ostia/evaluation/surface_shape.h"
#include "ostia/experiments/smoothness.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace ostia::experiments {

using geometry::TriMesh;

namespace {

template <class Value>
Value value_at(const std::vector<double>& s, const std::vector<Value>& values, double at) {
  const std::size_t i = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), at) - s.begin()), 1, s.size() - 1);
  const double share = (at - s[i - 1]) / (s[i] - s[i - 1]);
  return (1.0 - share) * values[i - 1] + share * values[i];
}

/// Mean of values along a line about `at`, falling to nothing over `reach`; between two where none is there.
double mean_about(const std::vector<double>& s, const std::vector<double>& values, double at, double reach) {
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double near = std::max(0.0, 1.0 - std::abs(s[i] - at) / reach);
    sum += near * values[i];
    weight += near;
  }
  return weight > 0.0 ? sum / weight : value_at(s, values, at);
}

using WeightedSquare = std::pair<double, double>;

/// Without the greatest squares that weigh `less` together; NaN where nothing is left.
double trimmed_rms(std::vector<WeightedSquare> squares, double less) {
  std::sort(squares.begin(), squares.end(), std::greater<>());
  double sum = 0.0, weight = 0.0;
  for (const auto& [square, own] : squares) {
    const double kept = std::clamp(own - less, 0.0, own);
    less = std::max(0.0, less - own);
    sum += kept * square;
    weight += kept;
  }
  return weight > 0.0 ? std::sqrt(sum / weight) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<double> vertex_areas(const TriMesh& mesh) {
  std::vector<double> area(mesh.points.size(), 0.0);
  for (const geometry::Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Vec3 u = mesh.points[static_cast<std::size_t>(t[1])] - a;
    const Vec3 v = mesh.points[static_cast<std::size_t>(t[2])] - a;
    for (const std::int32_t p : t) area[static_cast<std::size_t>(p)] += u.cross(v).norm() / 6.0;
  }
  return area;
}

Bending bending_of(const TriMesh& mesh, const evaluation::Region& counts, const core::TaskContext& task) {
  const std::vector<evaluation::PrincipalCurvatures> bend = evaluation::curvatures(mesh, task);
  const std::vector<double> area = vertex_areas(mesh);
  Bending out;
  std::vector<WeightedSquare> lesser, greater;
  double weight = 0.0;
  for (std::size_t i = 0; i < bend.size(); ++i) {
    if (std::isnan(bend[i].kappa1) || (counts && !counts(mesh.points[i]))) continue;
    lesser.emplace_back(bend[i].kappa2 * bend[i].kappa2, area[i]);  // in evaluation the first is the greater
    greater.emplace_back(bend[i].kappa1 * bend[i].kappa1, area[i]);
    weight += area[i];
    ++out.vertices;
  }
  out.rms_kappa1 = trimmed_rms(lesser, 0.0);
  out.rms_kappa2 = trimmed_rms(greater, 0.0);
  out.trimmed_kappa1 = trimmed_rms(lesser, 0.01 * weight);
  out.trimmed_kappa2 = trimmed_rms(greater, 0.01 * weight);
  return out;
}

PhantomPlace place_of(const std::vector<PhantomTube>& tubes, const Vec3& point, double clear_mm) {
  constexpr double same_place_mm = 1e-6;
  const Vec3* nearest = nullptr;
  for (const PhantomTube& tube : tubes)
    for (const Vec3* end : {&tube.from, &tube.to})
      if (!nearest || (*end - point).norm() < (*nearest - point).norm()) nearest = end;
  if (!nearest || (*nearest - point).norm() > clear_mm) return PhantomPlace::tube;
  int ends = 0;
  for (const PhantomTube& tube : tubes)
    ends += ((tube.from - *nearest).norm() < same_place_mm) + ((tube.to - *nearest).norm() < same_place_mm);
  return ends > 1 ? PhantomPlace::joint : PhantomPlace::end;
}

geometry::VesselGraph network_of(const centerline::SkeletonGraph& skeleton, double step_mm) {
  geometry::VesselGraph out;
  std::map<std::int32_t, std::int32_t> point_of_node;
  for (const centerline::SkeletonNode& node : skeleton.nodes) {
    point_of_node[node.id] = static_cast<std::int32_t>(out.points.size());
    out.points.push_back(node.position);
  }
  for (const centerline::SkeletonEdge& edge : skeleton.edges) {
    const std::vector<double> s = geometry::abscissas(edge.points);
    const int pieces = std::max(1, static_cast<int>(std::ceil(s.back() / step_mm - 1e-9)));
    const double step = s.back() / pieces;
    std::int32_t before = point_of_node.at(edge.from);
    double radius = mean_about(s, edge.radius_mm, 0.0, step);
    for (int i = 1; i <= pieces; ++i) {
      const std::int32_t next =
          i == pieces ? point_of_node.at(edge.to) : static_cast<std::int32_t>(out.points.size());
      if (i < pieces) out.points.push_back(value_at(s, edge.points, i * step));
      const double then = mean_about(s, edge.radius_mm, i * step, step);
      out.edges.push_back({before, next, radius, then});
      before = next;
      radius = then;
    }
  }
  return out;
}

double distance_to_phantom(const std::vector<PhantomTube>& tubes, const Vec3& point) {
  const auto is_free = [&](const Vec3& end) { return place_of(tubes, end, 1e-6) == PhantomPlace::end; };
  double least = std::numeric_limits<double>::infinity();
  for (const PhantomTube& tube : tubes) {
    const double length = tube.length_mm();
    const Vec3 along = (tube.to - tube.from) / length;
    const double s = (point - tube.from).dot(along);
    const double across = (point - tube.from - s * along).norm() - tube.radius_mm;
    // Beyond a free end lies a flat lid, beyond a joint another tube: there the tube goes on as a ball.
    const double before = -s, behind = s - length;
    const bool at_start = before > behind;
    const double beyond = std::max(before, behind);
    const Vec3& end = at_start ? tube.from : tube.to;
    double d = 0.0;
    if (!is_free(end)) {
      d = beyond > 0.0 ? (point - end).norm() - tube.radius_mm : across;
    } else if (beyond > 0.0) {
      d = std::hypot(beyond, std::max(0.0, across));
    } else {
      d = across > 0.0 ? across : std::max(across, beyond);
    }
    least = std::min(least, d);
  }
  return least;
}

}  // namespace ostia::experiments
