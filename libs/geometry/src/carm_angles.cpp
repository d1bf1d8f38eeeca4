#include "ostia/geometry/carm_angles.h"

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

}  // namespace

Vec3 towards_receptor(const CarmAngles& angles) {
  const double lao = degree * angles.lao_deg, cranial = degree * angles.cranial_deg;
  return {std::sin(lao) * std::cos(cranial), -std::cos(lao) * std::cos(cranial), std::sin(cranial)};
}

Vec3 receptor_up(const CarmAngles& angles) {
  const double lao = degree * angles.lao_deg, cranial = degree * angles.cranial_deg;
  return {-std::sin(lao) * std::sin(cranial), std::cos(lao) * std::sin(cranial), std::cos(cranial)};
}

}  // namespace ostia::geometry
