#include "ostia/centerline/eikonal.h"

#include "earliest_first.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

constexpr double infinity = std::numeric_limits<double>::infinity();
// In larger polygons only the corners next to the newly accepted one are paired with it, which keeps the work
// linear.
constexpr std::int32_t all_pairs_up_to = 6;

std::size_t index(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

// Where on the segment from a to b the sum of T, linear between, and slowness times the distance to x is
// least, in [0, 1].
double best_on_segment(const Vec3& a, const Vec3& b, double time_a, double time_b, const Vec3& x,
                       double slowness) {
  const Vec3 edge = b - a;
  const double along = edge.dot(x - a), length2 = edge.squaredNorm();
  // The least is never on the side of the foot where T is higher: no root is needed to tell these.
  if (along <= 0.0 && time_b >= time_a) return 0.0;
  if (along > (1.0 + 1e-12) * length2 && time_b <= time_a) return 1.0;
  const double length = std::sqrt(length2);
  if (length <= 0.0) return time_a <= time_b ? 0.0 : 1.0;
  const double slope = (time_b - time_a) / (length * slowness);
  if (slope >= 1.0) return 0.0;
  if (slope <= -1.0) return 1.0;
  const double foot = along / length;
  const double height = std::sqrt(std::max(0.0, (x - a).squaredNorm() - foot * foot));
  return std::clamp((foot - height * slope / std::sqrt(1.0 - slope * slope)) / length, 0.0, 1.0);
}

// Whether the least sum of `best_on_segment` is no less than `limit`, told without a root. Where the least
// lies within the segment it is time_a + slope * foot + height * sqrt(slowness^2 - slope^2). On the safe side
// of rounding: a sum that is less is never refused.
bool comes_too_late(const Vec3& a, const Vec3& b, double time_a, double time_b, const Vec3& x,
                    double slowness, double limit) {
  constexpr double rounding = 1e-12;
  const Vec3 edge = b - a, to = x - a;
  const double length2 = edge.squaredNorm(), distance2 = to.squaredNorm(), along = edge.dot(to);
  if (!(length2 > 0.0)) return false;
  const double rise = time_b - time_a, slowness2 = slowness * slowness;
  const double share = along / length2;
  const double across = slowness2 - rise * rise / length2 - rounding * slowness2;
  const double height2 = distance2 - along * share - rounding * distance2;
  if (!(across > 0.0) || !(height2 > 0.0)) return false;
  const double left = limit - time_a - rise * share + rounding * limit;
  return left <= 0.0 || height2 * across * (1.0 - 1e-9) >= left * left;
}

class March {
 public:
  March(const InnerVoronoi& diagram, std::int32_t source)
      : diagram_(diagram),
        nodes_(diagram.points.size()),
        accepted_(diagram.points.size(), 0),
        faces_(diagram.polygon_count()) {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const std::int32_t first = diagram.polygon_first[i];
      faces_[i] = {first, diagram.polygon_first[i + 1] - first};
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      nodes_[i].point = diagram.points[i];
      nodes_[i].slowness = 1.0 / std::max(diagram.radius[i], 1e-12);
    }
    nodes_[index(source)].time = 0.0;
    waiting_.push(0.0, source);
  }

  ArrivalTimes run(const std::vector<std::int32_t>& targets, const core::TaskContext& task) {
    std::vector<std::int32_t> wanted = targets;
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    std::size_t missing = targets.empty() ? nodes_.size() + 1 : wanted.size();
    std::size_t count = 0;
    while (!waiting_.empty() && missing > 0) {
      const std::int32_t point = waiting_.pop().point;
      if (accepted(point)) continue;
      accepted_[index(point)] = 1;
      if (std::binary_search(wanted.begin(), wanted.end(), point)) --missing;
      if (++count % 4096 == 0) {
        task.throw_if_cancelled();
        task.set_progress(static_cast<double>(count) / static_cast<double>(nodes_.size()));
      }
      spread_from(point);
    }
    return times();
  }

 private:
  struct Face {
    std::int32_t first = 0;  // of its corners
    std::int32_t ahead = 0;  // corners that the front has not passed
  };
  // All that is asked of a point that the front has not passed lies together.
  struct alignas(64) Node {
    Vec3 point = Vec3::Zero();
    double slowness = 0.0;
    double time = infinity;
    std::int32_t parent = -1;
    std::int32_t offered_by = -1;  // the last point that offered a time along an edge or chord
  };

  Node& node(std::int32_t i) { return nodes_[index(i)]; }
  bool accepted(std::int32_t i) const { return accepted_[index(i)] != 0; }

  ArrivalTimes times() const {
    ArrivalTimes result;
    result.time.reserve(nodes_.size());
    result.parent.reserve(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      result.time.push_back(accepted_[i] != 0 ? nodes_[i].time : infinity);
      result.parent.push_back(nodes_[i].parent);
    }
    return result;
  }

  void offer(Node& to, std::int32_t point, double time, std::int32_t parent) {
    if (time >= to.time) return;
    to.time = time;
    to.parent = parent;
    waiting_.push(time, point);
  }

  // Once from each point, though several polygons may have both.
  void offer_along_edge(std::int32_t from, std::int32_t to) {
    const Node& start = node(from);
    Node& end = node(to);
    if (end.offered_by == from) return;
    end.offered_by = from;
    const double slowness = 0.5 * (start.slowness + end.slowness);
    const double squared = (end.point - start.point).squaredNorm();
    const double left = end.time - start.time + 1e-12 * end.time;  // on the safe side of rounding
    if (slowness * slowness * squared > left * left) return;       // later, told without a root
    offer(end, to, start.time + slowness * std::sqrt(squared), from);
  }

  void offer_across(std::int32_t v, std::int32_t w, std::int32_t to) {
    const Node &a = node(v), &b = node(w);
    Node& x = node(to);
    const double base_slowness = 0.5 * (a.slowness + b.slowness);
    const double slowness = 0.5 * (base_slowness + x.slowness);
    if (comes_too_late(a.point, b.point, a.time, b.time, x.point, slowness, x.time)) return;
    const double t = best_on_segment(a.point, b.point, a.time, b.time, x.point, slowness);
    if (t <= 0.0 || t >= 1.0) return;
    const double time =
        a.time + t * (b.time - a.time) + slowness * (x.point - a.point - t * (b.point - a.point)).norm();
    // Round-off must not let a front arrive before the points it comes from.
    offer(x, to, std::max({time, a.time, b.time}), t < 0.5 ? v : w);
  }

  // To the corners that the front has not passed, along edges and chords from the point, and across the
  // polygon from it and each of those that it has.
  void spread_to_all(const std::int32_t* corners, std::int32_t size, std::int32_t point) {
    std::array<std::int32_t, all_pairs_up_to> passed;
    std::size_t count = 0;
    for (std::int32_t k = 0; k < size; ++k)
      if (corners[k] != point && accepted(corners[k])) passed[count++] = corners[k];
    for (std::int32_t i = 0; i < size; ++i) {
      if (accepted(corners[i])) continue;
      offer_along_edge(point, corners[i]);
      for (std::size_t k = 0; k < count; ++k) offer_across(point, passed[k], corners[i]);
    }
  }

  void spread_from_first(const std::int32_t* corners, std::int32_t size, std::int32_t point) {
    for (std::int32_t i = 0; i < size; ++i)
      if (corners[i] != point) offer_along_edge(point, corners[i]);
  }

  void spread_beside(const std::int32_t* corners, std::int32_t size, std::int32_t point) {
    std::int32_t place = 0;
    while (corners[place] != point) ++place;
    const std::array beside{corners[(place + 1) % size], corners[(place + size - 1) % size]};
    for (std::int32_t i = 0; i < size; ++i) {
      if (accepted(corners[i])) continue;
      offer_along_edge(point, corners[i]);
      for (const std::int32_t next : beside)
        if (next != point && accepted(next)) offer_across(point, next, corners[i]);
    }
  }

  void spread_in_polygon(std::size_t polygon, std::int32_t point) {
    Face& face = faces_[polygon];
    const std::int32_t ahead = --face.ahead;
    if (ahead == 0) return;
    const std::int32_t size = diagram_.polygon_first[polygon + 1] - face.first;
    const std::int32_t* corners = diagram_.corners.data() + face.first;
    if (ahead + 1 == size)
      spread_from_first(corners, size, point);
    else if (size <= all_pairs_up_to)
      spread_to_all(corners, size, point);
    else
      spread_beside(corners, size, point);
  }

  void spread_from(std::int32_t point) {
    for (const std::int32_t neighbour : diagram_.links[index(point)])
      if (neighbour >= 0 && !accepted(neighbour)) offer_along_edge(point, neighbour);
    for (std::int32_t k = diagram_.incidence_first[index(point)];
         k < diagram_.incidence_first[index(point) + 1]; ++k)
      spread_in_polygon(index(diagram_.incidence[index(k)]), point);
  }

  const InnerVoronoi& diagram_;
  std::vector<Node> nodes_;
  std::vector<std::uint8_t> accepted_;  // apart: small enough to stay near
  std::vector<Face> faces_;             // of polygons
  EarliestFirst waiting_;               // superseded entries stay and are passed over
};

// A place on the diagram: at point `a` (b < 0), or between points a and b of a polygon's edge.
struct Place {
  std::int32_t a = -1, b = -1;
  Vec3 position = Vec3::Zero();
  double time = 0.0;
  double radius = 0.0;
};

class Descent {
 public:
  Descent(const InnerVoronoi& diagram, const ArrivalTimes& arrival) : diagram_(diagram), arrival_(arrival) {}

  Place at(std::int32_t point) const {
    return {point, -1, diagram_.points[index(point)], arrival_.time[index(point)],
            diagram_.radius[index(point)]};
  }

  Place next(const Place& from) const {
    Place best;
    double best_slope = 0.0;
    if (from.b < 0)
      for (const std::int32_t neighbour : diagram_.links[index(from.a)])
        if (neighbour >= 0) consider(from, at(neighbour), best, best_slope);
    for (std::int32_t k = diagram_.incidence_first[index(from.a)];
         k < diagram_.incidence_first[index(from.a) + 1]; ++k) {
      const std::int32_t polygon = diagram_.incidence[index(k)];
      if (from.b < 0 || has_corner(polygon, from.b)) search_polygon(polygon, from, best, best_slope);
    }
    return best.a >= 0 ? best : fall_back(from);
  }

  // From a flat spot of the interpolated T back to the points, whose times fall along the parents by
  // construction.
  Place fall_back(const Place& from) const {
    if (from.b < 0) return at(arrival_.parent[index(from.a)]);
    return at(arrival_.time[index(from.a)] < arrival_.time[index(from.b)] ? from.a : from.b);
  }

 private:
  bool has_corner(std::int32_t polygon, std::int32_t point) const {
    const auto first = diagram_.corners.begin() + diagram_.polygon_first[index(polygon)];
    const auto last = diagram_.corners.begin() + diagram_.polygon_first[index(polygon) + 1];
    return std::find(first, last, point) != last;
  }

  static void consider(const Place& from, const Place& to, Place& best, double& best_slope) {
    if (!(to.time < from.time)) return;
    const double slope = (from.time - to.time) / std::max((to.position - from.position).norm(), 1e-12);
    if (slope <= best_slope) return;
    best_slope = slope;
    best = to;
  }

  void search_polygon(std::int32_t polygon, const Place& from, Place& best, double& best_slope) const {
    const std::int32_t* corners = diagram_.corners.data() + diagram_.polygon_first[index(polygon)];
    const std::int32_t size =
        diagram_.polygon_first[index(polygon) + 1] - diagram_.polygon_first[index(polygon)];
    const double slowness = 1.0 / std::max(from.radius, 1e-12);
    for (std::int32_t i = 0; i < size; ++i) {
      const std::int32_t v = corners[i], w = corners[i + 1 < size ? i + 1 : 0];
      const double time_v = arrival_.time[index(v)], time_w = arrival_.time[index(w)];
      if (!std::isfinite(time_v)) continue;
      consider(from, at(v), best, best_slope);
      if (!std::isfinite(time_w) || touches(from, v, w)) continue;
      const Vec3 &a = diagram_.points[index(v)], &b = diagram_.points[index(w)];
      const double t = best_on_segment(a, b, time_v, time_w, from.position, slowness);
      if (t <= 0.0 || t >= 1.0) continue;
      const double radius = (1.0 - t) * diagram_.radius[index(v)] + t * diagram_.radius[index(w)];
      consider(from, {v, w, a + t * (b - a), time_v + t * (time_w - time_v), radius}, best, best_slope);
    }
  }

  // Whether `from` lies on the edge of v and w, where nothing is gained by a shorter step along it.
  static bool touches(const Place& from, std::int32_t v, std::int32_t w) {
    if (from.b < 0) return from.a == v || from.a == w;
    return (from.a == v && from.b == w) || (from.a == w && from.b == v);
  }

  const InnerVoronoi& diagram_;
  const ArrivalTimes& arrival_;
};

}  // namespace

ArrivalTimes arrival_times(const InnerVoronoi& diagram, std::int32_t source,
                           const std::vector<std::int32_t>& targets, const core::TaskContext& task) {
  const auto valid = [&](std::int32_t i) { return i >= 0 && index(i) < diagram.points.size(); };
  if (!valid(source) || !std::all_of(targets.begin(), targets.end(), valid))
    throw InvalidInput(
        "arrival times: the source or a target is no point of the Voronoi diagram, which has " +
        std::to_string(diagram.points.size()) + " points");
  return March(diagram, source).run(targets, task);
}

DiagramPath descend(const InnerVoronoi& diagram, const ArrivalTimes& arrival, std::int32_t target) {
  if (target < 0 || index(target) >= arrival.time.size() || !std::isfinite(arrival.time[index(target)]))
    throw GeometryError("descent: the front did not reach point " + std::to_string(target) +
                        " of the Voronoi diagram");
  const Descent descent(diagram, arrival);
  DiagramPath path;
  Place place = descent.at(target);
  while (true) {
    path.points.push_back(place.position);
    path.radius.push_back(place.radius);
    if (place.time <= 0.0) break;
    if (place.b < 0 && arrival.parent[index(place.a)] < 0) break;
    // More steps than points can only be ever smaller steps around one spot: on by the parents.
    place = path.points.size() <= diagram.points.size() ? descent.next(place) : descent.fall_back(place);
  }
  return path;
}

}  // namespace ostia::centerline
