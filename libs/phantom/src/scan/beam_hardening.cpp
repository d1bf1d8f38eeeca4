#include "scan/artefacts.h"
#include "scan/slice_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

constexpr double hardening_cell_mm = 1.5;  // streaks are smooth: the model needs no more
constexpr int hardening_angles = 120;      // over half a turn
constexpr double dense_from_hu = 130.0;    // softer tissue is corrected for in the scanner
constexpr double dense_to_hu = 1500.0;     // metal would need another model
constexpr double second_order = 0.2;       // share of the projection's square that is missing (usual value)

}  // namespace

void add_beam_hardening(const SliceView& slice, const geometry::Vec3& spacing_mm, double strength) {
  if (strength <= 0.0) return;
  // Attenuation above water of dense materials, per mm.
  const CoarseSlice dense(slice, spacing_mm, hardening_cell_mm, [](float hu) {
    return std::clamp(static_cast<double>(hu) - dense_from_hu, 0.0, dense_to_hu) * water_per_mm / 1000.0;
  });
  SliceDetector detector(dense);
  CoarseSlice error = dense;
  std::fill(error.values.begin(), error.values.end(), 0.0);
  for (int a = 0; a < hardening_angles; ++a) {
    detector.turn_to(std::numbers::pi * a / hardening_angles);
    std::vector<double> view = detector.projection(dense);
    for (double& p : view) p = -second_order * p * p;
    detector.back_project(detector.ramp_filtered(view), hardening_angles, error);
  }
  error.add_to(slice, strength * 1000.0 / water_per_mm);
}

}  // namespace ostia::phantom
