#pragma once
/// \file One beat of the heart: where every place of the still phantom is at each phase
/// (docs/methods/phantom-motion.md).

#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vec.h"
#include "ostia/phantom/heart.h"

#include <cstdint>
#include <vector>

namespace ostia::phantom {

/// The phase of the cycle, in percent of the RR interval, at which the heart is as it is without motion.
constexpr double template_percent = 75.0;

/// How one heart beats. The defaults are published means of healthy adults.
struct BeatAmplitudes {
  double heart_rate_per_min = 60.0;
  /// Path of the heart's base towards the apex, from its highest place (after the atria's contraction) to its
  /// lowest (end systole), mm: beside the left and the right ventricle.
  double left_excursion_mm = 12.5, right_excursion_mm = 18.5;
  double atrial_share = 0.12;            ///< of these paths, by the atria's contraction
  double epicardial_contraction = 0.08;  ///< of the distance from the left ventricle's axis, at end systole
  double endocardial_contraction = 0.28;
  /// About the long axis at end systole, counter-clockwise seen from the apex.
  double base_rotation_deg = -3.75, apex_rotation_deg = 9.6;
  Vec3 shift_mm = Vec3(-1.2, 0.6, -2.2);  ///< of the whole heart at end systole
  double end_systole_percent = 34.5;      ///< of RR: its rest begins
};
/// Amplitudes about the means, drawn from the seed.
BeatAmplitudes draw_beat(std::uint64_t seed);
/// Throws InvalidInput for amplitudes that no heart has: the map of space might fold.
void validate(const BeatAmplitudes& amplitudes);

/// Where the beat is: 0 at the template's phase, twice continuously differentiable, of period 100.
struct BeatState {
  double descent = 0.0;  ///< of the base, as a share of its whole path; below 0 after the atria's contraction
  double contraction = 0.0;  ///< and shift; 1 at end systole
  double twist = 0.0;        ///< 1 at end systole
};
BeatState beat_state(const BeatAmplitudes& amplitudes, double percent);

/// All that decides the map but the time: the heart's own frame.
struct BeatFrame {
  Vec3 base = Vec3::Zero();
  geometry::Mat3 axes = geometry::Mat3::Identity();  ///< columns right, up, along the long axis
  double half_right_mm = 46.0, half_up_mm = 40.0, length_mm = 92.0;
};

/// The map of space of one phase, made of a rotation about the long axis, a contraction towards it, a descent
/// along it and a shift. Each of the four moves places along one coordinate alone and keeps their order on
/// it: together they are invertible everywhere, twice continuously differentiable, and the identity from
/// about 60 mm beyond the heart on, at the spine and at the ribs (3 mm at most are left at the nearest
/// rib). Immutable; asked from many threads.
class BeatPhase {
 public:
  BeatPhase() = default;  ///< the identity
  BeatPhase(const BeatFrame& frame, const BeatAmplitudes& amplitudes, double percent);
  double percent() const { return percent_; }
  bool still() const { return still_; }  ///< the identity, to the bit
  /// Where a place of the template is now.
  Vec3 at(const Vec3& template_point) const;
  /// What place of the template is here now: the inverse of `at`, to 1e-9 mm.
  Vec3 template_of(const Vec3& point) const;
  /// Volume of what was a unit of volume in the template: positive.
  double jacobian(const Vec3& template_point) const;
  /// Derivative of `at`, by central differences.
  geometry::Mat3 gradient(const Vec3& template_point) const;
  /// By how much lengths across a vessel grow in the mean: the root of its cross-section's growth.
  double growth_across(const Vec3& template_point, const Vec3& tangent) const;

 private:
  BeatFrame frame_;
  BeatAmplitudes amplitudes_;
  BeatState state_;
  double percent_ = template_percent;
  bool still_ = true;
};

/// The beat of one heart.
class Heartbeat {
 public:
  Heartbeat(const HeartShape& heart, const BeatAmplitudes& amplitudes);  ///< throws InvalidInput
  const BeatAmplitudes& amplitudes() const { return amplitudes_; }
  double rr_ms() const { return 60000.0 / amplitudes_.heart_rate_per_min; }
  BeatPhase phase(double percent) const { return {frame_, amplitudes_, percent}; }
  Vec3 at(const Vec3& template_point, double percent) const { return phase(percent).at(template_point); }

 private:
  BeatFrame frame_;
  BeatAmplitudes amplitudes_;
};

/// The beat of the case with a seed.
Heartbeat draw_heartbeat(const HeartShape& heart, std::uint64_t seed);

/// Every vertex where it is at a phase; the same triangles.
geometry::TriMesh moved(const geometry::TriMesh& mesh, const BeatPhase& phase);
std::vector<Vec3> moved(const std::vector<Vec3>& points, const BeatPhase& phase);

}  // namespace ostia::phantom
