#include "mask_rim.h"

#include "ostia/imaging/filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace ostia::coronary {
namespace {

using imaging::MaskVolume;

constexpr double rough_from = 0.05;
constexpr int pit_neighbours = 4;        // of six
constexpr std::int64_t about = 2;        // voxels to each side, where the brightest place is looked for
constexpr float least_brightest = 0.3F;  // of the blurred mask: no vessel is dimmer
constexpr float least_share = 0.35F, most_share = 0.6F;

/// Calls visit with the number of a voxel's neighbours across its faces that are inside.
template <class Visit>
void for_all_face_counts(const MaskVolume& mask, const Visit& visit) {
  const auto& size = mask.geometry.size;
  const std::array<std::int64_t, 3> stride{1, size[0], size[0] * size[1]};
  std::int64_t n = 0;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i, ++n) {
        const std::array<std::int64_t, 3> at{i, j, k};
        int inside = 0;
        for (std::size_t d = 0; d < 3; ++d) {
          if (at[d] > 0 && mask.voxels[static_cast<std::size_t>(n - stride[d])] != 0) ++inside;
          if (at[d] + 1 < size[d] && mask.voxels[static_cast<std::size_t>(n + stride[d])] != 0) ++inside;
        }
        visit(static_cast<std::size_t>(n), inside);
      }
}

/// The largest value within `about` voxels, axis by axis.
std::vector<float> brightest_about(const imaging::FloatVolume& image) {
  const auto& size = image.geometry.size;
  const std::array<std::int64_t, 3> stride{1, size[0], size[0] * size[1]};
  std::vector<float> values = image.voxels, next = values;
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::int64_t n = 0; n < static_cast<std::int64_t>(values.size()); ++n) {
      const std::int64_t at = n / stride[d] % size[d];
      const std::int64_t first = std::max<std::int64_t>(0, at - about),
                         last = std::min(size[d] - 1, at + about);
      float most = 0.0F;
      for (std::int64_t p = first; p <= last; ++p)
        most = std::max(most, values[static_cast<std::size_t>(n + (p - at) * stride[d])]);
      next[static_cast<std::size_t>(n)] = most;
    }
    values = next;
  }
  return values;
}

/// The share above which as many voxels lie as the object has.
float share_that_keeps_volume(const std::vector<float>& shares, std::size_t object) {
  std::vector<float> candidates;
  for (const float share : shares)
    if (share > 0.5F * least_share) candidates.push_back(share);
  if (candidates.size() < object || object == 0) return least_share;
  const auto last = candidates.begin() + static_cast<std::ptrdiff_t>(object - 1);
  std::nth_element(candidates.begin(), last, candidates.end(), std::greater<>());
  return std::clamp(*last, least_share, most_share);
}

/// The label of the nearest voxel of the object.
std::uint8_t label_near(const MaskVolume& mask, std::int64_t n) {
  const auto& size = mask.geometry.size;
  const std::int64_t i = n % size[0], j = n / size[0] % size[1], k = n / (size[0] * size[1]);
  double nearest = 1e300;
  std::uint8_t label = 0;
  for (std::int64_t c = std::max<std::int64_t>(0, k - about); c <= std::min(size[2] - 1, k + about); ++c)
    for (std::int64_t b = std::max<std::int64_t>(0, j - about); b <= std::min(size[1] - 1, j + about); ++b)
      for (std::int64_t a = std::max<std::int64_t>(0, i - about); a <= std::min(size[0] - 1, i + about);
           ++a) {
        const std::uint8_t there = mask(a, b, c);
        if (there == 0) continue;
        const geometry::Vec3 step(static_cast<double>(a - i), static_cast<double>(b - j),
                                  static_cast<double>(c - k));
        const double away = step.cwiseProduct(mask.geometry.spacing).squaredNorm();
        if (away < nearest) nearest = away, label = there;
      }
  return label;
}

}  // namespace

double rim_roughness(const MaskVolume& mask) {
  std::int64_t pits = 0, rim = 0;
  for_all_face_counts(mask, [&](std::size_t n, int inside) {
    if (mask.voxels[n] != 0)
      rim += inside < 6 ? 1 : 0;
    else
      pits += inside >= pit_neighbours ? 1 : 0;
  });
  return rim > 0 ? static_cast<double>(pits) / static_cast<double>(rim) : 0.0;
}

bool smooth_rough_rim(MaskVolume& mask, const core::TaskContext& task) {
  if (rim_roughness(mask) < rough_from) return false;
  imaging::FloatVolume inside{mask.geometry, std::vector<float>(mask.voxels.size())};
  std::transform(mask.voxels.begin(), mask.voxels.end(), inside.voxels.begin(),
                 [](std::uint8_t label) { return label != 0 ? 1.0F : 0.0F; });
  const auto object = static_cast<std::size_t>(std::count(inside.voxels.begin(), inside.voxels.end(), 1.0F));
  inside = imaging::gaussian_blurred(inside, std::cbrt(mask.geometry.spacing.prod()), task);
  std::vector<float> shares = brightest_about(inside);
  for (std::size_t n = 0; n < shares.size(); ++n)
    shares[n] = inside.voxels[n] / std::max(shares[n], least_brightest);
  const float least = share_that_keeps_volume(shares, object);
  MaskVolume smooth = mask;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    const bool is_inside = shares[n] >= least;
    if (is_inside && mask.voxels[n] == 0)
      smooth.voxels[n] = label_near(mask, static_cast<std::int64_t>(n));
    else if (!is_inside)
      smooth.voxels[n] = 0;
  }
  mask = std::move(smooth);
  return true;
}

}  // namespace ostia::coronary
