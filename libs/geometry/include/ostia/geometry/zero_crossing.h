#pragma once
/// \file Where a function of one variable changes its sign.

#include <cmath>

namespace ostia::geometry {

struct ZeroTolerance {
  double value = 1e-13;    ///< |f| that is as good as zero
  double bracket = 1e-15;  ///< width of the bracket that ends the search
  int most_iterations = 100;
};

/// The zero of f in [0, 1], where f(0) and f(1) have opposite signs: regula falsi, its bracket kept, in the
/// Illinois variant (Dowell and Jarratt 1971). Where they have the same sign, the end at which f is smaller.
template <class Function>
double zero_crossing(const Function& f, const ZeroTolerance& tolerance = {}) {
  double ta = 0.0, tb = 1.0, fa = f(0.0), fb = f(1.0);
  if ((fa < 0.0) == (fb < 0.0)) return std::abs(fa) < std::abs(fb) ? 0.0 : 1.0;
  double t = 0.5;
  int side = 0;
  for (int iteration = 0; iteration < tolerance.most_iterations; ++iteration) {
    t = (fb * ta - fa * tb) / (fb - fa);
    const double ft = f(t);
    if (std::abs(ft) < tolerance.value || std::abs(tb - ta) < tolerance.bracket) break;
    if ((ft < 0.0) == (fa < 0.0)) {
      ta = t;
      fa = ft;
      if (side == -1) fb *= 0.5;
      side = -1;
    } else {
      tb = t;
      fb = ft;
      if (side == 1) fa *= 0.5;
      side = 1;
    }
  }
  return t;
}

}  // namespace ostia::geometry
