#include "fronts/fast_marching.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace ostia::segmentation::detail {
namespace {

struct Node {
  float time = kUnreached;
  bool settled = false;
};

class Marcher {
 public:
  Marcher(const imaging::ImageVolume& image, const SpeedModel& speed)
      : image_(image), speed_(speed), size_(image.geometry.size), nodes_(size_, Node{}) {}

  void start(const Vec3& source_mm);
  FrontTimes run(const FrontStop& stop, const core::TaskContext& task);

 private:
  float speed_at(const Voxel& v) const { return speed_(image_(v[0], v[1], v[2])); }
  void offer(const Voxel& v, float time);
  void settle_neighbours(const Voxel& v);
  float update(const Voxel& v, float speed) const;

  const imaging::ImageVolume& image_;
  SpeedModel speed_;
  std::array<std::int64_t, 3> size_;
  BlockGrid<Node> nodes_;
  std::priority_queue<Trial, std::vector<Trial>, std::greater<>> band_;
};

void Marcher::start(const Vec3& source_mm) {
  // A point source has infinite curvature: the voxels about it get their exact times.
  const Voxel centre = nearest_voxel(image_.geometry, source_mm);
  for (int k = -1; k <= 1; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const Voxel v{centre[0] + i, centre[1] + j, centre[2] + k};
        if (!inside(size_, v)) continue;
        const float speed = speed_at(v);
        if (speed <= 0.0F) continue;
        const double distance = (image_.geometry.world(Vec3(v[0], v[1], v[2])) - source_mm).norm();
        offer(v, static_cast<float>(distance / speed));
      }
    }
  }
}

void Marcher::offer(const Voxel& v, float time) {
  Node& node = nodes_.at(v);
  if (node.settled || time >= node.time) return;
  node.time = time;
  band_.push({time, v});
}

float Marcher::update(const Voxel& v, float speed) const {
  // Per axis (x - a_d)^2 w_d with the lesser of the two settled neighbours; second order where the next one
  // is settled, too.
  std::array<double, 3> value{};
  std::array<double, 3> weight{};
  int used = 0;
  for (int d = 0; d < 3; ++d) {
    double best = kUnreached;
    int side = 0;
    for (const int s : {-1, 1}) {
      Voxel n = v;
      n[d] += s;
      if (n[d] < 0 || n[d] >= size_[d]) continue;
      const Node& node = nodes_.get(n);
      if (node.settled && node.time < best) {
        best = node.time;
        side = s;
      }
    }
    if (side == 0) continue;
    double w = 1.0 / image_.geometry.spacing[d];
    Voxel far = v;
    far[d] += 2 * side;
    if (far[d] >= 0 && far[d] < size_[d]) {
      const Node& node = nodes_.get(far);
      if (node.settled && node.time <= best) {
        best = (4.0 * best - node.time) / 3.0;
        w *= 1.5;
      }
    }
    value[used] = best;
    weight[used++] = w * w;
  }
  // Ascending, so that an axis whose value is beyond the solution can be left out.
  for (int a = 1; a < used; ++a) {
    for (int b = a; b > 0 && value[b] < value[b - 1]; --b) {
      std::swap(value[b], value[b - 1]);
      std::swap(weight[b], weight[b - 1]);
    }
  }
  const double right = 1.0 / (static_cast<double>(speed) * speed);
  double a = 0.0;
  double b = 0.0;
  double c = -right;
  double solution = kUnreached;
  for (int n = 0; n < used && value[n] < solution; ++n) {
    a += weight[n];
    b += weight[n] * value[n];
    c += weight[n] * value[n] * value[n];
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) break;
    solution = (b + std::sqrt(discriminant)) / a;
  }
  return static_cast<float>(solution);
}

void Marcher::settle_neighbours(const Voxel& v) {
  for (int d = 0; d < 3; ++d) {
    for (const int s : {-1, 1}) {
      Voxel n = v;
      n[d] += s;
      if (n[d] < 0 || n[d] >= size_[d] || nodes_.get(n).settled) continue;
      const float speed = speed_at(n);
      if (speed > 0.0F) offer(n, update(n, speed));
    }
  }
}

FrontTimes Marcher::run(const FrontStop& stop, const core::TaskContext& task) {
  FrontTimes result{BlockGrid<float>(size_, kUnreached), {}, kUnreached};
  double limit = std::numeric_limits<double>::infinity();
  while (!band_.empty()) {
    const Trial next = band_.top();
    band_.pop();
    Node& node = nodes_.at(next.voxel);
    if (node.settled) continue;
    if (next.time > limit) break;
    node.settled = true;
    result.times.at(next.voxel) = next.time;
    result.order.push_back(next.voxel);
    if (result.order.size() % 4096 == 0) task.throw_if_cancelled();
    if (result.target_time == kUnreached &&
        std::find(stop.targets.begin(), stop.targets.end(), next.voxel) != stop.targets.end()) {
      result.target_time = next.time;
      if (!stop.all_voxels) limit = next.time * (1.0 + stop.overrun) + stop.overrun_mm;
    }
    settle_neighbours(next.voxel);
  }
  return result;
}

}  // namespace

float SpeedModel::operator()(std::int16_t hu) const {
  if (hu < range.lower || hu > range.upper) return 0.0F;
  const double width = lumen_hu - range.lower;
  const double part = width > 0.0 ? (hu - range.lower) / width : 1.0;
  return static_cast<float>(std::clamp(part, slowest, 1.0));
}

Voxel nearest_voxel(const imaging::Geometry& geometry, const Vec3& world_mm) {
  const Vec3 index = geometry.index(world_mm);
  Voxel v{};
  for (int d = 0; d < 3; ++d) {
    v[d] =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(std::llround(index[d]), 0, geometry.size[d] - 1));
  }
  return v;
}

FrontTimes march(const imaging::ImageVolume& image, const std::vector<Vec3>& sources_mm,
                 const SpeedModel& speed, const FrontStop& stop, const core::TaskContext& task) {
  Marcher marcher(image, speed);
  for (const Vec3& source : sources_mm) marcher.start(source);
  return marcher.run(stop, task);
}

}  // namespace ostia::segmentation::detail
