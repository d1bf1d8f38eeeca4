#include "ostia/lumen/live_model.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace ostia::lumen {
namespace {

using geometry::Box3;

std::vector<std::int64_t> ids_of_samples(const std::vector<SurfaceSample>& samples) {
  std::vector<std::int64_t> ids;
  for (const SurfaceSample& sample : samples) ids.push_back(sample.id);
  return ids;
}

std::vector<SurfaceSample> samples_named(const VesselLumen& vessel, const std::vector<std::int64_t>& ids) {
  const std::set<std::int64_t> wanted(ids.begin(), ids.end());
  std::vector<SurfaceSample> found;
  for (const SurfaceSample& sample : vessel.samples)
    if (wanted.contains(sample.id)) found.push_back(sample);
  return found;
}

}  // namespace

struct LiveModel::Impl {
  std::shared_ptr<const LumenModel> model;
  std::map<std::int32_t, IncrementalSurface> solved;
  std::shared_ptr<const TreeField> field;
  std::optional<TreeSurface> wall;
  double wall_cell_mm = 0.0;
  Box3 wall_behind;  // where the wall is not what the field is now

  void make_field() {
    std::vector<std::shared_ptr<const ImplicitSurface>> branches;
    for (const auto& vessel : model->vessels) branches.push_back(solved.at(vessel->vessel).surface());
    field = std::make_shared<const TreeField>(std::move(branches), model->blend);
  }
  std::vector<Vec3> seeds() const {
    std::vector<Vec3> places;
    for (const auto& vessel : model->vessels)
      for (const SurfaceSample& sample : vessel->samples) places.push_back(sample.position);
    return places;
  }
};

LiveModel::LiveModel(std::shared_ptr<const LumenModel> model) : impl_(std::make_unique<Impl>()) {
  impl_->model = std::move(model);
  for (const auto& vessel : impl_->model->vessels)
    impl_->solved.emplace(vessel->vessel, IncrementalSurface(*vessel));
  impl_->make_field();
}
LiveModel::~LiveModel() = default;
LiveModel::LiveModel(LiveModel&&) noexcept = default;
LiveModel& LiveModel::operator=(LiveModel&&) noexcept = default;

const LumenModel& LiveModel::model() const {
  return *impl_->model;
}
std::shared_ptr<const TreeField> LiveModel::field() const {
  return impl_->field;
}

std::shared_ptr<const ImplicitSurface> LiveModel::surface(std::int32_t vessel) const {
  return impl_->solved.at(lumen::vessel(*impl_->model, vessel).vessel).surface();
}

LiveChange LiveModel::follow(const EditOutcome& outcome) {
  LiveChange live;
  live.box.setEmpty();
  // What cannot be changed in place is solved beside the old one; what can is changed back when a later
  // vessel fails.
  std::map<std::int32_t, IncrementalSurface> fresh;
  std::vector<const VesselChange*> changed;
  try {
    for (const VesselChange& change : outcome.changes) {
      const auto old = impl_->solved.find(change.vessel);
      if (!change.axis_changed && old != impl_->solved.end()) {
        const IncrementalReport report = old->second.change(change.removed, change.added);
        changed.push_back(&change);
        live.box.extend(report.changed);
        live.vessels.push_back({change.vessel, false, report.changed_from_mm, report.changed_to_mm});
        continue;
      }
      if (old != impl_->solved.end()) live.box.extend(old->second.surface()->box());
      live.vessels.push_back({change.vessel, true, 0.0, 0.0});
      for (const auto& vessel : outcome.model.vessels) {
        if (vessel->vessel != change.vessel) continue;
        const auto made = fresh.emplace(change.vessel, IncrementalSurface(*vessel)).first;
        live.box.extend(made->second.surface()->box());
        live.vessels.back().to_mm = vessel->axis->length();
      }
    }
  } catch (...) {
    for (const VesselChange* change : changed) {
      IncrementalSurface& surface = impl_->solved.at(change->vessel);
      surface.change(ids_of_samples(change->added),
                     samples_named(lumen::vessel(*impl_->model, change->vessel), change->removed));
    }
    throw;
  }
  for (auto& [id, surface] : fresh) impl_->solved.insert_or_assign(id, std::move(surface));
  impl_->model = std::make_shared<const LumenModel>(outcome.model);
  std::set<std::int32_t> present;
  for (const auto& vessel : impl_->model->vessels) present.insert(vessel->vessel);
  std::erase_if(impl_->solved, [&](const auto& entry) { return !present.contains(entry.first); });
  impl_->make_field();
  impl_->wall_behind.extend(live.box);
  return live;
}

geometry::TriMesh LiveModel::wall(double cell_mm, const core::TaskContext& task) {
  if (!impl_->wall || impl_->wall_cell_mm != cell_mm) {
    TreeSurface made({.cell_mm = cell_mm, .keep_within_mm = unseen_mm});
    made.build(impl_->field, impl_->seeds(), task);
    impl_->wall.emplace(std::move(made));
    impl_->wall_cell_mm = cell_mm;
  } else if (!impl_->wall_behind.isEmpty()) {
    impl_->wall->update(impl_->field, impl_->wall_behind, impl_->seeds(), task);
  }
  impl_->wall_behind.setEmpty();
  return impl_->wall->mesh();
}

}  // namespace ostia::lumen
