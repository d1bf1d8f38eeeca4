#pragma once
/// \file A synthetic heart's left coronary tree over the beat, as models of each phase and as the exact
/// motion.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ostia::experiments {

/// What stands in for a segmentation of each phase.
struct BeatingHeartOptions {
  std::uint64_t seed = 1;        ///< of the patient (phantom::CaseOptions)
  int phases = 20;               ///< evenly spaced, 4, 8, ... up to 100
  int template_points = 10600;   ///< about; as in [Yi] 2; [500, 1000000]
  int target_points = 13000;     ///< of the other phases: other triangles
  double noise_mm = 0.1;         ///< deviation of the wall along its normal, another one each phase; >= 0
  double noise_length_mm = 2.0;  ///< over which it is correlated; > 0
  /// Of the phases, in each of which a side branch is missing as where motion blurs it away; [0, 1].
  double phases_with_loss = 0.3;
};
void validate(const BeatingHeartOptions& options);  ///< throws InvalidInput

struct HeartPhaseModel {
  double phase = 0.0;                 ///< share of the cycle
  geometry::TriMesh segmented;        ///< as a segmentation would have it: own triangles, noise, loss
  std::string lost;                   ///< the branch that is missing; empty: none
  std::vector<geometry::Vec3> truth;  ///< where the template's points are at this phase
  geometry::VesselTree axes;          ///< where those of the template are
};

struct BeatingHeart {
  std::string name;                     ///< "heart 1"
  geometry::TriMesh model;              ///< the template, at phantom::template_percent
  geometry::VesselTree axes;            ///< of the template, a point every 0.5 mm or less
  double template_phase = 0.75;         ///< phantom::template_percent
  std::vector<HeartPhaseModel> phases;  ///< rising
};

/// "heart 3": by the patient's seed.
std::string heart_name(const BeatingHeartOptions& options);

/// The left tree (LM, LAD, LCX and their branches), as in [Yi] 2. Deterministic. Throws InvalidInput,
/// Cancelled.
BeatingHeart beating_heart(const BeatingHeartOptions& options,
                           const core::TaskContext& task = core::no_task());

/// A Gaussian field with mean 0, deviation 1 and correlation exp(-d^2 / (2 L^2)), as a sum of `waves` plane
/// waves of random directions and lengths. Deterministic by its seed.
std::function<double(const geometry::Vec3&)> smooth_field(std::uint64_t seed, double length_mm,
                                                          int waves = 96);

}  // namespace ostia::experiments
