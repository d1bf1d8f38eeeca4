#include "ostia/segmentation/level_set.h"

#include "sparse_field.h"
#include "surface_speed.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
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

constexpr int kPeriod = 10;         // iterations between two looks at the motion
constexpr double kProgress = 0.8;   // the motion must fall to this part in a period
constexpr double kDamping = 0.6;    // else the step is shortened by this
constexpr double kSwing = 0.5;      // where the net motion is below this part of the way gone
constexpr double kLeastStep = 0.3;  // but to no less than about this part

/// Where the surface was at the last look. The net motion is what counts: voxels that swing about a sharp
/// ridge do not matter.
class Rest {
 public:
  explicit Rest(const detail::SparseField& field) { remember(field); }

  /// Root mean square motion since the last look, mm.
  double motion(const detail::SparseField& field, double limit) {
    double sum = 0.0;
    for (std::size_t a = 0; a < voxels_.size(); ++a) {
      const double now = std::clamp<double>(field.value(voxels_[a]), -limit, limit);
      const double then = std::clamp<double>(values_[a], -limit, limit);
      sum += (now - then) * (now - then);
    }
    const double result = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, voxels_.size())));
    remember(field);
    return result;
  }

 private:
  void remember(const detail::SparseField& field) {
    voxels_ = field.active();
    values_.resize(voxels_.size());
    for (std::size_t a = 0; a < voxels_.size(); ++a) values_[a] = field.value(voxels_[a]);
  }

  std::vector<std::int64_t> voxels_;
  std::vector<float> values_;
};

LevelSetResult evolve(const imaging::FloatVolume& initial, const detail::Pull& feature,
                      const detail::Pull* inflation_speed, const LevelSetOptions& options,
                      const core::TaskContext& task) {
  detail::SparseField field(initial);
  if (field.active().empty()) throw InvalidInput("level set: nothing is inside the initial surface");
  detail::SurfaceSpeed speed(initial.geometry, feature, inflation_speed, options);
  const double h = initial.geometry.spacing.minCoeff();
  LevelSetResult result;
  std::vector<float> changes;
  Rest rest(field);
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
    result.rms_voxels = rest.motion(field, h) / h;
    result.rms_history.push_back(result.rms_voxels);
    result.converged = result.rms_voxels < options.rms_tolerance_voxels;
    const bool swings = result.rms_voxels < kSwing * way;
    way = 0.0;
    if (swings && result.rms_voxels > kProgress * before && damping > kLeastStep) {
      damping *= kDamping;
      speed.damp(kDamping);
    }
  }
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
  return evolve(initial, detail::GridPull(feature, options.feature_offset_voxels), nullptr, options, task);
}

LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::FloatVolume& feature,
                         const imaging::FloatVolume& inflation_speed, const LevelSetOptions& options,
                         const core::TaskContext& task) {
  validate(options);
  require_usable(initial);
  require_grid(initial, feature, "the feature image");
  require_grid(initial, inflation_speed, "the inflation speed");
  const detail::GridPull speed(inflation_speed, 0.0);
  return evolve(initial, detail::GridPull(feature, options.feature_offset_voxels), &speed, options, task);
}

LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::ImageVolume& image,
                         const EdgeFeature& edge, const LevelSetOptions& options,
                         const core::TaskContext& task) {
  validate(options);
  if (!(edge.noise_hu_per_mm > 0.0) || !std::isfinite(edge.noise_hu_per_mm)) {
    throw InvalidInput("level set: noise_hu_per_mm must be positive and finite");
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
  return evolve(initial, detail::EdgePull(image, initial.geometry, edge), nullptr, options, task);
}

}  // namespace ostia::segmentation
