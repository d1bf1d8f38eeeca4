#include "hilbert_order.h"

#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <utility>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

constexpr int bits_of_cell = 10;  // of each coordinate: finer cells save no steps

// Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707, 2004.
std::uint64_t hilbert_number(std::array<std::uint32_t, 3> x) {
  constexpr std::uint32_t highest = 1u << (bits_of_cell - 1);
  for (std::uint32_t q = highest; q > 1; q >>= 1)
    for (std::uint32_t& value : x) {
      const std::uint32_t below = q - 1;
      const std::uint32_t exchange = (x[0] ^ value) & below;
      const bool invert = (value & q) != 0;
      x[0] ^= invert ? below : exchange;
      value ^= invert ? 0 : exchange;
    }
  for (std::size_t i = 1; i < 3; ++i) x[i] ^= x[i - 1];
  std::uint32_t turned = 0;
  for (std::uint32_t q = highest; q > 1; q >>= 1)
    if ((x[2] & q) != 0) turned ^= q - 1;
  for (std::uint32_t& value : x) value ^= turned;
  std::uint64_t number = 0;
  for (int bit = bits_of_cell - 1; bit >= 0; --bit)
    for (const std::uint32_t value : x) number = number << 1 | (value >> bit & 1u);
  return number;
}

// Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014.
std::uint64_t hash_of(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15u;
  number = (number ^ number >> 30) * 0xbf58476d1ce4e5b9u;
  number = (number ^ number >> 27) * 0x94d049bb133111ebu;
  return number ^ number >> 31;
}

}  // namespace

std::vector<std::int32_t> along_hilbert_curve(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  const geometry::Box3 box = geometry::bounds(points);
  const double extent = box.sizes().maxCoeff();
  constexpr double last_cell = (1u << bits_of_cell) - 1;
  const double scale = extent > 0.0 ? last_cell / extent : 0.0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> numbered(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 cell = (points[i] - box.min()) * scale;
    const auto whole = [&](Eigen::Index k) {
      return static_cast<std::uint32_t>(std::clamp(cell[k], 0.0, last_cell));
    };
    numbered[i] = {hilbert_number({whole(0), whole(1), whole(2)}), static_cast<std::int32_t>(i)};
  }
  std::ranges::sort(numbered);
  std::vector<std::int32_t> order;
  order.reserve(points.size());
  for (const auto& [number, point] : numbered) order.push_back(point);
  return order;
}

std::vector<std::int32_t> in_rounds(const std::vector<std::int32_t>& along_curve) {
  const std::size_t count = along_curve.size();
  std::vector<std::uint8_t> round(count);  // 0: the last and largest
  std::array<std::size_t, 33> first{};
  for (std::size_t i = 0; i < count; ++i) {
    round[i] = static_cast<std::uint8_t>(
        std::countr_zero(hash_of(static_cast<std::uint64_t>(along_curve[i])) | std::uint64_t{1} << 62) / 2);
    ++first[round[i]];
  }
  std::size_t place = 0;
  for (std::size_t r = first.size(); r-- > 0;) place += std::exchange(first[r], place);
  std::vector<std::int32_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[first[round[i]]++] = along_curve[i];
  return order;
}

}  // namespace ostia::centerline
