#pragma once
/// \file The function that interpolates a vessel's wall ([Wels] eq. 1).

#include "ostia/lumen/kernel.h"
#include "ostia/lumen/scalar_field.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::lumen {

/// f(p) = sum_j c_j phi(|p - p_j| / alpha) + q0 + q1 x + q2 y + q3 z. Negative inside.
struct ImplicitCoefficients {
  Kernel kernel = Kernel::wendland_c2;
  double support_radius_mm = 0.0;  ///< alpha
  std::vector<Vec3> centres;       ///< in the order of the vessel
  std::vector<double> weights;     ///< c_j
  std::array<double, 4> polynomial{0.0, 0.0, 0.0, 0.0};
};

/// Evaluates f and its gradient. Centres lie in a grid of cells, so that a place asks its neighbours alone.
/// Where no centre reaches, f is the polynomial. The centres within reach are summed in one order, so that f
/// at a place has the same bits however it is asked, alone or in any batch, on any number of threads and with
/// or without AVX2.
class ImplicitSurface final : public ScalarField {
 public:
  explicit ImplicitSurface(ImplicitCoefficients coefficients);  ///< throws InvalidInput
  ~ImplicitSurface() override;
  ImplicitSurface(ImplicitSurface&&) noexcept;
  ImplicitSurface& operator=(ImplicitSurface&&) noexcept;

  double value(const Vec3& place) const override;
  Vec3 gradient(const Vec3& place) const override;
  FieldSample value_and_gradient(const Vec3& place) const override;
  void values(std::span<const Vec3> places, std::span<double> out) const override;
  Box3 box() const override;  ///< around all centres, by alpha
  const ImplicitCoefficients& coefficients() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::lumen
