#pragma once
/// \file Colours as DICOM has them (PS3.3 C.10.7.1.1).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace ostia::dicom {

/// CIE L*a*b* (D50) of sRGB in [0, 1], each scaled to 16 bits: L from 0 to 100, a and b from -128 to 127. By
/// the matrix of sRGB adapted to D50 (Lindbloom).
inline std::array<std::uint16_t, 3> cie_lab(const std::array<double, 3>& rgb) {
  std::array<double, 3> linear{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = std::clamp(rgb[i], 0.0, 1.0);
    linear[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  const auto [r, g, b] = linear;
  const std::array<double, 3> xyz{(0.4360747 * r + 0.3850649 * g + 0.1430804 * b) / 0.96422,
                                  0.2225045 * r + 0.7168786 * g + 0.0606169 * b,
                                  (0.0139322 * r + 0.0971045 * g + 0.7141733 * b) / 0.82521};
  std::array<double, 3> f{};
  for (std::size_t i = 0; i < 3; ++i)
    f[i] = xyz[i] > 216.0 / 24389.0 ? std::cbrt(xyz[i]) : (24389.0 / 27.0 * xyz[i] + 16.0) / 116.0;
  const double l = 116.0 * f[1] - 16.0, a = 500.0 * (f[0] - f[1]), bb = 200.0 * (f[1] - f[2]);
  const auto scaled = [](double v, double from, double to) {
    return static_cast<std::uint16_t>(std::lround(std::clamp((v - from) / (to - from), 0.0, 1.0) * 65535.0));
  };
  return {scaled(l, 0.0, 100.0), scaled(a, -128.0, 127.0), scaled(bb, -128.0, 127.0)};
}

}  // namespace ostia::dicom
