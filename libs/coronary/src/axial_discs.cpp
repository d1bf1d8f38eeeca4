#include "axial_discs.h"

#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>

namespace ostia::coronary {
namespace {

geometry::Box3 box_of(const imaging::Geometry& grid) {
  geometry::Box3 box;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 index;
    for (int a = 0; a < 3; ++a)
      index[a] = (corner >> a & 1) != 0 ? static_cast<double>(grid.size[static_cast<std::size_t>(a)] - 1) : 0;
    box.extend(grid.world(index));
  }
  return box;
}

bool better(const DiscFit& a, const DiscFit& b) {
  return a.round - 2.0 * a.residual > b.round - 2.0 * b.residual;
}

/// The best of those that lie in each other.
std::vector<DiscFit> apart(std::vector<DiscFit> discs) {
  std::stable_sort(discs.begin(), discs.end(), better);
  std::vector<DiscFit> kept;
  for (const DiscFit& disc : discs)
    if (std::none_of(kept.begin(), kept.end(), [&](const DiscFit& other) {
          return (disc.centre - other.centre).norm() < 0.5 * (disc.radius_mm + other.radius_mm);
        }))
      kept.push_back(disc);
  return kept;
}

std::vector<DiscFit> discs_at(const imaging::ImageVolume& image, const geometry::Box3& box, double z,
                              const ColumnOptions& options) {
  std::vector<DiscFit> found;
  for (double y = box.min().y(); y <= box.max().y(); y += options.grid_step_mm)
    for (double x = box.min().x(); x <= box.max().x(); x += options.grid_step_mm) {
      const Vec3 at(x, y, z);
      if (!image.geometry.contains(at) || imaging::sample(image, at) < options.disc.least_hu) continue;
      const std::optional<DiscFit> disc = fit_disc(image, {at, Vec3::UnitX(), Vec3::UnitY()}, options.disc);
      if (disc && disc->round >= options.least_round && disc->residual <= options.largest_residual)
        found.push_back(*disc);
    }
  return apart(std::move(found));
}

}  // namespace

double DiscColumn::mean_radius_mm() const {
  double sum = 0.0;
  for (const DiscFit& disc : discs) sum += disc.radius_mm;
  return sum / static_cast<double>(discs.size());
}

double DiscColumn::mean_hu() const {
  double sum = 0.0;
  for (const DiscFit& disc : discs) sum += disc.hu;
  return sum / static_cast<double>(discs.size());
}

std::vector<DiscColumn> disc_columns(const imaging::ImageVolume& image, const ColumnOptions& options,
                                     const core::TaskContext& task) {
  const geometry::Box3 box = box_of(image.geometry);
  const auto slices = static_cast<std::size_t>(box.sizes().z() / options.slice_step_mm) + 1;
  std::vector<std::vector<DiscFit>> discs(slices);
  core::parallel_for(slices, 1, [&](std::size_t k) {
    task.throw_if_cancelled();
    discs[k] = discs_at(image, box, box.min().z() + options.slice_step_mm * static_cast<double>(k), options);
  });
  std::vector<DiscColumn> done, open;
  for (const std::vector<DiscFit>& slice : discs) {
    std::vector<DiscColumn> next;
    std::vector<char> taken(open.size(), 0);
    for (const DiscFit& disc : slice) {
      std::size_t best = open.size();
      for (std::size_t c = 0; c < open.size(); ++c) {
        const DiscFit& last = open[c].discs.back();
        const double shift = (disc.centre - last.centre).head<2>().norm() / options.slice_step_mm;
        const double change = std::abs(disc.radius_mm / last.radius_mm - 1.0);
        if (taken[c] || shift > options.largest_shift || change > options.largest_change) continue;
        if (best == open.size() ||
            (disc.centre - last.centre).norm() < (disc.centre - open[best].discs.back().centre).norm())
          best = c;
      }
      if (best == open.size()) {
        next.push_back({{disc}});
      } else {
        taken[best] = 1;
        next.push_back(open[best]);
        next.back().discs.push_back(disc);
      }
    }
    for (std::size_t c = 0; c < open.size(); ++c)
      if (!taken[c]) done.push_back(std::move(open[c]));
    open = std::move(next);
  }
  std::move(open.begin(), open.end(), std::back_inserter(done));
  std::erase_if(done, [&](const DiscColumn& c) { return c.length_mm() < options.least_length_mm; });
  std::stable_sort(done.begin(), done.end(),
                   [](const DiscColumn& a, const DiscColumn& b) { return a.length_mm() > b.length_mm(); });
  return done;
}

}  // namespace ostia::coronary
