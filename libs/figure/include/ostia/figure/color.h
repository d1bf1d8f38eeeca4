#pragma once
/// \file Colours that colour-blind readers can tell apart, and the two looks of a figure.

#include <cstddef>
#include <string>

namespace ostia::figure {

/// sRGB components and opacity, each in [0, 1].
struct Color {
  double r = 0.0, g = 0.0, b = 0.0, a = 1.0;
  friend bool operator==(const Color&, const Color&) = default;
};

/// The colours of Okabe and Ito (2008) in an order that suits both looks: orange, sky blue, bluish green,
/// vermilion, reddish purple, blue, yellow; the eighth is grey; then from the start again.
Color palette(std::size_t index);

namespace colors {
inline constexpr Color lumen{0.84, 0.37, 0.28};       ///< a vessel's wall
inline constexpr Color centerline{0.94, 0.89, 0.26};  ///< Okabe-Ito yellow
inline constexpr Color contour{0.90, 0.62, 0.00};     ///< Okabe-Ito orange
inline constexpr Color inlet{0.00, 0.45, 0.70};       ///< Okabe-Ito blue
inline constexpr Color outlet{0.00, 0.62, 0.45};      ///< Okabe-Ito bluish green
inline constexpr Color cut{0.34, 0.71, 0.91};         ///< Okabe-Ito sky blue: inside of a mesh cut open
inline constexpr Color bone{0.87, 0.85, 0.80};
}  // namespace colors

Color mixed(const Color& a, const Color& b, double share_of_b);
std::string hex(const Color& color);  ///< "#rrggbb"

enum class Look { dark, light };

/// What a look's parts are painted with.
struct Theme {
  Color background, panel, foreground, muted, grid;
};
Theme theme(Look look);

}  // namespace ostia::figure
