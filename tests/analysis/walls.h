#pragma once
/// \file Vessels with known walls, solved, for tests of what is measured on them.

#include "vessel_trees.h"

#include "ostia/analysis/lumen_profile.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/vessel_lumen.h"

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace ostia::analysis::testing {

using std::numbers::pi;

/// A model and its solved walls.
struct Solved {
  lumen::LumenModel model;
  std::map<std::int32_t, std::shared_ptr<const lumen::ImplicitSurface>> walls;

  explicit Solved(lumen::LumenModel of) : model(std::move(of)) {
    for (const auto& vessel : model.vessels)
      walls[vessel->vessel] = std::make_shared<const lumen::ImplicitSurface>(lumen::solve(*vessel));
  }
  SurfaceOfVessel surface_of() const {
    return [this](std::int32_t vessel) { return walls.at(vessel); };
  }
  std::int32_t first() const { return model.tree.vessels.front().id; }
  LumenProfile profile(const ProfileOptions& options = {}) const {
    return lumen_profile(model, surface_of(), first(), options);
  }
};

/// Along +z from the origin, with a wall about the axis; theta = 0 is +x.
inline Solved straight(double length_mm, const lumen::RadialWall& wall,
                       const lumen::SamplingOptions& sampling = {}) {
  return Solved(lumen::model_of_walls(lumen::testing::straight_vessel(length_mm, 1.5), {wall}, sampling));
}

/// The distance to a circle of radius `radius` whose middle lies `off` from the axis at theta = 0.
inline double circle_from(double radius, double off, double theta) {
  const double across = off * std::sin(theta);
  return off * std::cos(theta) + std::sqrt(radius * radius - across * across);
}

/// 1 at the centre, 0 from half a length on.
inline double bump(double s, double centre, double length) {
  const double x = 2.0 * std::abs(s - centre) / length;
  return x < 1.0 ? 0.5 * (1.0 + std::cos(pi * x)) : 0.0;
}

/// A profile of given diameters, with sections `step_mm` apart; 0 where the lumen is shut.
inline LumenProfile profile_of(double length_mm, double step_mm,
                               const std::function<double(double)>& diameter) {
  LumenProfile profile;
  profile.vessel = 1;
  profile.options.step_mm = step_mm;
  profile.length_mm = length_mm;
  const auto count = static_cast<std::size_t>(std::lround(length_mm / step_mm));
  for (std::size_t i = 0; i <= count; ++i) {
    SectionMeasures section;
    section.s_mm = length_mm * static_cast<double>(i) / static_cast<double>(count);
    section.diameter_mm = diameter(section.s_mm);
    section.found = section.diameter_mm > 0.0;
    section.area_mm2 = 0.25 * pi * section.diameter_mm * section.diameter_mm;
    section.centroid = section.s_mm * Vec3::UnitZ();
    profile.sections.push_back(section);
  }
  return profile;
}

}  // namespace ostia::analysis::testing
