#pragma once
/// \file What --measure prints.

#include "frame_meter.h"
#include "start_clock.h"
#include "viewer.h"

#include <string>

namespace ostia::live {

std::string measurements_json(const Viewer& viewer, const FrameMeter& meter, const StartTimes& times,
                              int width, int height, int screenshots);
/// Waits until all that was asked of OpenGL is done.
void finish_drawing();

}  // namespace ostia::live
