#pragma once
/// \file Values that are known at rising abscissas, looked up between them.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>

namespace ostia::geometry {

/// Between values `index` and `index` + 1, at `part` of the way, 0 to 1.
struct PlaceAlong {
  std::size_t index = 0;
  double part = 0.0;

  double between(double here, double next) const { return (1.0 - part) * here + part * next; }
};

/// Where `s` lies among two or more values of rising abscissas `s_of(value)`; beyond the ends, at the end.
template <typename Values, typename Abscissa = std::identity>
PlaceAlong place_along(const Values& values, double s, Abscissa s_of = {}) {
  const auto begin = std::ranges::begin(values), end = std::ranges::end(values);
  const auto next = std::ranges::lower_bound(begin + 1, end - 1, s, {}, s_of);
  const double before = std::invoke(s_of, *(next - 1)), length = std::invoke(s_of, *next) - before;
  return {static_cast<std::size_t>(next - begin) - 1,
          length > 0.0 ? std::clamp((s - before) / length, 0.0, 1.0) : 0.0};
}

/// `value_of` at `s`, linear between values; of one value alone, or beyond the ends, that of the end.
template <typename Values, typename Abscissa, typename Value>
double value_along(const Values& values, double s, Abscissa s_of, Value value_of) {
  const auto begin = std::ranges::begin(values);
  if (std::ranges::end(values) - begin < 2) return std::invoke(value_of, *begin);
  const PlaceAlong place = place_along(values, s, s_of);
  const auto here = begin + static_cast<std::ptrdiff_t>(place.index);
  return place.between(std::invoke(value_of, *here), std::invoke(value_of, *(here + 1)));
}

}  // namespace ostia::geometry
