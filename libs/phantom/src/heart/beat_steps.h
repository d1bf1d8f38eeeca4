#pragma once
/// \file The four parts of the heart's motion, each along one coordinate and with its inverse.

#include "body/smooth_step.h"

#include "ostia/phantom/heartbeat.h"

namespace ostia::phantom {

class BeatSteps {
 public:
  BeatSteps(const BeatFrame& frame, const BeatAmplitudes& amplitudes, const BeatState& state)
      : frame_(frame), amplitudes_(amplitudes), state_(state) {}

  /// About the left ventricle's axis; `sense` -1 turns back.
  Vec3 turned(const Vec3& p, double sense) const;
  /// Towards that axis, and what the step makes of volumes.
  Vec3 contracted(const Vec3& p, double* jacobian = nullptr) const;
  Vec3 before_contraction(const Vec3& p) const;
  /// Along the long axis, the base towards the apex.
  Vec3 descended(const Vec3& p, double* jacobian = nullptr) const;
  Vec3 before_descent(const Vec3& p) const;
  /// The whole heart.
  Vec3 shifted(const Vec3& p, double* jacobian = nullptr) const;
  Vec3 before_shift(const Vec3& p) const;

 private:
  /// About the left ventricle's axis, mm.
  struct Local {
    double right, up, along;
  };
  Local local(const Vec3& p) const;
  Vec3 world(const Local& l) const;
  ValueSlope contracted_radius(double rho, const Local& unit) const;
  ValueSlope descended_place(double along, const Local& at) const;
  ValueSlope shifted_place(double way_mm, const Vec3& foot, const Vec3& direction) const;

  const BeatFrame& frame_;
  const BeatAmplitudes& amplitudes_;
  const BeatState& state_;
};

}  // namespace ostia::phantom
