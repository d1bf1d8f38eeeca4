#include "ostia/figure/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ostia::figure {

Color palette(std::size_t index) {
  static constexpr std::array<Color, 8> kColors{{{0.90, 0.62, 0.00},
                                                 {0.34, 0.71, 0.91},
                                                 {0.00, 0.62, 0.45},
                                                 {0.84, 0.37, 0.00},
                                                 {0.80, 0.47, 0.65},
                                                 {0.00, 0.45, 0.70},
                                                 {0.94, 0.89, 0.26},
                                                 {0.55, 0.55, 0.55}}};
  return kColors[index % kColors.size()];
}

Color mixed(const Color& a, const Color& b, double share_of_b) {
  const double s = std::clamp(share_of_b, 0.0, 1.0);
  return {a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b), a.a + s * (b.a - a.a)};
}

std::string hex(const Color& color) {
  const auto byte = [](double c) {
    return static_cast<unsigned>(std::lround(std::clamp(c, 0.0, 1.0) * 255.0));
  };
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", byte(color.r), byte(color.g), byte(color.b));
  return text.data();
}

Theme theme(Look look) {
  if (look == Look::dark) {
    return {{0.075, 0.082, 0.098},
            {0.110, 0.120, 0.141},
            {0.91, 0.92, 0.94},
            {0.60, 0.63, 0.68},
            {0.24, 0.26, 0.30}};
  }
  return {
      {1.0, 1.0, 1.0}, {0.965, 0.97, 0.978}, {0.10, 0.12, 0.15}, {0.40, 0.43, 0.48}, {0.86, 0.875, 0.895}};
}

}  // namespace ostia::figure
