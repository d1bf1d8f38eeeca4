#include "ostia/lumen/implicit_surface.h"

#include "interpolation/centre_grid.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::lumen {
namespace {

constexpr std::size_t places_per_task = 128;
constexpr std::size_t places_per_block = 16;  // that share a list of centres
constexpr double block_per_support = 1.25;    // largest extent of a block, in support radii
constexpr double sorted_per_support = 0.5;    // side of the cells in whose order places are taken

void check(const ImplicitCoefficients& coefficients) {
  if (coefficients.centres.empty()) throw InvalidInput("an implicit surface needs at least one centre");
  if (coefficients.centres.size() != coefficients.weights.size())
    throw InvalidInput("an implicit surface has " + std::to_string(coefficients.centres.size()) +
                       " centres and " + std::to_string(coefficients.weights.size()) +
                       " weights; give one a centre");
  if (!(coefficients.support_radius_mm > 0.0) || !std::isfinite(coefficients.support_radius_mm))
    throw InvalidInput("the support radius of an implicit surface must be positive, it is " +
                       std::to_string(coefficients.support_radius_mm) + " mm");
  for (std::size_t i = 0; i < coefficients.centres.size(); ++i)
    if (!coefficients.centres[i].allFinite() || !std::isfinite(coefficients.weights[i]))
      throw InvalidInput("centre " + std::to_string(i) +
                         " of an implicit surface or its weight is not finite");
  for (const double q : coefficients.polynomial)
    if (!std::isfinite(q)) throw InvalidInput("the polynomial of an implicit surface is not finite");
}

CentreGrid::Gathered& scratch() {
  thread_local CentreGrid::Gathered gathered;
  return gathered;
}

}  // namespace

struct ImplicitSurface::Impl {
  ImplicitCoefficients coefficients;
  CentreGrid grid;
  KernelLoops loops;
  double per_radius = 0.0;
  Box3 box;

  explicit Impl(ImplicitCoefficients given)
      : coefficients(std::move(given)),
        grid(coefficients.centres, coefficients.weights, coefficients.support_radius_mm),
        loops(kernel_loops(coefficients.kernel)),
        per_radius(1.0 / coefficients.support_radius_mm) {
    for (const Vec3& centre : coefficients.centres) box.extend(centre);
    const Vec3 reach = Vec3::Constant(coefficients.support_radius_mm);
    box = Box3(box.min() - reach, box.max() + reach);
  }

  double with_polynomial(double sum, const Vec3& p) const {
    const auto& q = coefficients.polynomial;
    return sum + (q[0] + q[1] * p.x() + q[2] * p.y() + q[3] * p.z());
  }
  double value(const Vec3& place, CentreGrid::Gathered& near) const {
    loops.terms(per_radius, near.list(), place.data(), near.terms.data());
    double sum = 0.0;
    for (std::size_t i = 0; i < near.size; ++i) sum += near.terms[i];
    return with_polynomial(sum, place);
  }
  Vec3 gradient(const Vec3& place, CentreGrid::Gathered& near) const {
    loops.slopes(per_radius, near.list(), place.data(), near.terms.data());
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < near.size; ++i)
      sum += near.terms[i] * (place - Vec3(near.x[i], near.y[i], near.z[i]));
    const auto& q = coefficients.polynomial;
    return sum * (per_radius * per_radius) + Vec3(q[1], q[2], q[3]);
  }

  /// Places from the first on that are near each other, at most places_per_block.
  std::size_t block_size(std::span<const Vec3> places, Box3& around) const {
    const double largest = block_per_support * coefficients.support_radius_mm;
    around = Box3(places[0], places[0]);
    std::size_t size = 1;
    for (; size < std::min(places.size(), places_per_block); ++size) {
      Box3 wider = around;
      wider.extend(places[size]);
      if (!(wider.sizes().maxCoeff() <= largest)) break;
      around = wider;
    }
    return size;
  }

  /// The order along a Z-curve, which keeps neighbours together, with the place's number in the low bits.
  std::uint64_t order(const Vec3& place, const Vec3& origin, std::size_t number) const {
    const double per_cell = 1.0 / (sorted_per_support * coefficients.support_radius_mm);
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = (place[axis] - origin[axis]) * per_cell;
      const double cell = along > 0.0 ? std::min(along, 32767.0) : 0.0;
      key |= spread(static_cast<std::uint64_t>(cell)) << axis;
    }
    return key << 16 | number;
  }
  /// 15 bits, two free ones between each.
  static std::uint64_t spread(std::uint64_t bits) {
    bits = (bits | bits << 16) & 0x0000ff0000ffULL;
    bits = (bits | bits << 8) & 0x00f00f00f00fULL;
    bits = (bits | bits << 4) & 0x0c30c30c30c3ULL;
    return (bits | bits << 2) & 0x249249249249ULL;
  }

  void block_values(std::span<const Vec3> places, const CentreGrid::Gathered& near,
                    std::span<double> out) const {
    PlaceLanes lanes;
    std::array<double, sum_lanes> sums{};
    for (std::size_t first = 0; first < places.size(); first += sum_lanes) {
      const std::size_t count = std::min(sum_lanes, places.size() - first);
      for (std::size_t k = 0; k < sum_lanes; ++k) {
        const Vec3& place = places[first + std::min(k, count - 1)];
        lanes.x[k] = place.x();
        lanes.y[k] = place.y();
        lanes.z[k] = place.z();
      }
      const auto sum_up = 2 * count > sum_lanes ? loops.sums : loops.half_sums;
      sum_up(per_radius, near.list(), lanes, sums.data());
      for (std::size_t k = 0; k < count; ++k) out[first + k] = with_polynomial(sums[k], places[first + k]);
    }
  }

  /// At most places_per_task.
  void values(std::span<const Vec3> places, std::span<double> out) const {
    std::array<std::uint64_t, places_per_task> keys;
    std::array<Vec3, places_per_task> sorted;
    std::array<double, places_per_task> found;
    Vec3 origin = places[0];
    for (const Vec3& place : places) origin = origin.cwiseMin(place);
    for (std::size_t i = 0; i < places.size(); ++i) keys[i] = order(places[i], origin, i);
    std::sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i) sorted[i] = places[keys[i] & 0xffff];
    sorted_values(std::span(sorted).first(places.size()), std::span(found).first(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i) out[keys[i] & 0xffff] = found[i];
  }

  void sorted_values(std::span<const Vec3> places, std::span<double> out) const {
    CentreGrid::Gathered& near = scratch();
    for (std::size_t first = 0; first < places.size();) {
      Box3 around;
      const std::size_t size = block_size(places.subspan(first), around);
      grid.gather(around, near);
      if (size == 1)
        out[first] = value(places[first], near);
      else
        block_values(places.subspan(first, size), near, out.subspan(first, size));
      first += size;
    }
  }
};

ImplicitSurface::ImplicitSurface(ImplicitCoefficients coefficients) {
  check(coefficients);
  impl_ = std::make_unique<Impl>(std::move(coefficients));
}
ImplicitSurface::~ImplicitSurface() = default;
ImplicitSurface::ImplicitSurface(ImplicitSurface&&) noexcept = default;
ImplicitSurface& ImplicitSurface::operator=(ImplicitSurface&&) noexcept = default;

double ImplicitSurface::value(const Vec3& place) const {
  CentreGrid::Gathered& near = scratch();
  impl_->grid.gather(Box3(place, place), near);
  return impl_->value(place, near);
}

Vec3 ImplicitSurface::gradient(const Vec3& place) const {
  CentreGrid::Gathered& near = scratch();
  impl_->grid.gather(Box3(place, place), near);
  return impl_->gradient(place, near);
}

FieldSample ImplicitSurface::value_and_gradient(const Vec3& place) const {
  CentreGrid::Gathered& near = scratch();
  impl_->grid.gather(Box3(place, place), near);
  return {impl_->value(place, near), impl_->gradient(place, near)};
}

void ImplicitSurface::values(std::span<const Vec3> places, std::span<double> out) const {
  if (out.size() < places.size())
    throw InvalidInput("there is room for " + std::to_string(out.size()) + " values of " +
                       std::to_string(places.size()) + " places");
  core::parallel_chunks(places.size(), places_per_task, [&](std::size_t first, std::size_t last) {
    impl_->values(places.subspan(first, last - first), out.subspan(first, last - first));
  });
}

Box3 ImplicitSurface::box() const {
  return impl_->box;
}
const ImplicitCoefficients& ImplicitSurface::coefficients() const {
  return impl_->coefficients;
}

}  // namespace ostia::lumen
