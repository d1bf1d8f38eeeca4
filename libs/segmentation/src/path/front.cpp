#include "path/front.h"

#include "fronts/fast_marching.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace ostia::segmentation::detail {
namespace {

struct FrontNode {
  float time = kUnreached;
  float length = 0.0F;
  bool settled = false;
};

class Front {
 public:
  explicit Front(TubeSpeed& speed)
      : speed_(speed), geometry_(speed.image().geometry), nodes_(geometry_.size, FrontNode{}) {}

  void start(const Vec3& source_mm);
  PathFront run(const PathFrontStop& stop, const core::TaskContext& task);

 private:
  void offer(const Voxel& v, float time, float length);
  FrontNode update(const Voxel& v) const;

  TubeSpeed& speed_;
  const imaging::Geometry& geometry_;
  BlockGrid<FrontNode> nodes_;
  std::priority_queue<Trial, std::vector<Trial>, std::greater<>> band_;
};

void Front::start(const Vec3& source_mm) {
  const Voxel centre = nearest_voxel(geometry_, source_mm);
  for (int n = 0; n < 27; ++n) {
    const Voxel v{centre[0] + n % 3 - 1, centre[1] + n / 3 % 3 - 1, centre[2] + n / 9 - 1};
    if (!inside(geometry_.size, v)) continue;
    const double distance = (geometry_.world(Vec3(v[0], v[1], v[2])) - source_mm).norm();
    offer(v, static_cast<float>(distance / speed_.speed(v)), static_cast<float>(distance));
  }
}

void Front::offer(const Voxel& v, float time, float length) {
  FrontNode& node = nodes_.at(v);
  if (node.settled || time >= node.time) return;
  node.time = time;
  node.length = length;
  band_.push({time, v});
}

FrontNode Front::update(const Voxel& v) const {
  struct Axis {
    double time, length, weight;
  };
  std::array<Axis, 3> axes{};
  std::size_t used = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    Axis best{kUnreached, 0.0, 1.0 / geometry_.spacing[static_cast<int>(d)]};
    best.weight *= best.weight;
    for (const int side : {-1, 1}) {
      Voxel n = v;
      n[d] += side;
      if (n[d] < 0 || n[d] >= geometry_.size[d]) continue;
      const FrontNode& node = nodes_.get(n);
      if (!node.settled || !(node.time < best.time)) continue;
      best.time = node.time;
      best.length = node.length;
    }
    if (!(best.time < kUnreached)) continue;
    std::size_t at = used++;  // ascending
    for (; at > 0 && best.time < axes[at - 1].time; --at) axes[at] = axes[at - 1];
    axes[at] = best;
  }
  const double slowness = 1.0 / static_cast<double>(speed_.speed(v));
  double a = 0.0, b = 0.0, c = -slowness * slowness, time = kUnreached;
  std::size_t n = 0;
  for (; n < used && axes[n].time < time; ++n) {
    a += axes[n].weight;
    b += axes[n].weight * axes[n].time;
    c += axes[n].weight * axes[n].time * axes[n].time;
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) break;
    time = (b + std::sqrt(discriminant)) / a;
  }
  double above = slowness, below = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double rise = axes[i].weight * std::max(0.0, time - axes[i].time);
    above += rise * axes[i].length;
    below += rise;
  }
  return {static_cast<float>(time), static_cast<float>(below > 0.0 ? above / below : 0.0), false};
}

PathFront Front::run(const PathFrontStop& stop, const core::TaskContext& task) {
  PathFront result{BlockGrid<float>(geometry_.size, kUnreached)};
  while (!band_.empty()) {
    const Trial next = band_.top();
    band_.pop();
    FrontNode& node = nodes_.at(next.voxel);
    if (node.settled) continue;
    node.settled = true;
    result.times.at(next.voxel) = next.time;
    result.length_mm = node.length;
    if (result.visited++ % 4096 == 0) {
      task.throw_if_cancelled();
      task.set_progress(std::min(1.0, result.length_mm / stop.max_length_mm));
    }
    if (stop.target(next.voxel)) {
      result.reached = next.voxel;
      result.end = PathFrontEnd::target;
      return result;
    }
    if (node.length > stop.max_length_mm) {
      result.end = PathFrontEnd::length;
      return result;
    }
    if (result.visited >= stop.most_voxels) {
      result.end = PathFrontEnd::voxels;
      return result;
    }
    for (std::size_t d = 0; d < 3; ++d) {
      for (const int side : {-1, 1}) {
        Voxel n = next.voxel;
        n[d] += side;
        if (n[d] < 0 || n[d] >= geometry_.size[d] || nodes_.get(n).settled) continue;
        if (stop.within && !stop.within(n)) continue;
        const FrontNode better = update(n);
        offer(n, better.time, better.length);
      }
    }
  }
  return result;
}

/// Arrival times between voxels. What the front did not reach counts as a little later than what it did.
class Times {
 public:
  Times(const imaging::Geometry& geometry, const PathFront& front) : geometry_(geometry), front_(front) {}

  float at(const Voxel& v) const { return inside(geometry_.size, v) ? front_.times.get(v) : kUnreached; }

  /// The gradient in voxel coordinates per mm, or zero where it is not known.
  Vec3 gradient(const Vec3& index) const {
    Voxel low{};
    Vec3 part;
    for (int d = 0; d < 3; ++d) {
      const double base = std::floor(index[d]);
      low[static_cast<std::size_t>(d)] = static_cast<std::int32_t>(base);
      part[d] = index[d] - base;
    }
    std::array<double, 8> t{};
    double latest = -1.0;
    for (int c = 0; c < 8; ++c) {
      t[static_cast<std::size_t>(c)] = at({low[0] + (c & 1), low[1] + (c >> 1 & 1), low[2] + (c >> 2)});
      if (t[static_cast<std::size_t>(c)] < kUnreached)
        latest = std::max(latest, t[static_cast<std::size_t>(c)]);
    }
    if (latest < 0.0) return Vec3::Zero();
    for (double& value : t)
      if (value == kUnreached) value = latest;
    Vec3 g = Vec3::Zero();
    for (int c = 0; c < 8; ++c) {
      for (int d = 0; d < 3; ++d) {
        double weight = (c >> d & 1) == 1 ? 1.0 : -1.0;
        for (int e = 0; e < 3; ++e)
          if (e != d) weight *= (c >> e & 1) == 1 ? part[e] : 1.0 - part[e];
        g[d] += weight * t[static_cast<std::size_t>(c)];
      }
    }
    return g.cwiseQuotient(geometry_.spacing);
  }

  /// The earliest of a voxel and its 26 neighbours.
  Voxel earliest(const Voxel& v) const {
    Voxel best = v;
    for (int n = 0; n < 27; ++n) {
      const Voxel w{v[0] + n % 3 - 1, v[1] + n / 3 % 3 - 1, v[2] + n / 9 - 1};
      if (at(w) < at(best)) best = w;
    }
    return best;
  }

 private:
  const imaging::Geometry& geometry_;
  const PathFront& front_;
};

Vec3 centre_of(const imaging::Geometry& geometry, const Voxel& v) {
  return geometry.world(Vec3(v[0], v[1], v[2]));
}

}  // namespace

PathFront run_front(TubeSpeed& speed, const Vec3& from_mm, const PathFrontStop& stop,
                    const core::TaskContext& task) {
  Front front(speed);
  front.start(from_mm);
  return front.run(stop, task);
}

std::vector<Vec3> trace_back(const imaging::Geometry& geometry, const PathFront& front,
                             const Vec3& source_mm) {
  const Times times(geometry, front);
  const double step = geometry.spacing.minCoeff() / 3.0;
  const double near = 1.5 * geometry.spacing.maxCoeff();
  const auto steps = static_cast<std::size_t>(20.0 * front.length_mm / step) + 1000;
  std::vector<Vec3> points{centre_of(geometry, front.reached)};
  Voxel lowest = front.reached;  // every few steps the way must have come to an earlier voxel
  while (points.size() < steps && (points.back() - source_mm).norm() > near) {
    Vec3 p = points.back();
    for (int n = 0; n < 9; ++n) {
      const Vec3 g = times.gradient(geometry.index(p));
      if (g.norm() < 1e-9) break;
      p -= step * (geometry.direction * g.normalized());
      points.push_back(p);
      if ((p - source_mm).norm() <= near) break;
    }
    const Voxel here = nearest_voxel(geometry, p);
    if (times.at(here) < times.at(lowest)) {
      lowest = here;
      continue;
    }
    // Caught in a hollow of the interpolant: on from voxel to voxel.
    const Voxel next = times.earliest(lowest);
    if (next == lowest) break;
    lowest = next;
    points.push_back(centre_of(geometry, next));
  }
  points.push_back(source_mm);
  return points;
}

}  // namespace ostia::segmentation::detail
