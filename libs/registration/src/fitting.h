#pragma once
/// \file Transformations fitted to two images, by ITK. All of ITK stands behind this header.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/registration/register.h"

#include <vector>

namespace ostia::registration {

/// Two images whose values lie within [0, 1], but for two corners of each, which are 0 and 1 (prepared.h):
/// these set the range of the histogram.
struct ComparedImages {
  const imaging::FloatVolume* fixed = nullptr;
  const imaging::FloatVolume* moving = nullptr;
  std::vector<std::int64_t> samples;  ///< voxels of the fixed image, by offset
  Likeness likeness = Likeness::mutual_information;
};

/// What is said where hardly a sample is left to be compared.
inline constexpr const char* no_overlap =
    "the scans do not overlap: hardly a point of the fixed scan's region lies in the moving scan; give "
    "landmarks, or check that both are of the heart";

struct LinearMap {
  Mat3 linear = Mat3::Identity();
  Vec3 offset_mm = Vec3::Zero();
  double cost = 0.0;  ///< of the images under it: the less, the more alike
};

struct LinearSearch {
  bool affine = false;            ///< else the linear part is only turned
  Vec3 centre_mm = Vec3::Zero();  ///< of the fixed image's region, about which it turns
  double reach_mm = 50.0;         ///< how far from there a turn counts as much as a shift
  int iterations = 30;
};

/// The costs of each map, in their order; a map under which too little is left to be compared costs the most
/// that a double can hold.
std::vector<double> costs_of(const ComparedImages& images, const std::vector<LinearMap>& maps);
/// Throws InvalidInput where too few samples lie in the moving image, Cancelled.
LinearMap fitted_linear(const ComparedImages& images, const LinearMap& start, const LinearSearch& search,
                        const core::TaskContext& task);
/// The shifts from `start` on. Throws as the other does.
SplineGrid fitted_spline(const ComparedImages& images, const SplineGrid& start, double bending_weight,
                         int iterations, const core::TaskContext& task);

}  // namespace ostia::registration
