#pragma once
/// \file What the surface around a joint is: the union of the vessels that meet there, with rounded crotches.

#include "tubes.h"

#include <vector>

namespace ostia::reconstruction {

/// The end of a branch at a joint.
struct Slot {
  std::int32_t tube = 0;
  bool distal = false;            ///< the branch arrives here
  Vec3 direction = Vec3::Zero();  ///< unit, away from the joint
  double radius = 0.0;            ///< near the joint
  double reach = 0.0;             ///< how far along the branch the joint may go, mm
  std::int32_t group = 0;         ///< the trunk's two ends are one vessel
};

struct FieldValue {
  double distance = 0.0;  ///< mm, negative inside; near enough to the Euclidean one beside the surface
  Vec3 gradient = Vec3::Zero();
};

class JointField {
 public:
  JointField(const std::vector<Tube>& tubes, const std::vector<Slot>& slots, double blend);
  FieldValue operator()(const Vec3& point, double scale) const;
  /// The nearest point of the surface along the gradient, all radii `scale` times as large.
  Vec3 onto(Vec3 point, double scale) const;
  /// Where a ray from the joint's centre leaves the union.
  double exit(const Vec3& centre, const Vec3& direction, double scale) const;

 private:
  struct Cone {
    Vec3 a = Vec3::Zero(), axis = Vec3::Zero();
    double ra = 0.0, rb = 0.0, inverse_square = 0.0;
    double near = 0.0, far = 0.0;  ///< where it begins and ends, along the branch from the joint
  };
  /// The cones of one branch, from the joint on.
  struct Run {
    std::size_t first = 0, last = 0;
    double widest = 0.0;
    bool distal = false;
  };
  struct Group {
    std::vector<Run> runs;
    double radius = 0.0;
  };
  struct Nearest {
    double value, length;
    Vec3 away;
  };
  Run add_run(const Tube& tube, bool distal, double most);
  void look(const Run& run, const Vec3& point, double scale, Nearest& nearest) const;
  FieldValue of(const Group& group, const Vec3& point, double scale) const;
  std::vector<Cone> cones_;
  std::vector<Group> groups_;
  double blend_ = 0.0, reach_ = 0.0;
};

}  // namespace ostia::reconstruction
