#pragma once
/// \file What is known of the sizes and branching of pigs' coronary arteries. See
/// docs/methods/tree-growth.md.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ostia::analysis {

/// Orders are diameter-defined Strahler orders, elements are segments of one order in series. Order 0 are the
/// capillaries: what springs from order n of them is known, their own sizes are not.
struct Morphometry {
  struct Order {
    double diameter_mm, diameter_sd_mm;  ///< of elements; SD 0: of one element alone
    double length_mm, length_sd_mm;
    double segments_per_element;
    double elements;  ///< in one whole tree
  };
  std::string name;
  std::vector<Order> orders;  ///< from order 1
  std::vector<std::vector<double>>
      connectivity;  ///< [n - 1][m]: elements of order m that spring from one of n

  std::int32_t highest() const { return static_cast<std::int32_t>(orders.size()); }
  const Order& order(std::int32_t n) const { return orders[static_cast<std::size_t>(n - 1)]; }
  double springs(std::int32_t m, std::int32_t n) const {
    return connectivity[static_cast<std::size_t>(n - 1)][static_cast<std::size_t>(m)];
  }
  /// The widest of order n: half way from mean + SD to the next order's mean - SD; infinity for the highest.
  double upper_mm(std::int32_t n) const;
  std::int32_t order_of(double diameter_mm) const;
};

enum class CoronaryArtery { right, left_anterior, circumflex };
/// Kassab, Rider, Tang, Fung 1993, Am J Physiol 265:H350, tables 1-3 and 5-9 (pigs of about 30 kg).
const Morphometry& coronary_morphometry(CoronaryArtery artery);

}  // namespace ostia::analysis
