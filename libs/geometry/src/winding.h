#pragma once
/// \file The generalised winding number over a bounding-volume hierarchy.

#include "bvh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::geometry::detail {

using CornerPoints = std::array<Vec3, 3>;

/// What each node's triangles look like from afar: a dipole with its first and second moments (Barill et al.
/// 2018). The derivatives of the dipole's field are symmetric in all their indices, so the symmetric parts of
/// the moments suffice.
class WindingTree {
 public:
  WindingTree() = default;
  /// `triangles` in the order of the leaves.
  WindingTree(const Bvh& bvh, const std::vector<CornerPoints>& triangles);

  double at(const Vec3& query, const std::vector<CornerPoints>& triangles) const;

 private:
  // Three cache lines; the first suffices for a node that is too near.
  struct alignas(64) Moments {
    Vec3 center = Vec3::Zero();  // mean by area
    double far2 = 0.0;           // squared distance from which the expansion is used
    std::int32_t next = 0;       // as in the hierarchy's node
    std::int32_t count = 0;
    Vec3 dipole = Vec3::Zero();  // sum of area times unit normal
    double first[6] = {};        // of e = x - center times area normal: xx yy zz xy yz zx
    double second[10] = {};      // of e e times area normal: xxx yyy zzz xxy yyz zzx xyy yzz zxx xyz
  };
  static void add(Moments& moments, const Vec3& offset, const Vec3& dipole);
  static void add_shifted(Moments& moments, const Vec3& offset, const Moments& part);

  std::vector<Moments> moments_;  // one a node
};

}  // namespace ostia::geometry::detail
