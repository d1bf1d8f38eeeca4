#include "coronaries/coronary_calibre.h"

#include "ostia/geometry/polyline.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using std::numbers::pi;

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (x * (6.0 * x - 15.0) + 10.0);
}

/// Smooth random amplitude along a vessel: waves whose phases come from the vessel.
double wave(std::uint64_t seed, std::uint64_t stream, double s_mm) {
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const double length = 8.0 + 22.0 * uniform(seed, stream + 2 * i);
    sum += std::sin(2.0 * pi * (s_mm / length + uniform(seed, stream + 2 * i + 1))) / std::sqrt(1.5);
  }
  return sum;
}

}  // namespace

double healthy_wall_radius(double lumen_radius_mm) {
  return 1.12 * lumen_radius_mm + 0.25;
}

void set_profiles(CoronaryVessel& vessel, const std::function<double(double)>& healthy, std::uint64_t seed) {
  const double length = vessel.axis.abscissa.back();
  vessel.healthy_radius_mm.clear();
  for (const double s : vessel.axis.abscissa) vessel.healthy_radius_mm.push_back(healthy(s));
  vessel.axis.radius = vessel.healthy_radius_mm;

  const auto rows = static_cast<int>(std::ceil(length / profile_step_mm)) + 1;
  std::vector<double> lumen, wall;
  const std::uint64_t stream = (static_cast<std::uint64_t>(vessel.id) + 1) << 24;
  for (int row = 0; row < std::max(4, rows); ++row) {
    const double s = row * profile_step_mm, r = healthy(std::min(s, length));
    double a[2], b[2];
    for (int k = 0; k < 2; ++k) {  // two- and three-lobed: a few per cent
      const double height = k == 0 ? 0.035 : 0.015;
      a[k] = height * wave(seed, stream + 16 * static_cast<std::uint64_t>(k), s);
      b[k] = height * wave(seed, stream + 16 * static_cast<std::uint64_t>(k) + 8, s);
    }
    for (int c = 0; c < profile_angles; ++c) {
      const double theta = 2.0 * pi * c / profile_angles;
      double shape = 1.0;
      for (int k = 0; k < 2; ++k)
        shape += a[k] * std::cos((k + 2) * theta) + b[k] * std::sin((k + 2) * theta);
      lumen.push_back(r * shape);
      wall.push_back(healthy_wall_radius(r) * (1.0 + 0.7 * (shape - 1.0)));
    }
  }
  vessel.lumen = RadialProfile(profile_step_mm, profile_angles, std::move(lumen));
  vessel.wall = RadialProfile(profile_step_mm, profile_angles, std::move(wall));
}

void set_calibre(CoronaryVessel& vessel, double start_radius_mm, double end_radius_mm, double taper_power,
                 std::vector<BranchShare> branches, std::uint64_t seed) {
  std::sort(branches.begin(), branches.end(),
            [](const BranchShare& a, const BranchShare& b) { return a.s_mm < b.s_mm; });
  const double length = vessel.axis.abscissa.back();
  const auto murray = [&](double s) {
    double cube = 1.0;
    for (const BranchShare& b : branches)
      cube *= 1.0 - b.share * b.share * b.share * smooth_step((s - b.s_mm + 1.0) / 6.0);
    return std::cbrt(cube);
  };
  const double left_over = start_radius_mm * murray(length);
  const double narrowing = std::min(1.0, end_radius_mm / left_over);
  const auto healthy = [&](double s) {
    return start_radius_mm * murray(s) * (1.0 - (1.0 - narrowing) * std::pow(s / length, taper_power));
  };
  set_profiles(vessel, healthy, seed);
}

double radius_before_branch(const CoronaryVessel& vessel, double s_mm) {
  const double s = std::max(0.0, s_mm - 1.5);
  const auto at = std::lower_bound(vessel.axis.abscissa.begin(), vessel.axis.abscissa.end(), s) -
                  vessel.axis.abscissa.begin();
  return vessel.healthy_radius_mm[std::min(static_cast<std::size_t>(at), vessel.axis.size() - 1)];
}

double free_abscissa(const CoronaryVessel& vessel, const CoronaryVessel& parent) {
  constexpr double reach_mm = 25.0, settled_mm = 4.0;
  std::vector<Vec3> near;  // the parent's axis about the branch
  double offset = 0.0;
  for (std::size_t i = 0; i < parent.axis.size(); ++i) {
    if (std::abs(parent.axis.abscissa[i] - vessel.parent_s_mm) > reach_mm + 5.0) continue;
    if (near.empty()) offset = parent.axis.abscissa[i];
    near.push_back(parent.axis.points[i]);
  }
  double last = 0.0;
  for (std::size_t i = 0; i < vessel.axis.size() && vessel.axis.abscissa[i] < reach_mm; ++i) {
    const double s = vessel.axis.abscissa[i];
    if (s > last + settled_mm) break;
    const auto foot = geometry::closest(near, vessel.axis.points[i]);
    const double distance = (foot.point - vessel.axis.points[i]).norm();
    if (distance < vessel.lumen.max_at(s) + parent.wall.max_at(offset + foot.abscissa)) last = s;
  }
  return last;
}

}  // namespace ostia::phantom
