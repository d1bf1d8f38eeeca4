#include "heart_chambers.h"

#include "working_image.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

namespace ostia::coronary {
namespace {

constexpr double least_core_ml = 2.0;
// In images that lie right the chambers' core is 34 to 50 mm below the middle of what is found of the aorta,
// 10 to 24 mm to its left and 12 to 32 mm behind it.
constexpr double most_above_mm = 5.0, most_aside_mm = 5.0, most_before_mm = 20.0;

Vec3 place_of(const imaging::Geometry& grid, std::int64_t i, std::int64_t j, std::int64_t k) {
  return grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
}

/// Offsets of voxels within a ball.
std::vector<std::array<std::int64_t, 3>> ball(const imaging::Geometry& grid, double radius_mm) {
  std::array<std::int64_t, 3> reach{};
  for (std::size_t a = 0; a < 3; ++a)
    reach[a] = static_cast<std::int64_t>(radius_mm / grid.spacing[static_cast<Eigen::Index>(a)]);
  std::vector<std::array<std::int64_t, 3>> offsets;
  for (std::int64_t k = -reach[2]; k <= reach[2]; ++k)
    for (std::int64_t j = -reach[1]; j <= reach[1]; ++j)
      for (std::int64_t i = -reach[0]; i <= reach[0]; ++i)
        if (Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))
                .cwiseProduct(grid.spacing)
                .norm() <= radius_mm)
          offsets.push_back({i, j, k});
  return offsets;
}

/// Whether all voxels of the ball about one are set; beyond the image there is none.
bool holds_ball(const imaging::MaskVolume& mask, const std::vector<std::array<std::int64_t, 3>>& offsets,
                std::int64_t i, std::int64_t j, std::int64_t k) {
  const imaging::Geometry& grid = mask.geometry;
  for (const auto& o : offsets) {
    const std::int64_t x = i + o[0], y = j + o[1], z = k + o[2];
    if (x < 0 || y < 0 || z < 0 || x >= grid.size[0] || y >= grid.size[1] || z >= grid.size[2]) return false;
    if (mask(x, y, z) == 0) return false;
  }
  return true;
}

bool in_aorta(const Aorta& aorta, const Vec3& place) {
  constexpr double margin_mm = 3.0;
  return std::any_of(aorta.stations.begin(), aorta.stations.end(), [&](const AortaStation& station) {
    return (place - station.centre).norm() < station.radius_mm + margin_mm;
  });
}

}  // namespace

HeartChambers chambers_beside(const imaging::ImageVolume& image, const Aorta& aorta,
                              const core::TaskContext& task) {
  constexpr double spacing_mm = 2.5, depth_mm = 7.0, reach_mm = 130.0, wall_hu = 60.0;
  // The left heart is as bright as the aorta; kidneys, liver and bone are not.
  constexpr double least_share = 0.7, most_share = 1.3;
  const imaging::ImageVolume work = working_image(image, spacing_mm, task);
  const imaging::Geometry& grid = work.geometry;
  HeartChambers heart;
  for (const AortaStation& station : aorta.stations) heart.middle += station.centre;
  heart.middle /= static_cast<double>(aorta.stations.size());
  heart.lower_end = aorta.stations.front().centre;
  const double contrast = aorta.lumen_hu - wall_hu;
  const double low = wall_hu + least_share * contrast, high = wall_hu + most_share * contrast;
  imaging::MaskVolume bright{grid, std::vector<std::uint8_t>(work.voxels.size(), 0)};
  core::parallel_for(static_cast<std::size_t>(grid.size[2]), 1, [&](std::size_t slice) {
    task.throw_if_cancelled();
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const double value = work(i, j, k);
        if (value < low || value > high) continue;
        const Vec3 place = place_of(grid, i, j, k);
        if ((place - heart.lower_end).norm() > reach_mm || in_aorta(aorta, place)) continue;
        bright(i, j, k) = 1;
      }
  });
  const auto offsets = ball(grid, depth_mm);
  const double voxel_ml = grid.spacing.prod() / 1000.0;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        if (bright(i, j, k) == 0 || !holds_ball(bright, offsets, i, j, k)) continue;
        heart.core_ml += voxel_ml;
        heart.core += voxel_ml * place_of(grid, i, j, k);
      }
  if (heart.core_ml > 0.0) heart.core /= heart.core_ml;
  return heart;
}

HeartVerdict judge(const HeartChambers& heart) {
  HeartVerdict verdict;
  if (heart.core_ml < least_core_ml) {
    verdict.refusal =
        "no heart was found below the aorta: no chamber as bright as it and wider than 14 mm lies within "
        "130 mm of its lower end (" +
        std::to_string(std::lround(heart.core_ml)) +
        " ml); the image may end above the aortic root or show another part of the body; take an image of "
        "the whole heart, or draw a first vessel by its two ends";
    return verdict;
  }
  const Vec3 way = heart.core - heart.middle;
  if (way.z() > most_above_mm)
    verdict.refusal = "the heart's chambers lie " + std::to_string(std::lround(way.z())) +
                      " mm above the middle of the aorta that was found, not below it: the image ends above "
                      "the aortic root, stands on its head, or has its slices in the wrong order; take an "
                      "image of the whole heart, set its orientation right, or draw a first vessel by its "
                      "two ends";
  else if (way.x() < -most_aside_mm || way.y() < -most_before_mm)
    verdict.warning = std::string("the left heart lies to the ") +
                      (way.x() < -most_aside_mm ? "right of" : "front of") +
                      " the aorta: the image may be mirrored or turned, or the heart lies on the right side; "
                      "no vessel was given a name; look at the image's orientation first";
  return verdict;
}

namespace {

constexpr double even_region_ml = 10.0;

/// What the brightest region of one tissue has, in HU; nothing where there is none of that size.
std::optional<double> brightest_even_hu(const imaging::ImageVolume& image, const core::TaskContext& task) {
  constexpr double spacing_mm = 4.0, even_hu = 45.0;
  const imaging::ImageVolume work = working_image(image, spacing_mm, task);
  const imaging::Geometry& grid = work.geometry;
  std::vector<double> even;  // means of cubes of three voxels that hold one tissue
  for (std::int64_t k = 1; k + 1 < grid.size[2]; ++k)
    for (std::int64_t j = 1; j + 1 < grid.size[1]; ++j)
      for (std::int64_t i = 1; i + 1 < grid.size[0]; ++i) {
        double sum = 0.0, squares = 0.0;
        for (std::int64_t n = 0; n < 27; ++n) {
          const double value = work(i - 1 + n % 3, j - 1 + n / 3 % 3, k - 1 + n / 9);
          sum += value;
          squares += value * value;
        }
        const double mean = sum / 27.0;
        if (squares / 27.0 - mean * mean < even_hu * even_hu) even.push_back(mean);
      }
  const auto count = static_cast<std::size_t>(even_region_ml * 1000.0 / grid.spacing.prod());
  if (even.size() <= count) return std::nullopt;
  std::nth_element(even.begin(), even.begin() + static_cast<std::ptrdiff_t>(count), even.end(),
                   std::greater<>());
  return even[count];
}

/// Empty where there is contrast agent.
std::string lack_of_contrast(double brightest_hu) {
  constexpr double contrast_hu = 120.0;
  if (brightest_hu >= contrast_hu) return "";
  return "; the brightest even region of " + std::to_string(std::lround(even_region_ml)) + " ml has " +
         std::to_string(std::lround(brightest_hu)) +
         " HU, as blood without contrast agent: take the angiogram of this patient";
}

}  // namespace

std::string why_no_contrast(const imaging::ImageVolume& image, const core::TaskContext& task) {
  const std::optional<double> brightest = brightest_even_hu(image, task);
  return brightest ? lack_of_contrast(*brightest) : "";
}

std::string why_no_aorta(const imaging::ImageVolume& image, const core::TaskContext& task) {
  const std::optional<double> brightest = brightest_even_hu(image, task);
  if (!brightest) return "";
  const std::string lacks = lack_of_contrast(*brightest);
  return lacks.empty() ? "; contrast is there (" + std::to_string(std::lround(*brightest)) +
                             " HU): the top of the heart may be cut off, or the image may be turned; look "
                             "at its orientation"
                       : lacks;
}

}  // namespace ostia::coronary
