#include "body/body_organs.h"

#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

constexpr double reach_mm = 12.0;

/// How far veins keep from the arteries' outer walls.
struct VeinGap {
  explicit VeinGap(double closeness)
      : gap_mm(1.6 * (1.0 - closeness)),
        aside_mm(0.9 * (1.0 - closeness)),
        crossing_mm(0.8 * (1.0 - closeness)) {}
  double gap_mm;       // beside them
  double aside_mm;     // and more of it where a vein's way is laid
  double crossing_mm;  // where they cross
};

const CoronaryVessel* named(const CoronaryTree& tree, const char* name) {
  for (const CoronaryVessel& vessel : tree.vessels)
    if (vessel.name == name) return &vessel;
  return nullptr;
}

/// Points beside an artery every 6 mm, from `s_from` to `s_to` (either order), to its left (side 1) or
/// right.
void beside(const HeartShape& heart, const CoronaryVessel& artery, double s_from, double s_to, double side,
            double vein_mm, const VeinGap& gap, std::vector<Vec3>& out) {
  const auto& axis = artery.axis;
  const double length = std::abs(s_to - s_from), step = s_to > s_from ? 6.0 : -6.0;
  for (double s = 0.0; s <= length; s += 6.0) {
    const double at = std::clamp(s_from + s * step / 6.0, 0.0, axis.abscissa.back());
    const auto i = std::min<std::size_t>(axis.size() - 1, static_cast<std::size_t>(at / 0.1));
    const Vec3 outward =
        (axis.points[i] - (heart.base + 0.2 * heart.length_mm * heart.long_axis)).normalized();
    const Vec3 across = outward.cross(axis.frames[i].tangent).normalized();
    const double wave = 0.7 * std::sin(0.19 * at + vein_mm);
    out.push_back(axis.points[i] +
                  side * (axis.radius[i] + 0.6 + vein_mm + gap.gap_mm + gap.aside_mm + wave) * across);
  }
}

/// Moves points away from the arteries until a vein of this radius is clear of them.
void clear_arteries(std::vector<Vec3>& points, const std::vector<double>& radii, const VesselField& field,
                    const VeinGap& gap) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int round = 0; round < 12; ++round) {
      const double missing = radii[i] + gap.gap_mm + 0.2 - field.value(Boundary::wall, points[i], reach_mm);
      if (missing <= 0.0) break;
      Vec3 slope;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 h = 0.2 * Vec3::Unit(axis);
        slope[axis] = field.value(Boundary::wall, points[i] + h, reach_mm) -
                      field.value(Boundary::wall, points[i] - h, reach_mm);
      }
      if (slope.norm() < 1e-9) break;
      points[i] += 0.7 * missing * slope.normalized();
    }
  }
}

/// A smooth vein through the points; where an artery crosses, the vein has a gap rather than to touch it.
void add_vein(Capsules& veins, std::vector<Vec3> points, double from_mm, double to_mm,
              const VesselField& field, const VeinGap& gap) {
  if (points.size() < 4) return;
  std::vector<double> radii;
  const auto radius_at = [&](std::size_t i, std::size_t n) {
    return from_mm + (to_mm - from_mm) * static_cast<double>(i) / static_cast<double>(n - 1);
  };
  for (std::size_t i = 0; i < points.size(); ++i) radii.push_back(radius_at(i, points.size()));
  clear_arteries(points, radii, field, gap);
  std::vector<Vec3> even = geometry::resample(points, 2.0);
  const std::vector<double> t = geometry::abscissas(even);
  even = geometry::smoothing_spline(t, even, std::vector<double>(t.size(), 1.0), 30.0, true);
  radii.clear();
  for (std::size_t i = 0; i < even.size(); ++i) radii.push_back(radius_at(i, even.size()));
  clear_arteries(even, radii, field, gap);
  for (std::size_t i = 0; i + 1 < even.size(); ++i) {
    const double free_from = field.value(Boundary::wall, even[i], reach_mm) - gap.crossing_mm;
    const double free_to = field.value(Boundary::wall, even[i + 1], reach_mm) - gap.crossing_mm;
    const double middle =
        field.value(Boundary::wall, 0.5 * (even[i] + even[i + 1]), reach_mm) - gap.crossing_mm;
    const double most = std::min({free_from, free_to, middle});
    if (most < 0.6 || (even[i + 1] - even[i]).norm() > 6.0) continue;
    veins.push_back({even[i], even[i + 1], std::min(radii[i], most), std::min(radii[i + 1], most)});
  }
}

}  // namespace

Capsules coronary_veins(const HeartShape& heart, const CoronaryTree& tree, const VesselField& field,
                        const HeartWarp* warp, double closeness) {
  const VeinGap gap(closeness);
  Capsules veins;
  const auto epicardium = [&](double phi_rad, double depth, double outwards_mm) {
    const Vec3 own = heart.epicardium(phi_rad, depth, outwards_mm);
    return warp == nullptr ? own : warp->to_world(own);
  };
  constexpr double degrees = std::numbers::pi / 180.0;
  const CoronaryVessel* lad = named(tree, "LAD");
  const CoronaryVessel* lcx = named(tree, "LCX");
  const double crux = heart.posterior_groove_rad + 2.0 * std::numbers::pi;
  if (lad != nullptr && lcx != nullptr) {
    std::vector<Vec3> great;
    beside(heart, *lad, std::min(95.0, lad->axis.abscissa.back() - 5.0), 30.0, -1.0, 1.4, gap, great);
    for (double phi = heart.anterior_groove_rad + 26.0 * degrees; phi < crux + 12.0 * degrees;
         phi += 9.0 * degrees)
      great.push_back(epicardium(phi, 0.07, 4.2));
    great.push_back(epicardium(crux + 22.0 * degrees, -0.06, 0.0));
    add_vein(veins, great, 1.1, 4.6, field, gap);
  }
  if (const CoronaryVessel* pda = named(tree, "PDA")) {
    std::vector<Vec3> middle;
    beside(heart, *pda, pda->axis.abscissa.back() - 4.0, 6.0, 1.0, 1.6, gap, middle);
    middle.push_back(epicardium(crux + 14.0 * degrees, 0.06, 4.6));
    add_vein(veins, middle, 0.9, 2.2, field, gap);
  }
  double side = 1.0;
  for (const char* name : {"D1", "OM1", "OM2", "AM", "D2"}) {
    const CoronaryVessel* artery = named(tree, name);
    if (artery == nullptr) continue;
    std::vector<Vec3> way;
    beside(heart, *artery, artery->axis.abscissa.back() - 2.0, 8.0, side, 1.1, gap, way);
    add_vein(veins, way, 0.7, 1.3, field, gap);
    side = -side;
  }
  return veins;
}

}  // namespace ostia::phantom
