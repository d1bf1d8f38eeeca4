#include "ostia/coronary/aorta.h"

#include "axial_discs.h"
#include "median.h"
#include "tube_following.h"
#include "working_image.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::coronary {
namespace {

using core::rounded_text;

// Contrast that mixes with blood without it streaks; the aorta's is even: its standard deviation inside is
// noise (below 5 % at this spacing in the phantom) and does not reach this share of it.
constexpr double largest_unevenness = 0.12;
// Of the brightest even tube: vessels and chambers of the right heart are fainter at the arterial phase.
constexpr double least_brightness = 0.75;
// The descending aorta runs along the spine, behind the heart, with the left lung on its left and behind it;
// behind the ascending aorta are the pulmonary artery and the left atrium.
constexpr double behind_mm = 40.0;
constexpr double most_lung = 0.3;
constexpr double lung_hu = -400.0;

ColumnOptions column_options(const AortaOptions& options) {
  ColumnOptions columns;
  columns.disc.least_hu = options.least_hu;
  columns.disc.smallest_radius_mm = options.smallest_radius_mm;
  columns.disc.largest_radius_mm = options.largest_radius_mm;
  columns.least_length_mm = options.least_column_mm;
  return columns;
}

double unevenness(const DiscColumn& column) {
  std::vector<double> sd;
  for (const DiscFit& disc : column.discs) sd.push_back(disc.sd_hu);
  return median(sd) / column.mean_hu();
}

double mean_y(const DiscColumn& column) {
  double sum = 0.0;
  for (const DiscFit& disc : column.discs) sum += disc.centre.y();
  return sum / static_cast<double>(column.discs.size());
}

/// Share of lung in the quarter to the left and behind, up to 12 mm beyond the wall.
double lung_behind(const imaging::ImageVolume& image, const DiscColumn& column) {
  int lung = 0, all = 0;
  for (const DiscFit& disc : column.discs)
    for (int k = 0; k <= 6; ++k) {
      const double angle = 0.5 * std::numbers::pi * k / 6.0;
      const Vec3 out(std::cos(angle), std::sin(angle), 0.0);  // x grows to the left, y to the back
      for (double beyond = 3.0; beyond <= 12.0; beyond += 3.0) {
        lung += imaging::sample(image, disc.centre + (disc.radius_mm + beyond) * out) < lung_hu ? 1 : 0;
        ++all;
      }
    }
  return static_cast<double>(lung) / all;
}

/// `columns` are the longest first.
const DiscColumn* ascending(const imaging::ImageVolume& image, const std::vector<DiscColumn>& columns,
                            double most_hu) {
  std::vector<const DiscColumn*> even;
  double brightest = 0.0;
  for (const DiscColumn& column : columns)
    if (unevenness(column) < largest_unevenness && column.mean_hu() <= most_hu) {
      even.push_back(&column);
      brightest = std::max(brightest, column.mean_hu());
    }
  std::erase_if(even, [&](const DiscColumn* c) { return c->mean_hu() < least_brightness * brightest; });
  for (const DiscColumn* column : even) {
    const bool behind = std::any_of(even.begin(), even.end(), [&](const DiscColumn* other) {
      return mean_y(*column) - mean_y(*other) > behind_mm;
    });
    if (!behind && lung_behind(image, *column) < most_lung) return column;
  }
  return nullptr;
}

std::string seen(const imaging::ImageVolume& image, const std::vector<DiscColumn>& columns) {
  if (columns.empty()) return "no upright tube of contrast is there";
  const DiscColumn& longest = columns.front();
  return "the longest upright tube has a radius of " + rounded_text(longest.mean_radius_mm(), 0) +
         " mm and " + rounded_text(longest.mean_hu(), 0) + " HU" +
         (lung_behind(image, longest) < most_lung ? " and is not even enough"
                                                  : ", and lung behind it as the descending aorta has");
}

AortaStation station(const DiscFit& disc, const Vec3& tangent) {
  return {disc.centre, tangent, disc.radius_mm, disc.round};
}

}  // namespace

void validate(const AortaOptions& options) {
  const auto within = [](const char* name, double value, double low, double high, const char* unit) {
    if (!(value >= low && value <= high))
      throw InvalidInput(std::string("the aorta's ") + name + " is " + std::to_string(value) + unit +
                         "; give " + std::to_string(low) + " to " + std::to_string(high));
  };
  within("least intensity", options.least_hu, 100.0, 400.0, " HU");
  within("largest intensity", options.most_hu, options.least_hu, 4000.0, " HU");
  within("smallest radius", options.smallest_radius_mm, 5.0, 20.0, " mm");
  within("largest radius", options.largest_radius_mm, options.smallest_radius_mm + 1.0, 40.0, " mm");
  within("working spacing", options.work_spacing_mm, 1.0, 3.0, " mm");
  within("least column", options.least_column_mm, 6.0, 60.0, " mm");
}

Aorta find_aorta(const imaging::ImageVolume& image, const AortaOptions& options,
                 const core::TaskContext& task) {
  validate(options);
  const imaging::ImageVolume work = working_image(image, options.work_spacing_mm, task.sub(0.0, 0.2));
  const std::vector<DiscColumn> columns = disc_columns(work, column_options(options), task.sub(0.2, 0.8));
  const DiscColumn* column = ascending(work, columns, options.most_hu);
  if (column == nullptr)
    throw GeometryError("no ascending aorta was found (an upright, evenly enhanced tube of " +
                        rounded_text(options.smallest_radius_mm, 0) + " to " +
                        rounded_text(options.largest_radius_mm, 0) + " mm radius above " +
                        rounded_text(options.least_hu, 0) + " HU, at least " +
                        rounded_text(options.least_column_mm, 0) + " mm long): " + seen(work, columns) +
                        "; draw a first vessel by its two ends instead");
  FollowOptions follow;
  follow.disc = column_options(options).disc;
  std::vector<DiscFit> way = column->discs;
  const std::vector<TubeSection> up = follow_tube(work, way, follow, task.sub(0.8, 0.9));
  std::reverse(way.begin(), way.end());
  const std::vector<TubeSection> down = follow_tube(work, way, follow, task.sub(0.9, 1.0));

  Aorta aorta;
  std::vector<double> sd;
  for (auto section = down.rbegin(); section != down.rend(); ++section)
    aorta.stations.push_back(station(section->disc, -section->tangent));
  for (std::size_t i = 0; i < column->discs.size(); ++i) {
    const std::vector<DiscFit>& discs = column->discs;
    const Vec3 chord = discs[std::min(i + 2, discs.size() - 1)].centre - discs[i < 2 ? 0 : i - 2].centre;
    aorta.stations.push_back(station(discs[i], chord.normalized()));
    sd.push_back(discs[i].sd_hu);
  }
  for (const TubeSection& section : up) aorta.stations.push_back(station(section.disc, section.tangent));
  aorta.lumen_hu = column->mean_hu();
  aorta.noise_hu = median(sd);
  task.set_progress(1.0);
  return aorta;
}

}  // namespace ostia::coronary
