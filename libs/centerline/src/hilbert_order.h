#pragma once
// Orders of points in which those that follow one another lie close together.

#include "ostia/geometry/vec.h"

#include <cstdint>
#include <vector>

namespace ostia::centerline {

/// Places of finite points along one Hilbert curve through all of them; equal points in the order they have.
std::vector<std::int32_t> along_hilbert_curve(const std::vector<geometry::Vec3>& points);

/// A biased randomised insertion order (Amenta, Choi, Rote: Incremental constructions con BRIO, SoCG 2003):
/// rounds of which each is about four times as large as the one before, each along the curve. Chance is a
/// hash of a point's number, so that the same points have the same order.
std::vector<std::int32_t> in_rounds(const std::vector<std::int32_t>& along_curve);

}  // namespace ostia::centerline
