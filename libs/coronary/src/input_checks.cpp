#include "input_checks.h"

#include "heart_chambers.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace ostia::coronary {
namespace {

using core::rounded_text;

constexpr double least_field_mm = 30.0;        // a root and the first centimetres of the arteries
constexpr std::int64_t least_voxels = 12;      // along an axis
constexpr double coarsest_mm = 2.5;            // a voxel as wide as an artery
constexpr double coarse_mm = 1.0;              // an artery of 3 mm is three voxels
constexpr double least_span_hu = 250.0;        // fat to blood is more, in any CT angiogram
constexpr double darkest_expected_hu = -50.0;  // fat is darker, and every chest has some
constexpr double brightest_expected_hu = 0.0;  // soft tissue is brighter
constexpr double beyond_ct_hu = 3500.0;
constexpr double below_air_hu = -1150.0;
constexpr double most_below_air = 0.02;
constexpr double metal_hu = 2500.0;  // calcium and cortical bone are darker
constexpr double least_metal_ml = 0.1;
constexpr double least_kinship = 0.2;  // neighbours of a picture are akin (above 0.8), those of noise are not
constexpr double kin_mm = 3.0;
constexpr double chest_mm = 120.0;   // a field this wide about a heart holds lung
constexpr double least_lung = 0.04;  // skin and bowel have a per cent of such voxels
constexpr double brightest_lung_hu =
    -600.0;  // the darkest of a chest's lungs are below -700, and airways are air
// In chests at hand lung_at_sides is 2.0 to 2.8, in their halves 0.6 to 1; turned by 90 degrees it is one
// over that.
constexpr double least_at_sides = 0.55;
constexpr std::int64_t looked_at = 400'000;

constexpr const char* guided = "draw a first vessel by its two ends where you see one";

/// Every so many voxels, so that about `looked_at` are seen, spread over rows, columns and slices.
std::vector<std::array<std::int64_t, 3>> some_voxels(const imaging::Geometry& grid) {
  const double all = static_cast<double>(grid.voxels());
  const auto step = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(std::cbrt(all / static_cast<double>(looked_at)))));
  std::vector<std::array<std::int64_t, 3>> voxels;
  for (std::int64_t k = 0; k < grid.size[2]; k += std::min(step, grid.size[2]))
    for (std::int64_t j = 0; j < grid.size[1]; j += std::min(step, grid.size[1]))
      for (std::int64_t i = 0; i < grid.size[0]; i += std::min(step, grid.size[0]))
        voxels.push_back({i, j, k});
  return voxels;
}

double percentile(std::vector<std::int16_t>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Correlation of each voxel with those some millimetres farther along each axis.
double kinship(const imaging::ImageVolume& image, const std::vector<std::array<std::int64_t, 3>>& voxels) {
  const imaging::Geometry& grid = image.geometry;
  double n = 0.0, a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (const auto& at : voxels)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double voxel_mm = grid.spacing[static_cast<Eigen::Index>(axis)];
      auto other = at;
      other[axis] += std::max<std::int64_t>(1, std::lround(kin_mm / voxel_mm));
      if (other[axis] >= grid.size[axis]) continue;
      const double x = image(at[0], at[1], at[2]), y = image(other[0], other[1], other[2]);
      n += 1.0, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
    }
  if (n < 2.0) return 1.0;
  const double spread = (aa / n - a * a / (n * n)) * (bb / n - b * b / (n * n));
  return spread > 0.0 ? (ab / n - a * b / (n * n)) / std::sqrt(spread) : 1.0;
}

bool is_lung(std::int16_t value) {
  return value >= -940 && value <= -400;
}

double lung_at_sides(const imaging::ImageVolume& image,
                     const std::vector<std::array<std::int64_t, 3>>& voxels) {
  const imaging::Geometry& grid = image.geometry;
  const auto place = [&](const std::array<std::int64_t, 3>& at) {
    return grid.world(
        geometry::Vec3(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])));
  };
  const geometry::Vec3 first = place({0, 0, 0});
  const geometry::Vec3 middle = 0.5 * (first + place({grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1}));
  geometry::Vec3 reach = geometry::Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    reach += 0.5 * grid.spacing[axis] * static_cast<double>(grid.size[static_cast<std::size_t>(axis)]) *
             grid.direction.col(axis).cwiseAbs();
  std::array<double, 2> lung{}, all{};  // the middle third from front to back, from side to side
  for (const auto& at : voxels) {
    const geometry::Vec3 off = (place(at) - middle).cwiseAbs();
    for (const std::size_t band : {0U, 1U}) {
      const Eigen::Index axis = band == 0 ? 1 : 0;
      if (off[axis] > reach[axis] / 3.0) continue;
      all[band] += 1.0;
      lung[band] += is_lung(image(at[0], at[1], at[2])) ? 1.0 : 0.0;
    }
  }
  if (all[0] == 0.0 || all[1] == 0.0 || lung[1] == 0.0) return lung[0] > 0.0 ? 10.0 : 1.0;
  return lung[0] / all[0] * all[1] / lung[1];
}

}  // namespace

Intensities intensities_of(const imaging::ImageVolume& image) {
  if (image.voxels.empty()) throw InvalidInput("search for coronary arteries: the image has no voxels");
  const auto voxels = some_voxels(image.geometry);
  std::vector<std::int16_t> values;
  for (const auto& at : voxels) values.push_back(image(at[0], at[1], at[2]));
  Intensities result;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  result.lowest = *low;
  result.highest = *high;
  double below = 0.0, lung = 0.0, metal = 0.0;
  for (const std::int16_t value : values) {
    below += value < below_air_hu && value > *low ? 1.0 : 0.0;
    lung += is_lung(value) ? 1.0 : 0.0;
    metal += value > metal_hu ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(values.size());
  result.below_air = below / count;
  result.lung = lung / count;
  const imaging::Geometry& grid = image.geometry;
  result.metal_ml = metal / count * static_cast<double>(grid.voxels()) * grid.spacing.prod() / 1000.0;
  result.lung_at_sides = lung_at_sides(image, voxels);
  result.kinship = kinship(image, voxels);
  result.dark = percentile(values, 0.005);
  result.median = percentile(values, 0.5);
  result.bright = percentile(values, 0.995);
  return result;
}

/// A scan for the calcium score has thick slices: that it has no contrast agent either is said with them.
void require_grid(const imaging::ImageVolume& image) {
  const imaging::Geometry& grid = image.geometry;
  for (std::size_t a = 0; a < 3; ++a) {
    const double field_mm = grid.spacing[static_cast<Eigen::Index>(a)] * static_cast<double>(grid.size[a]);
    if (grid.size[a] < least_voxels || field_mm < least_field_mm)
      throw InvalidInput(
          "the image is too small to hold the root of the aorta: " + std::to_string(grid.size[0]) + " x " +
          std::to_string(grid.size[1]) + " x " + std::to_string(grid.size[2]) + " voxels, " +
          rounded_text(field_mm, 1) + " mm along one of its axes; " + rounded_text(least_field_mm, 0) +
          " mm and " + std::to_string(least_voxels) + " voxels are needed");
  }
  if (const double voxel_mm = grid.spacing.maxCoeff(); voxel_mm > coarsest_mm)
    throw InvalidInput("voxels of " + rounded_text(voxel_mm, 1) +
                       " mm are wider than coronary arteries, which are 2 to 4 mm wide (at most " +
                       rounded_text(coarsest_mm, 1) +
                       " mm can be used); take a series with thinner slices, or " + guided +
                       why_no_contrast(image));
}

void require_ct_numbers(const Intensities& v) {
  const std::string range = rounded_text(v.dark, 0) + " to " + rounded_text(v.bright, 0);
  if (v.lowest == v.highest)
    throw InvalidInput("the image is empty: every voxel is " + rounded_text(v.lowest, 0) +
                       "; take another image");
  if (v.kinship < least_kinship)
    throw InvalidInput("the image is noise: places " + rounded_text(kin_mm, 0) +
                       " mm apart have nothing in common (correlation " + rounded_text(v.kinship, 1) +
                       "); take another reconstruction");
  const std::string fat_and_blood = "in HU fat is about -100, blood with contrast agent 250 to 600";
  if (v.bright - v.dark < least_span_hu)
    throw InvalidInput("the intensities lie from " + range + " only, these are no CT numbers (" +
                       fat_and_blood + "): the image may have been scaled; convert it back to HU");
  if (v.dark < -beyond_ct_hu || v.bright > beyond_ct_hu)
    throw InvalidInput("the intensities lie from " + range + ", far beyond CT numbers (" + fat_and_blood +
                       "): the image may have been scaled; convert it back to HU");
  if (v.dark > darkest_expected_hu)
    throw InvalidInput("nothing in the image is darker than " + rounded_text(v.dark, 0) +
                       ", so these are no CT numbers (" + fat_and_blood + "): " +
                       (v.bright <= 255.0 ? "it may be a picture of 256 grey levels"
                                          : "1024 may not have been subtracted (the rescale intercept)") +
                       "; convert it to HU");
  if (v.bright < brightest_expected_hu || v.below_air > most_below_air)
    throw InvalidInput(std::string("the image is darker than a CT in HU can be (") +
                       (v.bright < brightest_expected_hu
                            ? "nothing in it is brighter than " + rounded_text(v.bright, 0)
                            : rounded_text(100.0 * v.below_air, 0) + " % lie below air, -1000") +
                       "): 1024 may have been subtracted twice, or the image scaled; convert it to HU");
  if (v.lung >= least_lung && v.dark > brightest_lung_hu)
    throw InvalidInput("nothing in the image is darker than " + rounded_text(v.dark, 0) + ", though " +
                       rounded_text(100.0 * v.lung, 0) +
                       " % of it is as dark as lung may be: lungs have -700 to -900 HU and air -1000, so the "
                       "image may have been scaled; convert it back to HU");
}

/// Extent in space along each of the image's axes, mm.
geometry::Vec3 field_of(const imaging::Geometry& grid) {
  return {grid.spacing.x() * static_cast<double>(grid.size[0]),
          grid.spacing.y() * static_cast<double>(grid.size[1]),
          grid.spacing.z() * static_cast<double>(grid.size[2])};
}

/// Which of the axes run across the patient is in the directions; two of three are as wide in any case.
bool holds_a_chest(const geometry::Vec3& field) {
  std::array<double, 3> wide{field.x(), field.y(), field.z()};
  std::sort(wide.begin(), wide.end());
  return wide[1] >= chest_mm;
}

void require_chest(const Intensities& values, const imaging::Geometry& grid) {
  const geometry::Vec3 field = field_of(grid);
  if (!holds_a_chest(field) || values.lung >= least_lung) return;
  throw GeometryError("the image shows no chest: it holds hardly any lung (" +
                      rounded_text(100.0 * values.lung, 1) + " % of " + rounded_text(field.x(), 0) + " x " +
                      rounded_text(field.y(), 0) + " x " + rounded_text(field.z(), 0) +
                      " mm), as abdomen, head or legs do; take an image of the heart, or " + guided);
}

InputNotes check_input(const imaging::ImageVolume& image) {
  require_grid(image);
  const Intensities values = intensities_of(image);
  require_ct_numbers(values);
  require_chest(values, image.geometry);
  InputNotes notes;
  std::vector<std::string>& warnings = notes.warnings;
  notes.turned = holds_a_chest(field_of(image.geometry)) && values.lung >= least_lung &&
                 values.lung_at_sides < least_at_sides;
  if (notes.turned)
    warnings.push_back(
        "the lungs lie in front and behind, not at the sides: x and y may be exchanged, or the image be "
        "turned by "
        "90 degrees; no vessel was given a name; look at the image's orientation first");
  const double voxel_mm = image.geometry.spacing.maxCoeff();
  if (voxel_mm > coarse_mm)
    warnings.push_back("voxels of " + rounded_text(voxel_mm, 1) +
                       " mm are wide for coronary arteries: those below 2 mm are missed, and names and "
                       "radii are less sure");
  if (values.metal_ml > least_metal_ml)
    warnings.push_back(rounded_text(values.metal_ml, 1) + " ml of metal (above " + rounded_text(metal_hu, 0) +
                       " HU): look at each vessel that passes near it, its shadows may cut or fake vessels");
  return notes;
}

}  // namespace ostia::coronary
