#include "ostia/evaluation/contour_pairs.h"

#include "sampled_distance.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/evaluation/contour_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace ostia::evaluation {
namespace {

using geometry::Box3;
using geometry::Contour;
using geometry::ContourSection;
using geometry::TriMesh;
using geometry::Vec2;

constexpr double step_mm = 0.1;        // between places of an outline that are asked for their distance
constexpr std::size_t few_strips = 6;  // beside those that are asked
constexpr double line_mm = 0.05;       // between the lines that the overlap is measured along

using Polygon = std::vector<Vec2>;

double area_of(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

double distance_to(const Polygon& polygon, const Vec2& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], along = polygon[(i + 1) % polygon.size()] - a;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    least = std::min(least, (p - a - t * along).squaredNorm());
  }
  return std::sqrt(least);
}

/// Sums over the line of `from`.
void add_distances(const Polygon& from, const Polygon& to, double& length, double& sum, double& max) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec2 a = from[i], along = from[(i + 1) % from.size()] - a;
    const double piece = along.norm();
    const int parts = std::max(1, static_cast<int>(std::ceil(piece / step_mm)));
    for (int k = 0; k < parts; ++k) {
      const double d = distance_to(to, a + (k + 0.5) / parts * along);
      length += piece / parts;
      sum += d * piece / parts;
      max = std::max(max, d);
    }
  }
}

std::vector<double> crossings(const Polygon& polygon, double v) {
  std::vector<double> at;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y() <= v) == (b.y() <= v)) continue;
    at.push_back(a.x() + (v - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(at.begin(), at.end());
  return at;
}

double shared_area(const Polygon& a, const Polygon& b) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec2& p : a) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  const int lines = std::max(1, static_cast<int>(std::ceil((high - low) / line_mm)));
  const double step = (high - low) / lines;
  double sum = 0.0;
  for (int k = 0; k < lines; ++k) {
    const double v = low + (k + 0.5) * step;
    const std::vector<double> in_a = crossings(a, v), in_b = crossings(b, v);
    for (std::size_t i = 0; i + 1 < in_a.size(); i += 2)
      for (std::size_t j = 0; j + 1 < in_b.size(); j += 2)
        sum += std::max(0.0, std::min(in_a[i + 1], in_b[j + 1]) - std::max(in_a[i], in_b[j]));
  }
  return sum * step;
}

void check_outline(const std::vector<Vec3>& points, const char* whose) {
  if (points.size() < 3)
    throw InvalidInput(std::string("the ") + whose + " outline has " + std::to_string(points.size()) +
                       " points; give at least three");
  for (const Vec3& p : points)
    if (!p.allFinite())
      throw InvalidInput(std::string("the ") + whose + " outline has a point that is not finite");
}

/// The part of a ruled surface between two neighbouring contours.
struct Strip {
  TriMesh mesh;
  Box3 box;
  DistanceSums sums;
  bool valid = false;
};

Strip strip_between(const ContourSection& of, std::size_t first, int points) {
  Strip strip;
  ContourSection two;
  two.section = of.section;
  two.observer = of.observer;
  two.contours = {of.contours[first], of.contours[first + 1]};
  if (two.contours[0].points.empty() || two.contours[1].points.empty()) return strip;
  if (geometry::find_fault(two)) return strip;
  strip.mesh = surface_of(two, {.caps = false, .points = points});
  for (const Vec3& p : strip.mesh.points) strip.box.extend(p);
  strip.valid = true;
  return strip;
}

TriMesh joined(std::span<const Strip> strips) {
  TriMesh all;
  for (const Strip& strip : strips) {
    const auto base = static_cast<std::int32_t>(all.points.size());
    all.points.insert(all.points.end(), strip.mesh.points.begin(), strip.mesh.points.end());
    for (const auto& t : strip.mesh.triangles)
      all.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  return all;
}

}  // namespace

OutlineDifference compare_outlines(const Contour& reference, const std::vector<Vec3>& result) {
  check_outline(reference.points, "reference's");
  check_outline(result, "result's");
  const Vec3 normal = geometry::contour_normal(reference);
  if (!(normal.norm() > 0.5)) throw InvalidInput("the reference's outline encloses no area");
  const Vec3 centre = geometry::contour_centroid(reference);
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  const auto flat = [&](const std::vector<Vec3>& points) {
    Polygon polygon;
    polygon.reserve(points.size());
    for (const Vec3& p : points) polygon.emplace_back((p - centre).dot(u), (p - centre).dot(v));
    return polygon;
  };
  const Polygon a = flat(reference.points), b = flat(result);
  OutlineDifference out;
  double length = 0.0, sum = 0.0;
  add_distances(a, b, length, sum, out.max_mm);
  add_distances(b, a, length, sum, out.max_mm);
  out.mean_mm = sum / length;
  out.reference_mm2 = area_of(a);
  out.result_mm2 = area_of(b);
  out.dice = 2.0 * shared_area(a, b) / (out.reference_mm2 + out.result_mm2);
  return out;
}

double AreaDistances::mean_mm() const {
  return area_mm2 > 0.0 ? sum / area_mm2 : std::numeric_limits<double>::quiet_NaN();
}
double AreaDistances::rms_mm() const {
  return area_mm2 > 0.0 ? std::sqrt(squares / area_mm2) : std::numeric_limits<double>::quiet_NaN();
}
AreaDistances& AreaDistances::operator+=(const AreaDistances& other) {
  area_mm2 += other.area_mm2;
  sum += other.sum;
  squares += other.squares;
  max_mm = std::max(max_mm, other.max_mm);
  return *this;
}

struct RuledComparison::Impl {
  ContourSection reference, result;
  RuledOptions options;
  int points = 0;
  std::vector<Strip> truth, wall;
  std::optional<geometry::AabbTree> truth_tree;
  bool first = true;

  /// Strips beside changed outlines made anew; where the wall was and is there.
  std::vector<Box3> renew(const std::vector<bool>& stale) {
    std::vector<Box3> moved(wall.size());
    core::parallel_for(wall.size(), 1, [&](std::size_t k) {
      if (!stale[k]) return;
      if (wall[k].valid) moved[k].extend(wall[k].box);
      wall[k] = strip_between(result, k, points);
      if (!wall[k].valid) return;
      moved[k].extend(wall[k].box);
      wall[k].sums = distances_to(*truth_tree, wall[k].mesh, options.sample_mm, {});
    });
    std::erase_if(moved, [](const Box3& box) { return box.isEmpty(); });
    return moved;
  }
  /// Distances of strips of the reference from the wall: from what is beside them, and from all of it where
  /// something farther off might be nearer.
  void ask_wall(std::vector<std::size_t> ask) {
    for (std::size_t beside = few_strips; !ask.empty(); beside = wall.size()) {
      const std::size_t low = ask.front() - std::min(ask.front(), beside);
      const std::size_t high = std::min(wall.size(), ask.back() + beside + 1);
      const TriMesh part = joined(std::span<const Strip>(wall).subspan(low, high - low));
      const geometry::AabbTree tree(part);
      core::parallel_for(ask.size(), 1, [&](std::size_t i) {
        truth[ask[i]].sums = distances_to(tree, truth[ask[i]].mesh, options.sample_mm, {});
      });
      const auto is_sure = [&](std::size_t k) {
        const double reach = truth[k].sums.max;
        for (std::size_t i = 0; i < wall.size(); ++i)
          if ((i < low || i >= high) && wall[i].valid &&
              truth[k].box.squaredExteriorDistance(wall[i].box) <= reach * reach)
            return false;
        return true;
      };
      std::erase_if(ask, is_sure);
    }
  }
  /// A place of the reference that is nearer to its old foot than to all that moved keeps its foot.
  bool is_concerned(const Strip& strip, const std::vector<Box3>& moved) const {
    const double reach = strip.sums.max + 1e-9;
    return std::any_of(moved.begin(), moved.end(), [&](const Box3& box) {
      return strip.box.squaredExteriorDistance(box) <= reach * reach;
    });
  }
};

RuledComparison::RuledComparison(ContourSection reference, const RuledOptions& options)
    : impl_(std::make_unique<Impl>()) {
  if (!(options.sample_mm > 0.0)) throw InvalidInput("a comparison needs a positive distance of samples");
  if (const auto fault = geometry::find_fault(reference))
    throw InvalidInput("section " + reference.section + " of " + reference.observer + ": " + *fault);
  Impl& m = *impl_;
  m.options = options;
  m.reference = std::move(reference);
  m.result = m.reference;
  for (const Contour& one : m.reference.contours)
    m.points = std::max(m.points, static_cast<int>(one.points.size()));
  for (std::size_t k = 0; k + 1 < m.reference.contours.size(); ++k)
    m.truth.push_back(strip_between(m.reference, k, m.points));
  m.wall.resize(m.truth.size());
  m.truth_tree.emplace(joined(m.truth));
}
RuledComparison::~RuledComparison() = default;
RuledComparison::RuledComparison(RuledComparison&&) noexcept = default;
RuledComparison& RuledComparison::operator=(RuledComparison&&) noexcept = default;

void RuledComparison::update(const std::vector<std::vector<Vec3>>& outlines,
                             const std::vector<std::size_t>& changed) {
  Impl& m = *impl_;
  if (outlines.size() != m.reference.contours.size())
    throw InvalidInput("section " + m.reference.section + " has " +
                       std::to_string(m.reference.contours.size()) + " contours, and " +
                       std::to_string(outlines.size()) + " outlines were given");
  std::vector<bool> stale(m.wall.size(), m.first);
  const auto take = [&](std::size_t i) {
    Contour& own = m.result.contours[i];
    own.points = outlines[i];
    if (own.points.size() >= 3 &&
        geometry::contour_normal(own).dot(geometry::contour_normal(m.reference.contours[i])) < 0.0)
      std::reverse(own.points.begin(), own.points.end());
    if (i > 0) stale[i - 1] = true;
    if (i < stale.size()) stale[i] = true;
  };
  if (m.first)
    for (std::size_t i = 0; i < outlines.size(); ++i) take(i);
  for (const std::size_t i : changed)
    if (i < outlines.size()) take(i);
  std::vector<bool> counted;
  for (const Strip& strip : m.wall) counted.push_back(strip.valid);
  const std::vector<Box3> moved = m.renew(stale);
  std::vector<std::size_t> ask;
  for (std::size_t k = 0; k < m.truth.size(); ++k)
    if (m.wall[k].valid && (m.first || !counted[k] || m.is_concerned(m.truth[k], moved))) ask.push_back(k);
  m.first = false;
  if (ask.empty()) return;
  m.ask_wall(ask);
}

AreaDistances RuledComparison::distances() const {
  AreaDistances out;
  const auto add = [&](const DistanceSums& sums) { out += {sums.area, sums.sum, sums.squares, sums.max}; };
  for (std::size_t k = 0; k < impl_->wall.size(); ++k) {
    if (!impl_->wall[k].valid) continue;
    add(impl_->wall[k].sums);
    add(impl_->truth[k].sums);
  }
  return out;
}

double RuledComparison::missing_mm() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < impl_->wall.size(); ++k)
    if (!impl_->wall[k].valid)
      sum += impl_->reference.contours[k + 1].s_mm - impl_->reference.contours[k].s_mm;
  return sum;
}

}  // namespace ostia::evaluation
