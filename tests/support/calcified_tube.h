#pragma once
/// \file The image of a narrowed artery with a calcified nodule on one side, of exactly known lumen.

#include "ostia/imaging/volume.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace ostia::testing {

/// An artery along z in fat. In its middle the lumen narrows from 1.2 to 0.5 mm radius and steps aside by
/// 0.4 mm to make room for plaque with a nodule of 1,100 HU, whose middle lies 0.9 mm beside the wall's axis.
struct CalcifiedTube {
  static constexpr double length_mm = 36.0, throat_mm = 18.0;

  /// 1 at the throat, 0 from 5 mm on.
  static double narrowing(double z_mm) {
    const double off = std::abs(z_mm - throat_mm) / 5.0;
    return off < 1.0 ? 0.5 + 0.5 * std::cos(M_PI * off) : 0.0;
  }
  static double radius(double z_mm) { return 1.2 - 0.7 * narrowing(z_mm); }
  static geometry::Vec3 middle(double z_mm) { return {0.4 * narrowing(z_mm), 0.0, z_mm}; }
  /// What a search that is drawn to bright places finds: a line that runs through the nodule.
  static std::vector<geometry::Vec3> line_through_nodule() {
    std::vector<geometry::Vec3> line;
    for (double z = 1.0; z <= length_mm - 1.0; z += 0.5) {
      const double off = std::abs(z - throat_mm) / 3.0;
      line.emplace_back(off < 1.0 ? -0.9 * std::cos(0.5 * M_PI * off) : 0.0, 0.0, z);
    }
    return line;
  }
  static double sharp_hu(const geometry::Vec3& p) {
    const geometry::Vec3 nodule =
        (p - geometry::Vec3(-0.9, 0.0, throat_mm)).cwiseQuotient(geometry::Vec3(0.45, 0.6, 2.2));
    if (nodule.squaredNorm() < 1.0) return 1100.0;
    if ((p - middle(p.z())).norm() < radius(p.z())) return 400.0;
    return std::hypot(p.x(), p.y()) < 1.7 ? 70.0 : -90.0;
  }
  /// Voxels of 0.35 x 0.35 x 0.45 mm, a blur of 0.3 mm (standard deviation), noise of 15 HU.
  static imaging::ImageVolume image() {
    imaging::ImageVolume made;
    made.geometry.size = {28, 28, 80};
    made.geometry.spacing = {0.35, 0.35, 0.45};
    made.geometry.origin = {-4.72, -4.72, 0.0};
    made.voxels.resize(static_cast<std::size_t>(made.geometry.voxels()));
    constexpr int reach = 3;
    constexpr double step = 0.22, sigma = 0.3;
    double weight[2 * reach + 1], sum = 0.0;
    for (int n = -reach; n <= reach; ++n)
      sum += weight[n + reach] = std::exp(-0.5 * n * n * step * step / (sigma * sigma));
    std::mt19937 generator(5);
    std::normal_distribution<double> noise(0.0, 15.0);
    for (std::int64_t k = 0; k < made.geometry.size[2]; ++k)
      for (std::int64_t j = 0; j < made.geometry.size[1]; ++j)
        for (std::int64_t i = 0; i < made.geometry.size[0]; ++i) {
          const geometry::Vec3 at = made.geometry.world({double(i), double(j), double(k)});
          double hu = 0.0;
          for (int c = -reach; c <= reach; ++c)
            for (int b = -reach; b <= reach; ++b)
              for (int a = -reach; a <= reach; ++a)
                hu += weight[a + reach] * weight[b + reach] * weight[c + reach] *
                      sharp_hu(at + step * geometry::Vec3(a, b, c));
          hu = hu / (sum * sum * sum) + noise(generator);
          made(i, j, k) = static_cast<std::int16_t>(std::lround(hu));
        }
    return made;
  }
};

}  // namespace ostia::testing
