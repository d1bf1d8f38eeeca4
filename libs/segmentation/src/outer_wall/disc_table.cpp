#include "outer_wall/disc_table.h"

#include "boundary/edge_profile.h"

#include <algorithm>
#include <array>
#include <mutex>

namespace ostia::segmentation {
namespace {

constexpr int radii_together = 64, samples_together = 16;  // a little room for the next vessel
constexpr std::size_t kept_tables = 4;  // the outer wall's and the lumen's have steps of their own

int rounded_up(int count, int together) {
  return (count + together - 1) / together * together;
}

bool is_like(const DiscTable& table, double radius_step_mm, double step_mm, double sigma_mm) {
  return table.radius_step_mm == radius_step_mm && table.step_mm == step_mm && table.sigma_mm == sigma_mm;
}

/// Larger than `smaller` (null: none), whose rows it takes over where they are as long.
std::shared_ptr<const DiscTable> larger_table(DiscTable made, const DiscTable* smaller) {
  made.share.reserve(static_cast<std::size_t>(made.radii) * static_cast<std::size_t>(made.samples));
  for (int r = 0; r < made.radii; ++r) {
    if (smaller && r < smaller->radii && made.samples == smaller->samples) {
      const auto row = smaller->share.begin() + static_cast<std::ptrdiff_t>(r) * made.samples;
      made.share.insert(made.share.end(), row, row + made.samples);
      continue;
    }
    const std::vector<double> row =
        blurred_disc(r * made.radius_step_mm, made.step_mm, made.samples, made.sigma_mm);
    made.share.insert(made.share.end(), row.begin(), row.end());
  }
  return std::make_shared<const DiscTable>(std::move(made));
}

}  // namespace

std::shared_ptr<const DiscTable> disc_table(double radius_step_mm, double step_mm, double sigma_mm, int radii,
                                            int samples) {
  // No parallel loop below: a thread that waits in one may take up other work, and come back to this lock.
  static std::mutex mutex;
  static std::array<std::shared_ptr<const DiscTable>, kept_tables> kept;
  static std::size_t oldest = 0;
  const std::lock_guard lock(mutex);
  auto at = std::ranges::find_if(
      kept, [&](const auto& one) { return one && is_like(*one, radius_step_mm, step_mm, sigma_mm); });
  const DiscTable* known = at == kept.end() ? nullptr : at->get();
  if (known && known->radii >= radii && known->samples >= samples) return *at;
  if (!known) at = kept.begin() + static_cast<std::ptrdiff_t>(oldest++ % kept_tables);
  const int least_radii = known ? known->radii : 0, least_samples = known ? known->samples : 0;
  *at = larger_table({radius_step_mm,
                      step_mm,
                      sigma_mm,
                      rounded_up(std::max(radii, least_radii), radii_together),
                      rounded_up(std::max(samples, least_samples), samples_together),
                      {}},
                     known);
  return *at;
}

}  // namespace ostia::segmentation
