#include "ostia/lumen/incremental_surface.h"

#include "interpolation/constraints.h"
#include "interpolation/profile_system.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace ostia::lumen {
namespace {

std::vector<std::int64_t> ids_of(const std::vector<SurfaceSample>& samples) {
  std::vector<std::int64_t> ids;
  for (const SurfaceSample& sample : samples) ids.push_back(sample.id);
  return ids;
}

}  // namespace

struct IncrementalSurface::Impl {
  VesselLumen vessel;  // its samples are in the set
  ConstraintSet set;
  std::optional<ProfileSystem> system;
  std::shared_ptr<const ImplicitSurface> surface;

  explicit Impl(const VesselLumen& given) : vessel(given), set(given) {
    vessel.samples.clear();
    set.check_for_holes();
    system.emplace(set.all(), vessel.interpolation);
    show();
  }
  void show() { surface = std::make_shared<const ImplicitSurface>(system->coefficients()); }

  // The whole system anew; nothing is known of what stayed.
  void factor_anew(IncrementalReport& report) {
    ProfileSystem anew(set.all(), vessel.interpolation);
    report.refactored = true;
    report.residual = anew.residual();
    system.emplace(std::move(anew));
    report.changed = surface->box();
    show();
    report.changed.extend(surface->box());
    report.changed_from_mm = set.samples().front().s_mm;
    report.changed_to_mm = set.samples().back().s_mm;
  }

  void follow(const ConstraintSet::Difference& difference, IncrementalReport& report) {
    if (system->overgrown()) {
      factor_anew(report);
      return;
    }
    std::optional<ProfileSystem::Change> change;
    try {
      change = system->change(difference);
    } catch (const NumericalError&) {
      factor_anew(report);
      return;
    }
    report.residual = change->residual;
    report.changed = change->extent.box;
    report.changed_from_mm = change->extent.from_mm;
    report.changed_to_mm = change->extent.to_mm;
    show();
  }
};

IncrementalSurface::IncrementalSurface(const VesselLumen& vessel) : impl_(std::make_unique<Impl>(vessel)) {}
IncrementalSurface::~IncrementalSurface() = default;
IncrementalSurface::IncrementalSurface(IncrementalSurface&&) noexcept = default;
IncrementalSurface& IncrementalSurface::operator=(IncrementalSurface&&) noexcept = default;

std::shared_ptr<const ImplicitSurface> IncrementalSurface::surface() const {
  return impl_->surface;
}
const std::vector<SurfaceSample>& IncrementalSurface::samples() const {
  return impl_->set.samples();
}

IncrementalReport IncrementalSurface::change(const std::vector<std::int64_t>& removed,
                                             const std::vector<SurfaceSample>& added) {
  std::vector<SurfaceSample> gone;
  for (const SurfaceSample& sample : impl_->set.samples())
    if (std::find(removed.begin(), removed.end(), sample.id) != removed.end()) gone.push_back(sample);
  const ConstraintSet::Difference difference = impl_->set.change(removed, added);
  IncrementalReport report;
  report.rows_removed = static_cast<int>(difference.removed.size());
  report.rows_added = static_cast<int>(difference.added.size());
  try {
    std::vector<Vec3> touched;
    for (const SurfaceSample& sample : gone) touched.push_back(sample.position);
    for (const SurfaceSample& sample : added) touched.push_back(sample.position);
    if (!touched.empty()) impl_->set.check_for_holes(touched);
    impl_->follow(difference, report);
  } catch (...) {
    impl_->set.change(ids_of(added), gone);
    throw;
  }
  return report;
}

}  // namespace ostia::lumen
