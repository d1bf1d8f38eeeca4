#include "ostia/session/label_volume.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/lumen/tree_field.h"
#include "ostia/session/case_report.h"
#include "ostia/session/plaque_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <utility>

namespace ostia::session {
namespace {

using geometry::Vec3;
using imaging::Geometry;

constexpr double mark_step_mm = 0.5;    // along the axes
constexpr double mark_more_mm = 1.0;    // beyond the farthest sample about there
constexpr double widest_wall_mm = 4.0;  // of what is looked at for an outer wall

/// Voxels whose centres may lie within so much of a vessel's samples.
class NearVoxels {
 public:
  NearVoxels(const lumen::LumenModel& model, const Geometry& grid, double more_mm) : grid_(grid) {
    marked_.assign(static_cast<std::size_t>(grid.voxels()), 0);
    for (const auto& vessel : model.vessels) mark(*vessel, more_mm);
  }
  std::vector<std::int64_t> voxels() const {
    std::vector<std::int64_t> result;
    for (std::size_t n = 0; n < marked_.size(); ++n)
      if (marked_[n] != 0) result.push_back(static_cast<std::int64_t>(n));
    return result;
  }

 private:
  void mark(const lumen::VesselLumen& vessel, double more_mm) {
    const auto steps = static_cast<std::size_t>(std::ceil(vessel.axis->length() / mark_step_mm)) + 1;
    std::vector<double> reach(steps, 0.0);
    for (const lumen::SurfaceSample& sample : vessel.samples) {
      const auto at =
          std::min(steps - 1, static_cast<std::size_t>(std::max(0.0, sample.s_mm) / mark_step_mm));
      const double away = (sample.position - vessel.axis->point(sample.s_mm)).norm();
      reach[at] = std::max(reach[at], away);
    }
    for (std::size_t i = 0; i < steps; ++i) {
      double most = 0.0;  // of the samples about there: rings are up to 1 mm apart
      for (std::size_t j = i >= 3 ? i - 3 : 0; j < std::min(steps, i + 4); ++j)
        most = std::max(most, reach[j]);
      if (most > 0.0) mark_box(vessel.axis->point(mark_step_mm * static_cast<double>(i)), most + more_mm);
    }
  }
  void mark_box(const Vec3& centre, double reach_mm) {
    const Vec3 at = grid_.index(centre);
    std::array<std::int64_t, 3> lower{}, upper{};
    for (int d = 0; d < 3; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const double voxels = reach_mm / grid_.spacing[d];
      lower[k] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(at[d] - voxels)));
      upper[k] =
          std::min<std::int64_t>(grid_.size[k] - 1, static_cast<std::int64_t>(std::floor(at[d] + voxels)));
    }
    for (std::int64_t k = lower[2]; k <= upper[2]; ++k)
      for (std::int64_t j = lower[1]; j <= upper[1]; ++j)
        for (std::int64_t i = lower[0]; i <= upper[0]; ++i)
          marked_[static_cast<std::size_t>(grid_.offset(i, j, k))] = 1;
  }

  const Geometry& grid_;
  std::vector<std::uint8_t> marked_;
};

Vec3 centre_of(const Geometry& grid, std::int64_t n) {
  return grid.world(Vec3(static_cast<double>(n % grid.size[0]),
                         static_cast<double>(n / grid.size[0] % grid.size[1]),
                         static_cast<double>(n / (grid.size[0] * grid.size[1]))));
}

/// The standard segment of the vessel whose axis is nearest, as a share of the radius there.
class SegmentNumbers {
 public:
  explicit SegmentNumbers(const lumen::LumenModel& model)
      : model_(model), segments_(analysis::segments_of(model)) {}

  std::uint8_t at(const Vec3& place) const {
    constexpr double reach_mm = 12.0;
    const lumen::VesselLumen* nearest = nullptr;
    double least = 1e9, s_mm = 0.0;
    for (const auto& vessel : model_.vessels)
      for (const geometry::AxisFoot& foot : vessel->axis->feet(place, reach_mm)) {
        if (foot.s_mm < vessel->own_from_mm) continue;
        const double beyond = foot.rho_mm - vessel->axis->radius(foot.s_mm);
        if (beyond >= least) continue;
        least = beyond;
        nearest = vessel.get();
        s_mm = foot.s_mm;
      }
    if (nearest == nullptr) return label_other_vessel;
    for (const analysis::VesselSegment& one : segments_)
      if (one.vessel == nearest->vessel && s_mm >= one.from_mm - 1e-6 && s_mm <= one.to_mm + 1e-6)
        return one.aha ? static_cast<std::uint8_t>(one.aha->number) : label_other_vessel;
    return label_other_vessel;
  }

 private:
  const lumen::LumenModel& model_;
  std::vector<analysis::VesselSegment> segments_;
};

std::string name_of_label(std::uint8_t value, VoxelLabels what) {
  if (what == VoxelLabels::segments) {
    for (const analysis::AhaSegment& one : analysis::aha_segments())
      if (one.number == value) return one.code + " (" + std::to_string(one.number) + ")";
    return "other vessels";
  }
  if (value == label_lumen) return "lumen";
  if (value == label_wall) return what == VoxelLabels::plaque ? "thin wall" : "wall";
  return analysis::to_string(static_cast<analysis::PlaqueClass>(value - label_first_plaque));
}

std::vector<LabelCount> counts_of(const imaging::MaskVolume& volume, VoxelLabels what) {
  std::array<std::int64_t, 256> counts{};
  for (const std::uint8_t value : volume.voxels) ++counts[value];
  std::vector<LabelCount> result;
  for (std::size_t value = 1; value < counts.size(); ++value)
    if (counts[value] > 0) {
      const auto label = static_cast<std::uint8_t>(value);
      result.push_back({label, name_of_label(label, what), counts[value]});
    }
  return result;
}

/// Wall and plaque of one vessel where no lumen is.
void add_wall(const VesselWalls& walls, bool plaque, const std::vector<std::int64_t>& near,
              imaging::MaskVolume& volume) {
  const double from = walls.lumen.from_mm, to = from + (walls.lumen.rows() - 1) * walls.lumen.step_mm;
  core::parallel_for(near.size(), 1024, [&](std::size_t i) {
    std::uint8_t& voxel = volume.voxels[static_cast<std::size_t>(near[i])];
    if (voxel == label_lumen) return;
    const Vec3 place = centre_of(volume.geometry, near[i]);
    for (const geometry::AxisFoot& foot : walls.axis->feet(place, 2.0 * widest_wall_mm)) {
      if (foot.s_mm < from || foot.s_mm > to) continue;
      if (foot.rho_mm >= walls.outer.surface.at(foot.s_mm, foot.theta)) continue;
      std::uint8_t label = label_wall;
      if (plaque)
        if (const auto ray = plaque_ray(walls, foot.s_mm, foot.theta))
          if (const auto what = ray->at(foot.rho_mm))
            label = static_cast<std::uint8_t>(label_first_plaque + static_cast<int>(*what));
      voxel = std::max(voxel, label);
      return;
    }
  });
}

}  // namespace

LabelVolume label_volume(const lumen::LumenModel& model, const Geometry& grid, VoxelLabels what,
                         const imaging::ImageVolume* image, const OuterWallsOptions& walls,
                         const core::TaskContext& task) {
  if (model.vessels.empty()) throw InvalidInput("the case has no vessels whose voxels could be labelled");
  if (grid.voxels() <= 0) throw InvalidInput("the grid for the labels is empty");
  const bool needs_image = what == VoxelLabels::wall || what == VoxelLabels::plaque;
  if (needs_image && image == nullptr)
    throw InvalidInput("outer walls and plaque are found in the CT: give it, or ask for the lumen alone");
  LabelVolume result;
  result.volume.geometry = grid;
  try {
    result.volume.voxels.assign(static_cast<std::size_t>(grid.voxels()), 0);
  } catch (const std::bad_alloc&) {
    throw ResourceError("not enough memory for labels of " + std::to_string(grid.voxels()) + " voxels");
  }
  task.set_stage("solving the walls");
  const analysis::SurfaceOfVessel surface_of = solved_surfaces(model, task.sub(0.0, 0.4));
  std::vector<std::shared_ptr<const lumen::ImplicitSurface>> branches;
  for (const auto& vessel : model.vessels) branches.push_back(surface_of(vessel->vessel));
  const lumen::TreeField field(branches, model.blend);
  task.set_stage("labelling the lumen");
  const std::vector<std::int64_t> near = NearVoxels(model, grid, mark_more_mm).voxels();
  std::vector<Vec3> places;
  for (const std::int64_t n : near) places.push_back(centre_of(grid, n));
  std::vector<double> values(places.size());
  field.values(places, values);
  task.throw_if_cancelled();
  const SegmentNumbers numbers(model);
  core::parallel_for(near.size(), 256, [&](std::size_t i) {
    if (values[i] < 0.0)
      result.volume.voxels[static_cast<std::size_t>(near[i])] =
          what == VoxelLabels::segments ? numbers.at(places[i]) : label_lumen;
  });
  if (std::none_of(values.begin(), values.end(), [](double value) { return value < 0.0; }))
    throw InvalidInput(
        "no voxel of the grid lies in a vessel of the case: the grid is another patient's, or in another "
        "frame");
  task.set_progress(0.6);
  for (std::size_t v = 0; needs_image && v < model.tree.vessels.size(); ++v) {
    const geometry::Vessel& vessel = model.tree.vessels[v];
    OuterWallsOptions how = walls;
    how.maps = what == VoxelLabels::plaque;
    const double all = static_cast<double>(model.tree.vessels.size());
    const auto found = vessel_walls(
        model, surface_of, vessel.id, *image, how,
        task.sub(0.6 + 0.4 * static_cast<double>(v) / all, 0.6 + 0.4 * static_cast<double>(v + 1) / all));
    if (!found) {
      result.warnings.push_back(vessel.name + ": too short by itself, or outside the image; no outer wall");
      continue;
    }
    lumen::LumenModel alone;
    alone.vessels.push_back(model.vessels[v]);
    add_wall(*found, how.maps, NearVoxels(alone, grid, widest_wall_mm).voxels(), result.volume);
  }
  result.counts = counts_of(result.volume, what);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::session
