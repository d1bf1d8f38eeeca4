#include "ostia/lumen/kernel.h"

#include "ostia/core/error.h"

#include <array>

namespace ostia::lumen {
namespace {

constexpr std::array<const char*, 3> names{"morse-c0", "wendland-c2", "wendland-c4"};

}  // namespace

double phi(Kernel kernel, double x) {
  if (x >= 1.0) return 0.0;
  const double u = 1.0 - x, u2 = u * u;
  switch (kernel) {
    case Kernel::morse_c0:
      return u2;
    case Kernel::wendland_c2:
      return u2 * u2 * (4.0 * x + 1.0);
    case Kernel::wendland_c4:
      return u2 * u2 * u2 * ((35.0 * x + 18.0) * x + 3.0) / 3.0;
  }
  return 0.0;
}

double phi_slope_over_x(Kernel kernel, double x) {
  if (x >= 1.0) return 0.0;
  const double u = 1.0 - x, u2 = u * u;
  switch (kernel) {
    case Kernel::morse_c0:
      return x > 0.0 ? -2.0 * u / x : 0.0;
    case Kernel::wendland_c2:
      return -20.0 * u2 * u;
    case Kernel::wendland_c4:
      return -(56.0 / 3.0) * u2 * u2 * u * (5.0 * x + 1.0);
  }
  return 0.0;
}

double phi_slope(Kernel kernel, double x) {
  if (kernel == Kernel::morse_c0) return x < 1.0 ? -2.0 * (1.0 - x) : 0.0;
  return x * phi_slope_over_x(kernel, x);
}

std::string name(Kernel kernel) {
  return names[static_cast<std::size_t>(kernel)];
}

Kernel kernel_named(const std::string& wanted) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (wanted == names[i]) return static_cast<Kernel>(i);
  }
  throw InvalidInput("there is no kernel \"" + wanted + "\"; choose morse-c0, wendland-c2 or wendland-c4");
}

}  // namespace ostia::lumen
