#pragma once
/// \file The aorta's lumen, voxel by voxel.

#include "ostia/coronary/aorta.h"

namespace ostia::coronary {

/// docs/methods/coronary-aorta.md gives the method.
struct AortaMaskOptions {
  double wall_hu = 60.0;  ///< usual intensity of the wall and what is about it, [-100, 150]
};
void validate(const AortaMaskOptions& options);  ///< throws InvalidInput

/// 1 on the image's grid where a voxel's centre lies within the wall, from the first station's plane to the
/// last one's: half-way falls of intensity on rays across the axis, smoothed by a median, so that arteries
/// that leave and chambers that touch stay outside. Metal and calcium within the wall belong to it.
/// Deterministic, the same for any number of threads. Throws InvalidInput for options out of range, an empty
/// image or an aorta of fewer than three stations, Cancelled.
imaging::MaskVolume aorta_mask(const imaging::ImageVolume& image, const Aorta& aorta,
                               const AortaMaskOptions& options = {},
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
