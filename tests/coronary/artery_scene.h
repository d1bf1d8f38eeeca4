#pragma once
/// \file A small image with an artery, its side branch, and what must not be taken for one.

#include "made_image.h"

#include "ostia/coronary/ostia.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ostia::coronary::testing {

using ostia::testing::made_image;
using ostia::testing::ramp;

inline constexpr double fat_hu = -90.0, contrast_hu = 400.0, vein_hu = 220.0, plaque_hu = 30.0;

struct Tube {
  Vec3 from, to;
  double radius_mm;
  double distance(const Vec3& at) const {
    const Vec3 along = to - from;
    const double t = std::clamp((at - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (at - from - t * along).norm() - radius_mm;
  }
};

/// An aorta that stands at the image's edge (only what it is like matters here), an artery with a side branch
/// and a stub, a vein beside it, a chamber that touches it from below.
struct Scene {
  Vec3 ostium{-20.0, 0.0, 20.0};
  std::vector<Tube> arteries{{{-20.0, 0.0, 20.0}, {8.0, 0.0, 20.0}, 1.6},
                             {{8.0, 0.0, 20.0}, {22.0, 0.0, 10.0}, 1.2},
                             {{0.0, 0.0, 20.0}, {8.0, 16.0, 30.0}, 1.0},
                             {{-10.0, 0.0, 20.0}, {-10.0, -3.8, 20.0}, 0.9}};  // the stub
  Tube vein{{-18.0, 3.9, 20.0}, {0.0, 3.9, 16.0}, 1.3};  // 1 mm of fat between them at first
  std::vector<Tube> plaques;                             // where an artery is closed
  Vec3 chamber{-10.0, 0.0, 0.0};
  double chamber_radius_mm = 18.2;  // the artery's wall is a dip of partial volume there

  double artery_distance(const Vec3& at) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Tube& tube : arteries) nearest = std::min(nearest, tube.distance(at));
    return nearest;
  }
  double hu(const Vec3& at) const {
    const double artery =
        contrast_hu * ramp(artery_distance(at), 0.6) + fat_hu * (1.0 - ramp(artery_distance(at), 0.6));
    const double beside = fat_hu + (vein_hu - fat_hu) * ramp(vein.distance(at), 0.6);
    const double below =
        fat_hu + (contrast_hu - fat_hu) * ramp((at - chamber).norm() - chamber_radius_mm, 0.6);
    double closed = fat_hu;
    for (const Tube& plaque : plaques)
      closed = std::max(closed, fat_hu + (plaque_hu - fat_hu) * ramp(plaque.distance(at), 0.6));
    return std::max({artery, beside, below, closed});
  }
  imaging::ImageVolume image(double spacing_mm = 0.45) const {
    return made_image(26.0, 40.0, spacing_mm, [&](const Vec3& at) { return hu(at); });
  }
  /// An artery that is closed by plaque for some 7 mm, to x = 7.
  static Scene closed() {
    Scene scene;
    scene.arteries = {{{-20.0, 0.0, 20.0}, {-2.0, 0.0, 20.0}, 1.4},
                      {{8.0, 0.0, 20.5}, {22.0, 0.0, 22.0}, 1.2}};
    scene.plaques = {{{-3.0, 0.0, 20.0}, {9.0, 0.0, 20.6}, 1.3}};
    return scene;
  }
  static Aorta aorta() {
    Aorta made;
    made.lumen_hu = contrast_hu;
    return made;
  }
  std::vector<Ostium> ostia() const {
    Ostium made;
    made.place = ostium;
    made.direction = Vec3::UnitX();
    return {made};
  }
};

}  // namespace ostia::coronary::testing
