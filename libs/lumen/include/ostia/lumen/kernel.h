#pragma once
/// \file Compactly supported radial basis functions.

#include <string>

namespace ostia::lumen {

/// phi of x = r / alpha, zero from x = 1 on; all positive definite in three dimensions.
enum class Kernel {
  morse_c0,     ///< (1 - x)^2, [Wels] 2.2 after Morse et al. 2001: C0 at its centre
  wendland_c2,  ///< (1 - x)^4 (4 x + 1), Wendland 1995
  wendland_c4,  ///< (1 - x)^6 (35 x^2 + 18 x + 3) / 3
};

double phi(Kernel kernel, double x);
double phi_slope(Kernel kernel, double x);  ///< d phi / d x
/// (d phi / d x) / x, finite at 0 but for morse_c0 (0 there, where its gradient is not defined).
double phi_slope_over_x(Kernel kernel, double x);
std::string name(Kernel kernel);               ///< "morse-c0", "wendland-c2", "wendland-c4"
Kernel kernel_named(const std::string& name);  ///< throws InvalidInput, naming the choices

}  // namespace ostia::lumen
