#include "ostia/segmentation/level_set.h"

#include "level_set/sparse_field.h"
#include "level_set/surface_speed.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace ostia::segmentation {
namespace {

void require_finite(const imaging::FloatVolume& image, const char* name) {
  const bool finite = core::parallel_reduce(
      image.voxels.size(), std::size_t{262144}, true,
      [&](std::size_t first, std::size_t last) {
        float sum = 0.0F;
        for (std::size_t n = first; n < last; ++n)
          sum += image.voxels[n] * 0.0F;  // 0 unless one is not finite
        return sum == 0.0F;
      },
      [](bool a, bool b) { return a && b; });
  if (!finite) throw InvalidInput(std::string("level set: ") + name + " has values that are not finite");
}

void require_grid(const imaging::FloatVolume& initial, const imaging::FloatVolume& other, const char* name) {
  if (!imaging::same_grid(initial.geometry, other.geometry) || initial.voxels.size() != other.voxels.size()) {
    throw InvalidInput(std::string("level set: ") + name +
                       " does not lie on the grid of the initial level set");
  }
  require_finite(other, name);
}

void require_usable(const imaging::FloatVolume& initial) {
  for (int d = 0; d < 3; ++d) {
    if (initial.geometry.size[d] < 4) {
      throw InvalidInput("level set: the grid has only " + std::to_string(initial.geometry.size[d]) +
                         " voxels along axis " + std::to_string(d) + "; at least 4 are needed");
    }
  }
  if (initial.voxels.size() != static_cast<std::size_t>(initial.geometry.voxels())) {
    throw InvalidInput("level set: the initial level set has " + std::to_string(initial.voxels.size()) +
                       " values for " + std::to_string(initial.geometry.voxels()) + " voxels");
  }
  require_finite(initial, "the initial level set");
}

/// What edges are read off must be usable, and hold the voxels of the initial level set.
void require_edges(const imaging::FloatVolume& initial, const imaging::ImageVolume& image,
                   const EdgeFeature& edge) {
  if (!(edge.noise_hu_per_mm > 0.0) || !std::isfinite(edge.noise_hu_per_mm)) {
    throw InvalidInput("level set: noise_hu_per_mm must be positive and finite");
  }
  if (!(edge.blur.minCoeff() > 0.0) || !edge.blur.allFinite()) {
    throw InvalidInput("level set: the blur's variances must be positive and finite");
  }
  require_usable(initial);
  imaging::Geometry part = image.geometry;
  const Vec3 first = image.geometry.index(initial.geometry.origin);
  bool inside = true;
  for (int d = 0; d < 3; ++d) {
    const auto at = std::llround(first[d]);
    inside &= at >= 0 && at + initial.geometry.size[d] <= image.geometry.size[d];
    part.size[d] = initial.geometry.size[d];
  }
  part.origin = image.geometry.world(first.array().round().matrix());
  if (!inside || !imaging::same_grid(part, initial.geometry)) {
    throw InvalidInput("level set: the initial level set does not lie on voxels of the image");
  }
}

constexpr int kPeriod = 10;         // iterations between two looks at the motion
constexpr double kProgress = 0.8;   // the motion must fall to this part in a period
constexpr double kDamping = 0.6;    // else the step is shortened by this
constexpr double kSwing = 0.5;      // where the net motion is below this part of the way gone
constexpr double kLeastStep = 0.3;  // but to no less than about this part

/// Where the surface was at the last look. What counts is the net motion of the surface itself, where it
/// crosses the edges of the grid: values of voxels beside it may change without moving it.
class Rest {
 public:
  explicit Rest(const detail::SparseField& field) { remember(field); }

  /// Root mean square motion since the last look, mm; the width of the band at most.
  double motion(const detail::SparseField& field) {
    double sum = 0.0;
    std::size_t crossings = 0;
    for (const std::int64_t n : field.active()) {
      for (const std::int64_t s : field.strides()) {
        const double here = field.value(n);
        const double there = field.value(n + s);
        if ((here < 0.0) == (there < 0.0)) continue;
        // The distance of what is now the surface from what was.
        const double at = here / (here - there);
        const double was =
            (1.0 - at) * then_[static_cast<std::size_t>(n)] + at * then_[static_cast<std::size_t>(n + s)];
        sum += was * was;
        ++crossings;
      }
    }
    remember(field);
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, crossings)));
  }

 private:
  void remember(const detail::SparseField& field) {
    then_.assign(field.values(), field.values() + field.geometry().voxels());
  }

  std::vector<float> then_;
};

constexpr double kNearRestVoxels = 0.2;  // motion in a period; only then crossings are counted
constexpr int kFreeCrossings = 2;        // of a voxel by the surface, before it slows down there
constexpr int kLastCrossing = 12;        // beyond which it slows down no more

/// How often the surface has crossed each voxel. Where a voxel is now inside and now outside, its neighbours
/// join and leave the band with it, and nothing comes to rest by itself: each further crossing halves its
/// speed.
class Flips {
 public:
  explicit Flips(std::size_t voxels) : count_(voxels, 0) {}

  void slow_down(const std::vector<std::int64_t>& active, std::vector<float>& changes) const {
    for (std::size_t a = 0; a < active.size(); ++a) {
      const int more = count_[static_cast<std::size_t>(active[a])] - kFreeCrossings;
      if (more > 0) changes[a] = std::ldexp(changes[a], -more);
    }
  }

  /// Before the field takes the changes.
  void count(const detail::SparseField& field, const std::vector<float>& changes) {
    const std::vector<std::int64_t>& active = field.active();
    for (std::size_t a = 0; a < active.size(); ++a) {
      const float value = field.value(active[a]);
      std::uint8_t& crossings = count_[static_cast<std::size_t>(active[a])];
      if ((value < 0.0F) != (value + changes[a] < 0.0F) && crossings < kLastCrossing) ++crossings;
    }
  }

 private:
  std::vector<std::uint8_t> count_;
};

/// Offsets of the voxels to hold inside, each once.
std::vector<std::int64_t> kept_voxels(const imaging::FloatVolume& initial, const std::vector<Vec3>& points) {
  const imaging::Geometry& g = initial.geometry;
  std::vector<std::int64_t> kept;
  for (const Vec3& point : points) {
    const Vec3 index = g.index(point);
    std::array<std::int64_t, 3> v{};
    bool inside = true;
    for (int d = 0; d < 3; ++d) {
      // The outermost voxels are outside in any case.
      inside = inside && index[d] > 0.5 && index[d] < static_cast<double>(g.size[d]) - 1.5;
      if (inside) v[static_cast<std::size_t>(d)] = std::llround(index[d]);
    }
    if (inside && initial(v[0], v[1], v[2]) < 0.0F) kept.push_back(g.offset(v[0], v[1], v[2]));
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

LevelSetResult evolve(const imaging::FloatVolume& initial, const detail::FeatureForce& feature,
                      const detail::FeatureForce* inflation_speed, const LevelSetOptions& options,
                      const core::TaskContext& task) {
  detail::SparseField field(initial);
  if (field.active().empty()) throw InvalidInput("level set: nothing is inside the initial surface");
  field.hold_inside(kept_voxels(initial, options.kept));
  detail::SurfaceSpeed speed(initial.geometry, feature, inflation_speed, options);
  const double h = initial.geometry.spacing.minCoeff();
  LevelSetResult result;
  std::vector<float> changes;
  Rest rest(field);
  Flips flips(initial.voxels.size());
  bool near_rest = false;
  double damping = 1.0;
  double way = 0.0;
  while (result.iterations < options.iterations_max && !result.converged) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(result.iterations) / options.iterations_max);
    const std::vector<std::int64_t>& active = field.active();
    changes.resize(active.size());
    core::parallel_for(active.size(), 2048, [&](std::size_t a) {
      changes[a] = static_cast<float>(speed.change(field, active[a]));
    });
    if (near_rest) {
      flips.slow_down(active, changes);
      flips.count(field, changes);
    }
    double squares = 0.0;
    for (const float change : changes) squares += static_cast<double>(change) * change;
    way += std::sqrt(squares / static_cast<double>(active.size())) / h;
    field.advance(changes);
    ++result.iterations;
    if (field.active().empty()) {
      throw NumericalError("level set: the surface vanished after " + std::to_string(result.iterations) +
                           " iterations; lower the curvature weight");
    }
    if (result.iterations % kPeriod != 0) continue;
    const double before = result.rms_history.empty() ? 1e9 : result.rms_history.back();
    result.rms_voxels = rest.motion(field) / h;
    near_rest = result.rms_voxels < kNearRestVoxels;
    result.rms_history.push_back(result.rms_voxels);
    result.converged = result.rms_voxels < options.rms_tolerance_voxels;
    const bool swings = result.rms_voxels < kSwing * way;
    way = 0.0;
    if (swings && result.rms_voxels > kProgress * before && damping > kLeastStep) {
      damping *= kDamping;
      speed.damp(kDamping);
    }
  }
  if (result.iterations % kPeriod != 0) result.rms_voxels = rest.motion(field) / h;
  result.level_set = std::move(field).take();
  task.set_progress(1.0);
  return result;
}

}  // namespace

void validate(const LevelSetOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("level set: ") + what);
  };
  require(std::isfinite(o.inflation) && std::abs(o.inflation) <= 1e3, "inflation must be finite");
  require(o.curvature >= 0.0 && o.curvature <= 1e3, "curvature must be in [0, 1000]");
  require(o.advection >= 0.0 && o.advection <= 1e3, "advection must be in [0, 1000]");
  require(o.iterations_max >= 0, "iterations_max must not be negative");
  require(o.rms_tolerance_voxels >= 0.0 && std::isfinite(o.rms_tolerance_voxels),
          "rms_tolerance_voxels must not be negative");
  require(o.feature_offset_voxels >= -1.0 && o.feature_offset_voxels <= 1.0,
          "feature_offset_voxels must be in [-1, 1]");
  for (const Vec3& point : o.kept) require(point.allFinite(), "the points to keep must be finite");
  for (const LevelSetEnd& end : o.ends) {
    require(
        end.point.allFinite() && end.outward.allFinite() && end.outward.norm() > 0.0 && end.radius_mm >= 0.0,
        "an end needs a finite point, a direction that is not zero and a radius that is not negative");
  }
  require(o.curvature_needs_feature >= 0.0 && std::isfinite(o.curvature_needs_feature),
          "curvature_needs_feature must not be negative");
}

LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::FloatVolume& feature,
                         const LevelSetOptions& options, const core::TaskContext& task) {
  validate(options);
  require_usable(initial);
  require_grid(initial, feature, "the feature image");
  return evolve(initial, detail::GridFeatureForce(feature, options.feature_offset_voxels), nullptr, options,
                task);
}

LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::FloatVolume& feature,
                         const imaging::FloatVolume& inflation_speed, const LevelSetOptions& options,
                         const core::TaskContext& task) {
  validate(options);
  require_usable(initial);
  require_grid(initial, feature, "the feature image");
  require_grid(initial, inflation_speed, "the inflation speed");
  const detail::GridFeatureForce speed(inflation_speed, 0.0);
  return evolve(initial, detail::GridFeatureForce(feature, options.feature_offset_voxels), &speed, options,
                task);
}

LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::ImageVolume& image,
                         const EdgeFeature& edge, const LevelSetOptions& options,
                         const core::TaskContext& task) {
  validate(options);
  require_edges(initial, image, edge);
  return evolve(initial, detail::EdgeFeatureForce(image, initial.geometry, edge), nullptr, options, task);
}

LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::ImageVolume& image,
                         const EdgeFeature& edge, const imaging::FloatVolume& inflation_speed,
                         const LevelSetOptions& options, const core::TaskContext& task) {
  validate(options);
  require_edges(initial, image, edge);
  require_grid(initial, inflation_speed, "the inflation speed");
  const detail::GridFeatureForce speed(inflation_speed, 0.0);
  return evolve(initial, detail::EdgeFeatureForce(image, initial.geometry, edge), &speed, options, task);
}

}  // namespace ostia::segmentation
