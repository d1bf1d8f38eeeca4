#include "ostia/centerline/axis_fit.h"

#include "line_points.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/frame.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::centerline {
namespace {

using geometry::Vec2;
using geometry::Vec3;

using std::numbers::pi;

// A point of the wall seen from the axis: unfolded to abscissa, distance and direction in the normal plane.
struct WallSample {
  double abscissa = 0.0;
  double distance = 0.0;
  double angle = 0.0;  // of the direction
  Vec2 direction = Vec2::Zero();
};

// Foot of `query` on the line near its point `near`; false beyond the line's ends.
bool unfold(const std::vector<Vec3>& line, const std::vector<double>& s,
            const std::vector<geometry::Frame>& frames, std::size_t near, const Vec3& query,
            WallSample& sample) {
  double best2 = -1.0;
  bool beyond_end = false;
  for (const std::size_t i : {near > 0 ? near - 1 : near, near}) {
    if (i + 1 >= line.size()) continue;
    const Vec3 edge = line[i + 1] - line[i];
    const double free_t = edge.dot(query - line[i]) / edge.squaredNorm();
    const double t = std::clamp(free_t, 0.0, 1.0);
    const Vec3 offset = query - line[i] - t * edge;
    if (best2 >= 0.0 && offset.squaredNorm() >= best2) continue;
    best2 = offset.squaredNorm();
    beyond_end = (i == 0 && free_t < 0.0) || (i + 2 == line.size() && free_t > 1.0);
    const geometry::Frame& a = frames[i];
    const geometry::Frame& b = frames[i + 1];
    sample.abscissa = s[i] + t * (s[i + 1] - s[i]);
    sample.distance = std::sqrt(best2);
    sample.direction = Vec2(offset.dot((1.0 - t) * a.normal + t * b.normal),
                            offset.dot((1.0 - t) * a.binormal + t * b.binormal));
  }
  const double length = sample.direction.norm();
  if (best2 <= 0.0 || beyond_end || length <= 0.0) return false;
  sample.direction /= length;
  return true;
}

// Points of the wall that the axis sees, by abscissa.
std::vector<WallSample> unfold_wall(const Axis& axis, const std::vector<double>& s,
                                    const std::vector<geometry::Frame>& frames, const Wall& wall) {
  constexpr double reach = 1.4;  // radii
  geometry::Box3 box;
  for (std::size_t i = 0; i < axis.points.size(); ++i) {
    box.extend(axis.points[i] + Vec3::Constant(reach * axis.radius[i]));
    box.extend(axis.points[i] - Vec3::Constant(reach * axis.radius[i]));
  }
  const detail::LinePoints line(axis.points);
  const double farthest = 1.1 * reach * *std::max_element(axis.radius.begin(), axis.radius.end());
  const double within_squared = farthest * farthest * (1.0 + 1e-9);  // on the safe side of rounding
  constexpr std::size_t grain = 4096;
  const std::size_t count = wall.points().size();
  std::vector<std::vector<WallSample>> parts((count + grain - 1) / grain);
  core::parallel_chunks(count, grain, [&](std::size_t first, std::size_t last) {
    std::size_t run = 0;
    for (std::size_t k = first; k < last; ++k) {
      const Vec3& p = wall.points()[k];
      if (!box.contains(p)) continue;
      const std::int32_t found = line.nearest(p, within_squared, run);
      if (found < 0) continue;
      const auto near = static_cast<std::size_t>(found);
      if ((p - axis.points[near]).norm() > 1.1 * reach * axis.radius[near]) continue;
      WallSample sample;
      if (!unfold(axis.points, s, frames, near, p, sample)) continue;
      if (sample.distance > reach * axis.radius[near]) continue;
      sample.angle = std::atan2(sample.direction.y(), sample.direction.x());
      parts[first / grain].push_back(sample);
    }
  });
  std::vector<WallSample> samples;
  for (const auto& part : parts) samples.insert(samples.end(), part.begin(), part.end());
  std::stable_sort(samples.begin(), samples.end(),
                   [](const WallSample& a, const WallSample& b) { return a.abscissa < b.abscissa; });
  return samples;
}

// Half of the gap to the next sample on either side around the circle: the samples' density drops out of the
// fit. A wide gap (a branch leaves there) counts no more than three mean ones.
std::vector<double> angular_weights(const WallSample* samples, std::size_t count) {
  std::vector<std::pair<double, std::size_t>> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = {samples[i].angle, i};
  std::sort(order.begin(), order.end());
  const double mean_gap = 2.0 * pi / static_cast<double>(count);
  std::vector<double> weights(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count;
    double gap = order[j].first - order[i].first;
    if (j == 0) gap += 2.0 * pi;
    gap = std::min(gap, 3.0 * mean_gap);
    weights[order[i].second] += 0.5 * gap;
    weights[order[j].second] += 0.5 * gap;
  }
  return weights;
}

// The value that k of them are before when they are sorted; `scratch` may become anything.
double value_at_rank(const std::vector<double>& values, std::size_t k, std::vector<double>& scratch) {
  constexpr std::size_t few = 16;
  if (k >= few) {
    scratch = values;
    const auto place = scratch.begin() + static_cast<std::ptrdiff_t>(k);
    std::nth_element(scratch.begin(), place, scratch.end());
    return *place;
  }
  std::array<double, few> least{};  // so far, sorted: most values are passed over by one comparison
  std::size_t known = 0;
  for (const double value : values) {
    if (known > k && !(value < least[k])) continue;
    std::size_t at = known > k ? k : known++;
    for (; at > 0 && value < least[at - 1]; --at) least[at] = least[at - 1];
    least[at] = value;
  }
  return least[k];
}

// Of least squares with the rows (1, along, x, y). Sums as plain numbers, and nothing called between them:
// they stay in registers.
class NormalEquations {
 public:
  void add(double weight, double along, const Vec2& direction, double value) {
    const double x = direction.x(), y = direction.y();
    const double wa = weight * along, wx = weight * x, wy = weight * y, wv = weight * value;
    w_ += weight;
    wa_ += wa;
    wx_ += wx;
    wy_ += wy;
    waa_ += wa * along;
    wxa_ += wx * along;
    wya_ += wy * along;
    wxx_ += wx * x;
    wyx_ += wy * x;
    wyy_ += wy * y;
    v_ += wv;
    va_ += wv * along;
    vx_ += wv * x;
    vy_ += wv * y;
  }
  Eigen::Matrix4d matrix() const {
    Eigen::Matrix4d m;
    m << w_, wa_, wx_, wy_, wa_, waa_, wxa_, wya_, wx_, wxa_, wxx_, wyx_, wy_, wya_, wyx_, wyy_;
    return m;
  }
  Eigen::Vector4d right() const { return {v_, va_, vx_, vy_}; }

 private:
  double w_ = 0.0, wa_ = 0.0, wx_ = 0.0, wy_ = 0.0;
  double waa_ = 0.0, wxa_ = 0.0, wya_ = 0.0, wxx_ = 0.0, wyx_ = 0.0, wyy_ = 0.0;
  double v_ = 0.0, va_ = 0.0, vx_ = 0.0, vy_ = 0.0;
};

// Shift of the centre in the normal plane at abscissa s.
Vec2 fit_centre(const WallSample* samples, std::size_t count, double s, double radius) {
  constexpr double softness = 0.03;  // wall this part of the radius beyond the inscribed circle weighs 1/e
  constexpr double prior = 0.02;     // of all the wall's weight: keeps the centre where the wall says nothing
  const std::vector<double> angular = angular_weights(samples, count);
  Vec2 shift = Vec2::Zero();
  std::vector<double> distances(count), weights(count), along(count), scratch;
  for (std::size_t i = 0; i < count; ++i) along[i] = (samples[i].abscissa - s) / radius;
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < count; ++i)
      distances[i] = samples[i].distance - shift.dot(samples[i].direction);
    const double tenth = value_at_rank(distances, count / 10, scratch);
    for (std::size_t i = 0; i < count; ++i)
      weights[i] = angular[i] * std::exp(-(std::max(0.0, distances[i] - tenth) / (softness * radius)));
    NormalEquations equations;
    for (std::size_t i = 0; i < count; ++i)
      equations.add(weights[i], along[i], samples[i].direction, distances[i]);
    Eigen::Matrix4d normal = equations.matrix();
    normal.diagonal() += prior * 2.0 * pi * Eigen::Vector4d(1e-6, 1e-3, 1.0, 1.0);
    const Eigen::Vector4d solution = normal.ldlt().solve(equations.right());
    shift += solution.tail<2>();
  }
  return shift;
}

// Triangle normals weighted by the sine over the lengths of the edges at the vertex (Max 1999): exact on
// spheres, and second order on smooth surfaces however the triangles are shaped.
std::vector<Vec3> curvature_exact_normals(const geometry::TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const geometry::Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.points[static_cast<std::size_t>(t[k])];
      const Vec3 a = mesh.points[static_cast<std::size_t>(t[(k + 1) % 3])] - p;
      const Vec3 b = mesh.points[static_cast<std::size_t>(t[(k + 2) % 3])] - p;
      const double scale = a.squaredNorm() * b.squaredNorm();
      if (scale > 0.0) normals[static_cast<std::size_t>(t[k])] += a.cross(b) / scale;
    }
  for (Vec3& normal : normals) normal.normalize();
  return normals;
}

std::vector<Vec3> used_points(const geometry::TriMesh& mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const geometry::Triangle& t : mesh.triangles)
    for (const std::int32_t v : t) used[static_cast<std::size_t>(v)] = true;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) points.push_back(mesh.points[i]);
  return points;
}

Vec3 limited(const Vec3& from, const Vec3& to, double bound) {
  const Vec3 step = to - from;
  const double length = step.norm();
  return length > bound ? Vec3(from + step * (bound / length)) : to;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The length that the smoothing's cut is relative to: the radius, or where that is smaller the surface's
// spacing, below which the wall says nothing about the axis.
std::vector<double> local_scale(const Axis& axis, const std::vector<double>& spacing_mm) {
  const double floor = 0.1 * median(axis.radius);
  std::vector<double> scale(axis.radius.size());
  for (std::size_t i = 0; i < scale.size(); ++i) scale[i] = std::max({axis.radius[i], spacing_mm[i], floor});
  return scale;
}

}  // namespace

Axis at_equal_steps(const Axis& axis, double step_mm) {
  Axis distinct;
  for (std::size_t i = 0; i < axis.points.size(); ++i) {
    if (!distinct.points.empty() && (axis.points[i] - distinct.points.back()).norm() <= 1e-9) continue;
    distinct.points.push_back(axis.points[i]);
    distinct.radius.push_back(axis.radius[i]);
  }
  if (distinct.points.size() < 2) return distinct;
  const std::vector<double> s = geometry::abscissas(distinct.points);
  const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(s.back() / step_mm - 1e-9)));
  Axis result;
  std::size_t k = 0;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double at = s.back() * static_cast<double>(i) / static_cast<double>(pieces);
    while (k + 2 < s.size() && s[k + 1] < at) ++k;
    const double t = std::clamp((at - s[k]) / (s[k + 1] - s[k]), 0.0, 1.0);
    result.points.push_back((1.0 - t) * distinct.points[k] + t * distinct.points[k + 1]);
    result.radius.push_back((1.0 - t) * distinct.radius[k] + t * distinct.radius[k + 1]);
  }
  return result;
}

Axis smoothed_axis(const Axis& axis, double cutoff_radii, const std::vector<double>& bound_mm) {
  const std::size_t count = axis.points.size();
  if (count < 4 || cutoff_radii <= 0.0) return axis;
  const std::vector<double> s = geometry::abscissas(axis.points);
  const std::vector<double> scale = local_scale(axis, bound_mm);
  const double reference = median(scale);
  // A cubic smoothing spline passes 1/(1 + lambda w^4 d/weight) of a wave of angular frequency w at spacing
  // d.
  const double spacing = s.back() / static_cast<double>(count - 1);
  const double lambda = std::pow(cutoff_radii * reference / (2.0 * pi), 4) / spacing;
  std::vector<double> weights(count);
  for (std::size_t i = 0; i < count; ++i) weights[i] = std::pow(reference / scale[i], 4);
  Axis result = axis;
  for (int round = 0; round < 8; ++round) {
    result.points = geometry::smoothing_spline(s, axis.points, weights, lambda, true);
    bool within = true;
    for (std::size_t i = 0; i < count; ++i) {
      if ((result.points[i] - axis.points[i]).norm() <= bound_mm[i]) continue;
      within = false;
      weights[i] *= 4.0;
    }
    if (within) break;
  }
  for (std::size_t i = 0; i < count; ++i)
    result.points[i] = limited(axis.points[i], result.points[i], bound_mm[i]);
  return result;
}

Axis led_out_of(const std::vector<Vec3>& parent, const Axis& branch, double cutoff_radii) {
  if (parent.size() < 2 || branch.points.size() < 4 || cutoff_radii <= 0.0) return branch;
  std::vector<Vec3> points(parent.begin(), parent.end() - 1);
  const std::size_t lead = points.size();
  points.insert(points.end(), branch.points.begin(), branch.points.end());
  const std::vector<double> s = geometry::abscissas(points);
  const double scale = branch.radius.front();
  const double spacing = (s.back() - s[lead]) / static_cast<double>(branch.points.size() - 1);
  const double lambda = std::pow(cutoff_radii * scale / (2.0 * pi), 4) / spacing;
  std::vector<double> weights(points.size(), 1e6);
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const double t = std::min(1.0, (s[lead + i] - s[lead]) / (2.0 * scale));
    // Far from the joint the curve is the branch's own, already smooth.
    weights[lead + i] = t < 1.0 ? 0.01 + t * t : 1e6;
  }
  const std::vector<Vec3> smooth = geometry::smoothing_spline(s, points, weights, lambda, true);
  Axis result = branch;
  for (std::size_t i = 1; i + 1 < branch.points.size(); ++i) result.points[i] = smooth[lead + i];
  return result;
}

Wall::Wall(const geometry::TriMesh& wall, std::shared_ptr<const geometry::AabbTree> tree)
    : tree_(tree ? std::move(tree) : std::make_shared<const geometry::AabbTree>(wall)),
      cloud_(used_points(wall)) {
  const std::vector<Vec3> normals = curvature_exact_normals(wall);
  std::vector<double> sum(wall.points.size(), 0.0);
  std::vector<int> edges(wall.points.size(), 0);
  for (const geometry::Triangle& t : wall.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      const double length = (wall.points[a] - wall.points[b]).norm();
      sum[a] += length;
      sum[b] += length;
      ++edges[a];
      ++edges[b];
    }
  std::vector<std::int32_t> place(wall.points.size(), -1);
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    if (edges[i] == 0) continue;
    place[i] = static_cast<std::int32_t>(normals_.size());
    normals_.push_back(normals[i]);
    spacing_.push_back(sum[i] / edges[i]);
  }
  for (const geometry::Triangle& t : wall.triangles)
    triangles_.push_back({place[static_cast<std::size_t>(t[0])], place[static_cast<std::size_t>(t[1])],
                          place[static_cast<std::size_t>(t[2])]});
}

double Wall::distance(const Vec3& query) const {
  const geometry::SurfacePoint foot = tree_->closest(query);
  const geometry::Triangle& triangle = triangles_[static_cast<std::size_t>(foot.triangle)];
  Vec3 move = Vec3::Zero();
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto v = static_cast<std::size_t>(triangle[k]);
    move += foot.barycentric[static_cast<Eigen::Index>(k)] * (points()[v] - foot.point).dot(normals_[v]) *
            normals_[v];
    longest = std::max(longest, spacing_[v]);
  }
  // Normals across a sharp edge say nothing about curvature: no correction beyond what a sphere of this
  // radius would need.
  const double sagitta = foot.distance > 0.0 ? longest * longest / (2.0 * foot.distance) : 0.0;
  const double corrected = (limited(Vec3::Zero(), 0.5 * move, sagitta) + foot.point - query).norm();
  return corrected;
}

double Wall::inscribed_radius(const Vec3& centre) const {
  constexpr double widest_gap = 0.05;  // sparse points say little about the wall between them
  const double lower = distance(centre);
  const double upper = (cloud_.points()[static_cast<std::size_t>(cloud_.nearest(centre))] - centre).norm();
  return 0.5 * (std::min(lower, upper) + std::min(upper, (1.0 + widest_gap) * lower));
}

std::vector<double> Wall::spacing_along(const Axis& axis) const {
  std::vector<double> result(axis.points.size());
  core::parallel_for(axis.points.size(), 64, [&](std::size_t i) {
    const geometry::SurfacePoint foot = tree_->closest(axis.points[i]);
    double sum = 0.0;
    for (const std::int32_t v : triangles_[static_cast<std::size_t>(foot.triangle)])
      sum += spacing_[static_cast<std::size_t>(v)];
    result[i] = sum / 3.0;
  });
  return result;
}

Axis recentred_axis(const Axis& axis, const Wall& wall, const std::vector<double>& bound_mm,
                    double cutoff_radii, const core::TaskContext& task) {
  const std::size_t count = axis.points.size();
  if (count < 4) return axis;
  Axis current = axis;
  for (int round = 0; round < 2; ++round) {
    task.throw_if_cancelled();
    const std::vector<double> s = geometry::abscissas(current.points);
    const std::vector<geometry::Frame> frames = geometry::rotation_minimising_frames(current.points);
    const std::vector<WallSample> samples = unfold_wall(current, s, frames, wall);
    Axis moved = current;
    core::parallel_for(count - 2, 32, [&](std::size_t k) {
      const std::size_t i = k + 1;
      constexpr std::ptrdiff_t enough = 12;
      double half_width = bound_mm[i];
      auto first = samples.begin(), last = samples.begin();
      for (int attempt = 0; attempt < 4; ++attempt, half_width *= 1.6) {
        // Symmetric about the point, or a bend or taper would shift the centre.
        const double width = std::min({half_width, s[i], s.back() - s[i]});
        first = std::lower_bound(samples.begin(), samples.end(), s[i] - width,
                                 [](const WallSample& a, double b) { return a.abscissa < b; });
        last = std::upper_bound(first, samples.end(), s[i] + width,
                                [](double b, const WallSample& a) { return b < a.abscissa; });
        if (last - first >= enough) break;
      }
      if (last - first < enough) return;
      const Vec2 shift = fit_centre(&*first, static_cast<std::size_t>(last - first), s[i], current.radius[i]);
      const Vec3 to = current.points[i] + shift.x() * frames[i].normal + shift.y() * frames[i].binormal;
      moved.points[i] = limited(axis.points[i], to, bound_mm[i]);
    });
    current = smoothed_axis(moved, cutoff_radii, bound_mm);
  }
  for (std::size_t i = 0; i < count; ++i)
    current.points[i] = limited(axis.points[i], current.points[i], bound_mm[i]);
  return current;
}

}  // namespace ostia::centerline
