#include "ostia/lumen/implicit_surface.h"

#include "interpolation/kernel_sums.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/processor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ostia::lumen {
namespace {

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}
Vec3 in_box(std::mt19937_64& random, const Vec3& size) {
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return size.cwiseProduct(Vec3(x, y, z));
}

ImplicitCoefficients random_coefficients(Kernel kernel, double support, std::size_t centres,
                                         const Vec3& size) {
  std::mt19937_64 random(7);
  ImplicitCoefficients made;
  made.kernel = kernel;
  made.support_radius_mm = support;
  for (std::size_t i = 0; i < centres; ++i) {
    made.centres.push_back(in_box(random, size) - 0.5 * size + Vec3(100.0, -40.0, 7.0));
    made.weights.push_back(2.0 * uniform(random) - 1.0);
  }
  made.polynomial = {0.25, 0.01, -0.02, 0.03};
  return made;
}

std::vector<Vec3> places_around(const ImplicitSurface& surface, std::size_t count) {
  std::mt19937_64 random(11);
  const Box3 box = surface.box();
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < count; ++i)
    places.push_back(box.min() - Vec3::Ones() + in_box(random, box.sizes() + 2.0 * Vec3::Ones()));
  return places;
}

double summed(const ImplicitCoefficients& c, const Vec3& p) {
  double sum = c.polynomial[0] + c.polynomial[1] * p.x() + c.polynomial[2] * p.y() + c.polynomial[3] * p.z();
  for (std::size_t i = 0; i < c.centres.size(); ++i)
    sum += c.weights[i] * phi(c.kernel, (p - c.centres[i]).norm() / c.support_radius_mm);
  return sum;
}

class EachKernel : public ::testing::TestWithParam<Kernel> {};

TEST_P(EachKernel, EqualsTheSumOverAllCentres) {
  for (const double support : {0.4, 3.0, 60.0}) {
    const ImplicitSurface surface(random_coefficients(GetParam(), support, 500, {20.0, 9.0, 30.0}));
    const std::vector<Vec3> places = places_around(surface, 400);
    std::vector<double> values(places.size());
    surface.values(places, values);
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_NEAR(values[i], summed(surface.coefficients(), places[i]), 1e-12);
  }
}

TEST_P(EachKernel, SameBitsHoweverItIsAsked) {
  const ImplicitSurface surface(random_coefficients(GetParam(), 3.0, 900, {20.0, 9.0, 30.0}));
  std::vector<Vec3> places = places_around(surface, 700);
  for (std::size_t i = 0; i < 300; ++i)  // also neighbours, which share their centres
    places[i] = places[0] + 0.01 * static_cast<double>(i) * Vec3(1.0, 0.3, -0.2);
  std::vector<double> values(places.size()), others(places.size());
  surface.values(places, values);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(surface.value(places[i]), values[i]);
    EXPECT_EQ(surface.value_and_gradient(places[i]).value, values[i]);
    EXPECT_EQ(surface.value_and_gradient(places[i]).gradient, surface.gradient(places[i]));
  }
  core::set_max_threads(1);
  for (std::size_t first = 0, size = 1; first < places.size(); first += size, size = size * 2 % 61 + 1) {
    size = std::min(size, places.size() - first);
    surface.values(std::span(places).subspan(first, size), std::span(others).subspan(first, size));
  }
  core::set_max_threads(0);
  EXPECT_EQ(others, values);
}

TEST_P(EachKernel, SameBitsWithAndWithoutAvx2) {
  if (!core::has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  const KernelLoops plain = kernel_loops_baseline(GetParam()), wide = kernel_loops_avx2(GetParam());
  const std::size_t size = 133;
  std::mt19937_64 random(3);
  std::vector<std::vector<double>> arrays(4, std::vector<double>(size + list_padding));
  for (auto& array : arrays)
    for (double& v : array) v = 3.0 * uniform(random) - 1.5;
  const CentreList list{arrays[0].data(), arrays[1].data(), arrays[2].data(), arrays[3].data(), size};
  PlaceLanes lanes{};
  for (std::size_t k = 0; k < sum_lanes; ++k) {
    lanes.x[k] = uniform(random);
    lanes.y[k] = uniform(random);
    lanes.z[k] = uniform(random);
  }
  std::vector<double> a(size + list_padding), b(size + list_padding);
  plain.sums(0.6, list, lanes, a.data());
  wide.sums(0.6, list, lanes, b.data());
  for (std::size_t k = 0; k < sum_lanes; ++k) EXPECT_EQ(a[k], b[k]);
  const double place[3] = {0.1, -0.2, 0.3};
  plain.half_sums(0.6, list, lanes, b.data());
  for (std::size_t k = 0; k < sum_lanes / 2; ++k) EXPECT_EQ(a[k], b[k]);
  wide.half_sums(0.6, list, lanes, b.data());
  for (std::size_t k = 0; k < sum_lanes / 2; ++k) EXPECT_EQ(a[k], b[k]);
  plain.terms(0.6, list, place, a.data());
  wide.terms(0.6, list, place, b.data());
  for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(a[k], b[k]);
  plain.slopes(0.6, list, place, a.data());
  wide.slopes(0.6, list, place, b.data());
  for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(a[k], b[k]);
}

TEST_P(EachKernel, GradientIsTheSlope) {
  const ImplicitSurface surface(random_coefficients(GetParam(), 3.0, 300, {6.0, 6.0, 6.0}));
  for (const Vec3& place : places_around(surface, 100)) {
    const Vec3 gradient = surface.gradient(place);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = 1e-5 * Vec3::Unit(axis);
      EXPECT_NEAR(gradient[axis], (surface.value(place + step) - surface.value(place - step)) / 2e-5, 2e-5);
    }
  }
}

TEST_P(EachKernel, GradientAtACentreIsFinite) {
  ImplicitCoefficients one;
  one.kernel = GetParam();
  one.support_radius_mm = 2.0;
  one.centres = {{1.0, 2.0, 3.0}};
  one.weights = {-1.0};
  const ImplicitSurface surface(one);
  EXPECT_EQ(surface.gradient({1.0, 2.0, 3.0}), Vec3::Zero());
  EXPECT_EQ(surface.value({1.0, 2.0, 3.0}), -1.0);
  EXPECT_EQ(surface.value({1.0, 4.0, 3.0}), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachKernel,
                         ::testing::Values(Kernel::morse_c0, Kernel::wendland_c2, Kernel::wendland_c4),
                         [](const auto& tested) {
                           return "kernel" + std::to_string(static_cast<int>(tested.param));
                         });

TEST(ImplicitSurface, IsThePolynomialOutOfReach) {
  const ImplicitSurface surface(random_coefficients(Kernel::wendland_c2, 1.0, 50, {5.0, 5.0, 5.0}));
  const Vec3 far(-300.0, 20.0, 5.0);
  EXPECT_DOUBLE_EQ(surface.value(far), 0.25 - 3.0 - 0.4 + 0.15);
  EXPECT_EQ(surface.gradient(far), Vec3(0.01, -0.02, 0.03));
  const ImplicitCoefficients& c = surface.coefficients();
  for (const Vec3& centre : c.centres) EXPECT_TRUE(surface.box().contains(centre + Vec3(0.99, 0.0, 0.0)));
}

TEST(ImplicitSurface, CentresFarApartTakeLittleMemory) {
  ImplicitCoefficients c;
  c.support_radius_mm = 0.5;
  c.centres = {{0.0, 0.0, 0.0}, {9000.0, -9000.0, 9000.0}};
  c.weights = {1.0, 2.0};
  const ImplicitSurface surface(c);
  EXPECT_EQ(surface.value({0.0, 0.0, 0.0}), 1.0);
  EXPECT_EQ(surface.value({9000.0, -9000.0, 9000.0}), 2.0);
}

TEST(ImplicitSurface, BadInputIsRefused) {
  const auto refused = [](const auto& spoil) {
    ImplicitCoefficients c = random_coefficients(Kernel::wendland_c2, 1.0, 5, {5.0, 5.0, 5.0});
    spoil(c);
    EXPECT_THROW(ImplicitSurface{c}, InvalidInput);
  };
  refused([](ImplicitCoefficients& c) { c.weights.pop_back(); });
  refused([](ImplicitCoefficients& c) { c.centres.clear(), c.weights.clear(); });
  refused([](ImplicitCoefficients& c) { c.support_radius_mm = 0.0; });
  refused([](ImplicitCoefficients& c) { c.support_radius_mm = std::nan(""); });
  refused([](ImplicitCoefficients& c) { c.centres[3].y() = std::nan(""); });
  refused([](ImplicitCoefficients& c) { c.weights[2] = std::numeric_limits<double>::infinity(); });
  refused([](ImplicitCoefficients& c) { c.polynomial[1] = std::nan(""); });
  const ImplicitSurface surface(random_coefficients(Kernel::wendland_c2, 1.0, 5, {5.0, 5.0, 5.0}));
  const std::vector<Vec3> places(3, Vec3::Zero());
  std::vector<double> out(2);
  EXPECT_THROW(surface.values(places, out), InvalidInput);
}

}  // namespace
}  // namespace ostia::lumen
