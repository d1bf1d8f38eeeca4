#include "outer_wall/disc_table.h"

#include "boundary/edge_profile.h"

#include <algorithm>
#include <mutex>

namespace ostia::segmentation {
namespace {

constexpr int radii_together = 64, samples_together = 16;  // a little room for the next vessel

int rounded_up(int count, int together) {
  return (count + together - 1) / together * together;
}

bool is_like(const DiscTable& table, double radius_step_mm, double step_mm, double sigma_mm) {
  return table.radius_step_mm == radius_step_mm && table.step_mm == step_mm && table.sigma_mm == sigma_mm;
}

/// Larger than `smaller` (null: none), whose numbers it takes over.
std::shared_ptr<const DiscTable> larger_table(DiscTable made, const DiscTable* smaller) {
  made.share.reserve(static_cast<std::size_t>(made.radii) * static_cast<std::size_t>(made.samples));
  for (int r = 0; r < made.radii; ++r)
    for (int i = 0; i < made.samples; ++i)
      made.share.push_back(smaller && r < smaller->radii && i < smaller->samples
                               ? smaller->at(r, i)
                               : blurred_disc(r * made.radius_step_mm, i * made.step_mm, made.sigma_mm));
  return std::make_shared<const DiscTable>(std::move(made));
}

}  // namespace

std::shared_ptr<const DiscTable> disc_table(double radius_step_mm, double step_mm, double sigma_mm, int radii,
                                            int samples) {
  // No parallel loop below: a thread that waits in one may take up other work, and come back to this lock.
  static std::mutex mutex;
  static std::shared_ptr<const DiscTable> last;
  const std::lock_guard lock(mutex);
  const DiscTable* known = last && is_like(*last, radius_step_mm, step_mm, sigma_mm) ? last.get() : nullptr;
  if (known && known->radii >= radii && known->samples >= samples) return last;
  const int least_radii = known ? known->radii : 0, least_samples = known ? known->samples : 0;
  last = larger_table({radius_step_mm,
                       step_mm,
                       sigma_mm,
                       rounded_up(std::max(radii, least_radii), radii_together),
                       rounded_up(std::max(samples, least_samples), samples_together),
                       {}},
                      known);
  return last;
}

}  // namespace ostia::segmentation
