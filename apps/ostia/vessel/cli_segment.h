#pragma once
/// \file The options that say how a lumen is found in an image.

#include "commands.h"

namespace CLI {
class App;
}

namespace ostia::app {

/// Those of `segment` and `model`: seed points, thresholds, level set, filters.
void add_lumen(CLI::App& app, LumenOptions& o);
/// `--aorta` of `segment`.
void add_aorta(CLI::App& app, SegmentCommand& o);
/// Throws CLI::ExcludesError where `segment` was given --aorta and an option that it would not look at.
void require_aorta_alone(const CLI::App& segment);

}  // namespace ostia::app
