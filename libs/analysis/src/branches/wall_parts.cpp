#include "branches/wall_parts.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace ostia::analysis {
namespace {

using geometry::TriMesh;

/// One part while it grows.
class PartMaker {
 public:
  PartMaker(const TriMesh& wall, std::int32_t group) : wall_(wall) { part_.group = group; }

  std::int32_t corner(std::int32_t point) {
    const auto [found, fresh] = corners_.try_emplace(point, next());
    if (fresh) add({{point, point, point}, {1.0, 0.0, 0.0}});
    return found->second;
  }
  /// On the side from a to b, at t; the same for the other triangle of the side.
  std::int32_t on_side(std::int32_t a, std::int32_t b, double t) {
    if (a > b) {
      std::swap(a, b);
      t = 1.0 - t;
    }
    constexpr int half = 32;
    const std::int64_t key = (static_cast<std::int64_t>(a) << half) | b;
    const auto [found, fresh] = sides_.try_emplace(key, next());
    if (fresh) add({{a, b, b}, {1.0 - t, t, 0.0}});
    return found->second;
  }
  std::int32_t within(const WallPoint& place) {
    add(place);
    return next() - 1;
  }
  void polygon(const std::vector<std::int32_t>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i)
      part_.mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  WallPart take() { return std::move(part_); }

 private:
  std::int32_t next() const { return static_cast<std::int32_t>(part_.sources.size()); }
  void add(const WallPoint& place) {
    geometry::Vec3 point = geometry::Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      point += place.weights[k] * wall_.points[static_cast<std::size_t>(place.points[k])];
    part_.mesh.points.push_back(point);
    part_.sources.push_back(place);
  }

  const TriMesh& wall_;
  WallPart part_;
  std::unordered_map<std::int32_t, std::int32_t> corners_;
  std::unordered_map<std::int64_t, std::int32_t> sides_;
};

class WallCutter {
 public:
  WallCutter(const TriMesh& wall, const BranchTubes& tubes)
      : wall_(wall), tubes_(tubes), groups_(tubes.nearest(wall.points)) {}

  std::vector<WallPart> cut() {
    for (const geometry::Triangle& t : wall_.triangles) cut(t);
    std::vector<WallPart> parts;
    for (auto& [group, maker] : makers_) parts.push_back(maker.take());
    return parts;
  }

 private:
  std::int32_t group(std::int32_t point) const { return groups_[static_cast<std::size_t>(point)]; }
  PartMaker& maker(std::int32_t of_group) {
    return makers_.try_emplace(of_group, wall_, of_group).first->second;
  }

  /// How far from a towards b the tube of a's branch is the deeper one.
  double border(std::int32_t a, std::int32_t b) const {
    const Vec3 &p = wall_.points[static_cast<std::size_t>(a)], &q = wall_.points[static_cast<std::size_t>(b)];
    const double here = tubes_.value(group(b), p) - tubes_.value(group(a), p);
    const double there = tubes_.value(group(a), q) - tubes_.value(group(b), q);
    const double sum = here + there;
    // Never at a corner: triangles keep an area.
    constexpr double least = 1e-6;
    return std::clamp(sum > 0.0 ? here / sum : 0.5, least, 1.0 - least);
  }

  void cut(const geometry::Triangle& t) {
    const std::int32_t a = group(t[0]), b = group(t[1]), c = group(t[2]);
    if (a == b && b == c) {
      PartMaker& m = maker(a);
      return m.polygon({m.corner(t[0]), m.corner(t[1]), m.corner(t[2])});
    }
    if (a != b && b != c && a != c) return cut_in_three(t);
    // The corner that is alone first.
    const std::size_t alone = b == c ? 0 : (a == c ? 1 : 2);
    const std::int32_t p = t[alone], q = t[(alone + 1) % 3], r = t[(alone + 2) % 3];
    const double to_q = border(p, q), to_r = border(p, r);
    PartMaker& one = maker(group(p));
    one.polygon({one.corner(p), one.on_side(p, q, to_q), one.on_side(p, r, to_r)});
    PartMaker& two = maker(group(q));
    two.polygon({two.on_side(p, q, to_q), two.corner(q), two.corner(r), two.on_side(p, r, to_r)});
  }

  void cut_in_three(const geometry::Triangle& t) {
    std::array<double, 3> at{};  // on the side from corner k to the next
    WallPoint middle{t, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = border(t[k], t[(k + 1) % 3]);
      middle.weights[k] += (1.0 - at[k]) / 3.0;
      middle.weights[(k + 1) % 3] += at[k] / 3.0;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      PartMaker& m = maker(group(t[k]));
      m.polygon({m.corner(t[k]), m.on_side(t[k], t[next], at[k]), m.within(middle),
                 m.on_side(t[last], t[k], at[last])});
    }
  }

  const TriMesh& wall_;
  const BranchTubes& tubes_;
  std::vector<std::int32_t> groups_;
  std::map<std::int32_t, PartMaker> makers_;
};

}  // namespace

std::vector<WallPart> wall_parts(const TriMesh& wall, const BranchTubes& tubes) {
  return WallCutter(wall, tubes).cut();
}

}  // namespace ostia::analysis
