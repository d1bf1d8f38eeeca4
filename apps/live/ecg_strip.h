#pragma once
/// \file The electrocardiogram below the scene.

#include "playback.h"

namespace ostia::live {

/// The last seconds, the newest sample at the right; R peaks that are known are marked, and below them where
/// the heart is in its cycle.
void draw_ecg_strip(const Playback& playback, int width, int height);

}  // namespace ostia::live
