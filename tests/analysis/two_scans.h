#pragma once
/// \file A coronary tree as two scans see it, for tests of what changed between them.

#include "walls.h"

#include "ostia/analysis/scan_change.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/rigid_fit.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/lumen/lumen_model.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace ostia::analysis::testing {

using geometry::VesselTree;
using Curve = std::function<Vec3(double)>;

inline geometry::Centerline line_along(const Curve& curve, double from, double to,
                                       const std::function<Vec3(const Vec3&)>& moved) {
  geometry::Centerline line;
  const auto steps = static_cast<int>(std::ceil((to - from) / 0.5));
  for (int i = 0; i <= steps; ++i) {
    line.points.push_back(moved(curve(from + (to - from) * i / steps)));
    line.radius.push_back(1.5);
  }
  geometry::complete(line);
  return line;
}

struct HeartOptions {
  std::function<Vec3(const Vec3&)> moved = [](const Vec3& p) { return p; };
  double size = 1.0;              ///< of the heart
  std::string diagonal = "D1";    ///< name of the branch of LAD
  bool circumflex_first = false;  ///< then LCX owns the left main
  double lad_mm = 80.0;
};

/// Vessels RCA (1), LAD (2), LCX (3), and a diagonal (4); the left main is 10 mm, the diagonal leaves 30 mm
/// behind the ostium. Axes are bent as on a heart of some 80 mm.
inline VesselTree heart_tree(const HeartOptions& o = {}) {
  const double k = o.size;
  const Curve rca = [k](double t) -> Vec3 {
    return k * Vec3(-30.0 - 25.0 * std::sin(t / 30.0), -10.0 + 30.0 * std::cos(t / 30.0), -0.45 * t);
  };
  const Curve left = [k](double t) -> Vec3 {
    return k * Vec3(8.0 + 0.5 * t + 6.0 * std::sin(t / 18.0), -20.0 + 18.0 * std::sin(t / 40.0), -0.6 * t);
  };
  const Curve lcx = [k, left](double t) -> Vec3 {
    return left(10.0) + k * Vec3(20.0 * std::sin(t / 25.0), 24.0 * (1.0 - std::cos(t / 25.0)), -0.35 * t);
  };
  const Curve diagonal = [k, left](double t) -> Vec3 {
    return left(30.0) + k * Vec3(0.6 * t, 9.0 * std::sin(t / 20.0), -0.2 * t);
  };
  VesselTree tree;
  const auto node = [&](std::int32_t id, const Vec3& at) { tree.nodes.push_back({id, o.moved(at)}); };
  node(1, rca(0.0)), node(2, rca(75.0)), node(3, left(0.0)), node(4, left(10.0)), node(5, left(30.0));
  node(6, left(o.lad_mm)), node(7, lcx(50.0)), node(8, diagonal(35.0));
  tree.segments = {{11, 1, 2, line_along(rca, 0.0, 75.0, o.moved)},
                   {12, 3, 4, line_along(left, 0.0, 10.0, o.moved)},
                   {13, 4, 5, line_along(left, 10.0, 30.0, o.moved)},
                   {14, 5, 6, line_along(left, 30.0, o.lad_mm, o.moved)},
                   {15, 4, 7, line_along(lcx, 0.0, 50.0, o.moved)},
                   {16, 5, 8, line_along(diagonal, 0.0, 35.0, o.moved)}};
  tree.vessels = {
      {1, "RCA", {11}}, {2, "LAD", {12, 13, 14}}, {3, "LCX", {12, 15}}, {4, o.diagonal, {12, 13, 16}}};
  if (o.circumflex_first) std::swap(tree.vessels[1], tree.vessels[2]);
  return tree;
}

/// 15 degrees about a slanted axis and 20 mm.
inline geometry::RigidFit known_motion() {
  geometry::RigidFit motion;
  motion.rotation = Eigen::AngleAxisd(15.0 * pi / 180.0, Vec3(1.0, 2.0, 2.0).normalized()).toRotationMatrix();
  motion.shift = Vec3(12.0, -16.0, 0.0);
  return motion;
}

inline HeartOptions moved_heart() {
  HeartOptions options;
  options.moved = known_motion();
  return options;
}

/// A lesion as it is made: a dip of the lumen's diameter, and plaque of one kind about it.
struct MadeLesion {
  std::int32_t vessel = 0;
  double at_mm = 0.0, length_mm = 8.0;
  double share = 0.0;  ///< of the diameter that is taken away
  double plaque_from_mm = 0.0, plaque_to_mm = 0.0;
  double hu = 200.0;  ///< of its plaque
};

inline constexpr double healthy_mm = 3.0, wall_mm = 0.4, plaque_mm = 1.2;

/// Measured as made: round lumen of 3 mm, a wall of 0.4 mm, of 1.2 mm where there is plaque.
inline ScannedTree scanned(VesselTree tree, const std::vector<MadeLesion>& made, bool with_plaque = true) {
  ScannedTree scan;
  scan.tree = std::move(tree);
  for (const geometry::Vessel& vessel : scan.tree.vessels) {
    const geometry::AxisCurve axis(geometry::vessel_axis(scan.tree, vessel));
    // What lies before the own part is another vessel's: its lesions are seen on this way, too.
    const auto here = [&, id = vessel.id](double s) {
      std::vector<MadeLesion> found;
      for (const MadeLesion& one : made)
        if (one.vessel == lumen::owner_at(scan.tree, id, s)) found.push_back(one);
      return found;
    };
    const auto diameter = [&](double s) {
      double value = healthy_mm;
      for (const MadeLesion& one : here(s))
        value -= healthy_mm * one.share * bump(s, one.at_mm, one.length_mm);
      return value;
    };
    ScannedVessel measured;
    measured.vessel = vessel.id;
    measured.name = vessel.name;
    measured.own_from_mm = lumen::own_from_mm(scan.tree, vessel.id);
    measured.profile = profile_of(axis.length(), 0.25, diameter);
    measured.profile.vessel = vessel.id;
    measured.reference.diameter_mm.assign(measured.profile.sections.size(), healthy_mm);
    if (with_plaque) {
      const auto plaque_at = [&](double s) {
        const auto all = here(s);
        const auto one = std::find_if(all.begin(), all.end(), [&](const MadeLesion& lesion) {
          return s >= lesion.plaque_from_mm && s <= lesion.plaque_to_mm && lesion.plaque_to_mm > 0.0;
        });
        return one != all.end() ? std::optional(*one) : std::nullopt;
      };
      WallRadii walls;
      walls.from_mm = measured.own_from_mm;
      walls.to_mm = axis.length();
      walls.lumen_mm = [&](double s, double) { return 0.5 * diameter(s); };
      walls.outer_mm = [&](double s, double) {
        return 0.5 * healthy_mm + (plaque_at(s) ? plaque_mm : wall_mm);
      };
      walls.calibre_mm = [](double) { return healthy_mm; };
      PlaqueOptions options;
      options.blur_sigma_mm = 0.0;
      options.around = 16, options.deep = 4;
      measured.plaque = plaque_profile(
          axis, walls,
          [&](const Vec3& place) {
            const auto one = plaque_at(axis.nearest_foot(place).s_mm);
            return one ? one->hu : 60.0;
          },
          options);
    }
    scan.vessels.push_back(std::move(measured));
  }
  for (const MadeLesion& one : made) {
    ScannedLesion lesion;
    lesion.label = "S" + std::to_string(scan.lesions.size() + 1);
    Stenosis& s = lesion.stenosis;
    s.vessel = one.vessel;
    s.throat_mm = one.at_mm;
    s.from_mm = one.at_mm - 0.5 * one.length_mm, s.to_mm = one.at_mm + 0.5 * one.length_mm;
    s.proximal_mm = s.from_mm - 1.0, s.distal_mm = s.to_mm + 1.0;
    s.diameter_percent = 100.0 * one.share;
    lesion.narrows = one.share > 0.0;
    scan.lesions.push_back(std::move(lesion));
  }
  return scan;
}

}  // namespace ostia::analysis::testing
