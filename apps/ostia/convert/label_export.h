#pragma once
/// \file A case's vessels as label volumes: `ostia convert CASE LABELS --grid IMAGE`.

#include "commands.h"

namespace ostia::app {

/// True where `options` asks for labels of a case.
bool converts_to_labels(const ConvertCommand& options);
ExitCode convert_to_labels(const ConvertCommand& options, const core::TaskContext& task);

}  // namespace ostia::app
