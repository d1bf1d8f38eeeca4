#include "ostia/glview/sample_motion.h"

#include "ostia/geometry/analytic_shapes.h"

#include <Eigen/Geometry>

#include <cmath>

namespace ostia::glview {
namespace {

using geometry::Vec3;

constexpr double template_phase = 0.75;
constexpr int phases = 20;

double wave(double phase, double at, double width) {
  const double off = std::remainder(phase - at, 1.0) / width;
  return std::exp(-off * off);
}

double uncorrected(double phase) {
  return wave(phase, 0.38, 0.16) + 0.12 * wave(phase, 0.93, 0.06);
}

}  // namespace

double sample_contraction(double phase) {
  return uncorrected(phase) - uncorrected(template_phase);
}

Vec3 sample_place(const Vec3& point, double phase) {
  const double amount = sample_contraction(phase);
  const Vec3 centre(20.0, 10.0, 30.0);
  Vec3 q = point - centre;
  q = Eigen::AngleAxisd(amount * 0.2 * (1.0 + q.z() / 40.0), Vec3::UnitZ()) * q;
  q = q.cwiseProduct(Vec3::Ones() - amount * Vec3(0.12, 0.12, 0.15));
  return centre + q + amount * Vec3(2.0 * std::sin(q.z() / 25.0), 3.0, 4.0);
}

SampleHeart sample_heart(double spacing_mm, int depth) {
  SampleHeart heart;
  heart.surface = geometry::surface_of(geometry::coronary_like_tree(), spacing_mm, true);
  heart.motion.template_phase = template_phase;
  heart.motion.grid = geometry::cage_around(heart.surface.points, depth);
  const std::vector<Vec3> rest = geometry::rest_points(heart.motion.grid);
  for (int k = 0; k < phases; ++k) {
    geometry::CagePhase one;
    one.phase = static_cast<double>(k) / phases;
    one.origin = 4 * k == 3 * phases ? geometry::PhaseOrigin::at_rest : geometry::PhaseOrigin::fitted;
    one.control_points.reserve(rest.size());
    for (const Vec3& p : rest) one.control_points.push_back(sample_place(p, one.phase));
    heart.motion.phases.push_back(std::move(one));
  }
  return heart;
}

}  // namespace ostia::glview
