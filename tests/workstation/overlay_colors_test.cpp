#include "views/overlay_colors.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace ostia::workstation {
namespace {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Of a colour in sRGB, 0 to 255, as it looks through `sight` (of linear light), in CIELAB.
Vec3 lab(const Vec3& rgb, const Mat3& sight) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const Vec3 seen = (sight * (rgb / 255.0).unaryExpr(linear)).cwiseMax(0.0).cwiseMin(1.0);
  Mat3 to_xyz;
  to_xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Vec3 f = (to_xyz * seen).cwiseQuotient(Vec3(0.9505, 1.0, 1.089)).unaryExpr([](double t) {
    return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
  });
  return {116.0 * f.y() - 16.0, 500.0 * (f.x() - f.y()), 200.0 * (f.y() - f.z())};
}

/// Normal sight, protanopia, deuteranopia, tritanopia (Machado et al. 2009).
std::vector<std::pair<std::string, Mat3>> sights() {
  Mat3 protan, deutan, tritan;
  protan << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  deutan << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  tritan << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return {{"normal", Mat3::Identity()}, {"protan", protan}, {"deutan", deutan}, {"tritan", tritan}};
}

TEST(OverlayColors, ClassesOfPlaqueAreToldApartOverAnyGreyByEverybody) {
  using view::Role;
  const double opacity = view::OverlayTint{}.opacity;
  for (const auto& [name, sight] : sights())
    for (const double grey : {50.0, 90.0, 130.0, 200.0}) {
      const Vec3 plain = Vec3::Constant(grey);
      std::vector<Vec3> shown{lab(plain, sight)};
      for (const Role role : {Role::low_attenuation, Role::fibrofatty, Role::fibrous, Role::calcified}) {
        const QColor color = role_color(role, Ground::image);
        shown.push_back(
            lab(opacity * Vec3(color.red(), color.green(), color.blue()) + (1.0 - opacity) * plain, sight));
      }
      for (std::size_t i = 0; i < shown.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_GT((shown[i] - shown[j]).norm(), 9.0) << name << ", grey " << grey << ": " << i << ", " << j;
    }
}

}  // namespace
}  // namespace ostia::workstation
