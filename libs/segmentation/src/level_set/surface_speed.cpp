#include "level_set/surface_speed.h"

#include <algorithm>
#include <cmath>

namespace ostia::segmentation::detail {
namespace {

double smooth_fade(double value, double full) {
  if (full <= 0.0) return 1.0;
  const double t = std::clamp(value / full, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

constexpr double kRoundest =
    0.3;  // curvature times voxel that counts in full: thin vessels must not be pinched off
constexpr double kStep = 0.4;             // voxels a step at the greatest speed
constexpr double kZoneVoxels = 3.0;       // of a held end, to either side
constexpr double kCurvatureStep = 0.125;  // w2 * step beyond which explicit curvature flow is unstable

}  // namespace

struct SurfaceSpeed::Local {
  double value = 0.0;
  Vec3 before = Vec3::Zero();  ///< one-sided differences
  Vec3 after = Vec3::Zero();
  Vec3 gradient = Vec3::Zero();  ///< central
  double norm = 0.0;
  Vec3 normal = Vec3::Zero();

  /// speed * |grad phi| with the differences from where the front comes (Osher and Sethian 1988).
  double advance(double speed) const {
    double squared = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double in = speed > 0.0 ? std::max(before[d], 0.0) : std::min(before[d], 0.0);
      const double out = speed > 0.0 ? std::min(after[d], 0.0) : std::max(after[d], 0.0);
      squared += in * in + out * out;
    }
    return speed * std::sqrt(squared);
  }
};

SurfaceSpeed::SurfaceSpeed(const imaging::Geometry& grid, const FeatureForce& feature,
                           const FeatureForce* inflation_speed, const LevelSetOptions& options)
    : feature_(feature),
      inflation_speed_(inflation_speed),
      options_(options),
      size_(grid.size),
      spacing_(grid.spacing) {
  h_ = spacing_.minCoeff();
  step_ = kStep;
  if (options.curvature > 0.0) step_ = std::min(step_, kCurvatureStep / options.curvature);
  const double strongest = std::max(1.0, std::abs(options.inflation));
  step_ /= strongest;
  // Zones in the frame of the image's axes.
  for (const LevelSetEnd& end : options.ends) {
    zones_.push_back({grid.index(end.point).cwiseProduct(spacing_),
                      grid.direction.transpose() * end.outward.normalized(), end.radius_mm,
                      kZoneVoxels * spacing_.maxCoeff(), end.hold_beyond});
  }
}

const SurfaceSpeed::EndZone* SurfaceSpeed::zone_at(const Vec3& index, bool& beyond) const {
  beyond = false;
  for (const EndZone& zone : zones_) {
    const Vec3 away = index.cwiseProduct(spacing_) - zone.point;
    const double along = away.dot(zone.axis);
    if (std::abs(along) > zone.reach) continue;
    if (away.squaredNorm() - along * along > zone.radius * zone.radius) continue;
    beyond = zone.hold_beyond && along > 0.0;
    return &zone;
  }
  return nullptr;
}

SurfaceSpeed::Local SurfaceSpeed::differentiate(const SparseField& field, std::int64_t n) const {
  Local local;
  local.value = field.value(n);
  for (int d = 0; d < 3; ++d) {
    const std::int64_t s = field.strides()[d];
    local.before[d] = (local.value - field.value(n - s)) / spacing_[d];
    local.after[d] = (field.value(n + s) - local.value) / spacing_[d];
    local.gradient[d] = 0.5 * (local.before[d] + local.after[d]);
  }
  local.norm = local.gradient.norm();
  if (local.norm > 1e-6) local.normal = local.gradient / local.norm;
  return local;
}

/// Second derivatives of phi, central.
struct SurfaceSpeed::Bend {
  Vec3 pure = Vec3::Zero();
  Vec3 mixed = Vec3::Zero();  ///< yz, xz, xy

  Vec3 times(const Vec3& v) const {
    return {pure[0] * v[0] + mixed[2] * v[1] + mixed[1] * v[2],
            mixed[2] * v[0] + pure[1] * v[1] + mixed[0] * v[2],
            mixed[1] * v[0] + mixed[0] * v[1] + pure[2] * v[2]};
  }
};

SurfaceSpeed::Bend SurfaceSpeed::bend(const SparseField& field, std::int64_t n, const Local& local) const {
  Bend bend;
  for (int d = 0; d < 3; ++d) {
    bend.pure[d] = (local.after[d] - local.before[d]) / spacing_[d];
    const int a = (d + 1) % 3;
    const int b = (d + 2) % 3;
    const std::int64_t sa = field.strides()[a];
    const std::int64_t sb = field.strides()[b];
    bend.mixed[d] = (field.value(n + sa + sb) - field.value(n + sa - sb) - field.value(n - sa + sb) +
                     field.value(n - sa - sb)) /
                    (4.0 * spacing_[a] * spacing_[b]);
  }
  return bend;
}

double SurfaceSpeed::curvature(const SparseField& field, std::int64_t n, const Local& local) const {
  if (local.norm < 0.1) return 0.0;  // on a crest between two walls there is no curvature to speak of
  const Bend second = bend(field, n, local);
  const double most = kRoundest / h_;
  const Vec3 across = second.times(local.normal);
  const double sum = (second.pure.sum() - local.normal.dot(across)) / local.norm;
  if (options_.curvature_term == CurvatureTerm::mean) return std::clamp(sum, -most, most);
  // The form that the second derivatives make on the surface's tangent plane; its eigenvalues are the
  // principal curvatures.
  const Vec3 u = local.normal.unitOrthogonal();
  const Vec3 v = local.normal.cross(u);
  const Vec3 along_u = second.times(u);
  const double uu = u.dot(along_u) / local.norm;
  const double uv = v.dot(along_u) / local.norm;
  const double half_difference = uu - 0.5 * sum;
  return std::clamp(0.5 * sum - std::hypot(half_difference, uv), -most, most);
}

double SurfaceSpeed::change(const SparseField& field, std::int64_t n) const {
  const Local local = differentiate(field, n);
  // Foot point on the surface; further than a voxel the linear model says nothing.
  const Vec3 here(static_cast<double>(n % size_[0]), static_cast<double>(n / size_[0] % size_[1]),
                  static_cast<double>(n / (size_[0] * size_[1])));
  const double to_foot = local.norm > 0.1 ? std::clamp(-local.value / local.norm, -h_, h_) : 0.0;
  const Vec3 foot = here + (to_foot * local.normal).cwiseQuotient(spacing_);
  bool beyond = false;
  const EndZone* zone = zone_at(foot, beyond);
  if (beyond) return 0.0;
  const Sample feature = feature_.at(foot, local.normal);
  double change = 0.0;
  if (options_.advection > 0.0) {
    Vec3 velocity = options_.advection * h_ * h_ * feature.gradient;
    if (zone != nullptr) velocity -= velocity.dot(zone->axis) * zone->axis;
    const double speed = velocity.norm();
    if (speed > h_) velocity *= h_ / speed;
    // As a speed along the normal: in a thin vessel a voxel between two walls must not be carried off by one
    // of them.
    change -= local.advance(velocity.dot(local.normal));
  }
  if (options_.curvature > 0.0 && zone == nullptr) {
    const double fade = smooth_fade(feature.value, options_.curvature_needs_feature);
    change += fade * options_.curvature * h_ * h_ * curvature(field, n, local) * local.norm;
  }
  if (options_.inflation != 0.0 && zone == nullptr) {
    const double g =
        inflation_speed_ ? inflation_speed_->at(foot, local.normal).value : 1.0 / (1.0 + feature.value);
    const double speed = options_.inflation * h_ * g;
    change -= local.advance(speed);
  }
  return std::clamp(step_ * change, -0.5 * h_, 0.5 * h_);
}

}  // namespace ostia::segmentation::detail
