#pragma once
/// \file What the command line says of an input and of a model, as the libraries take it.

#include "commands.h"

#include "ostia/pipeline/model.h"
#include "ostia/pipeline/source.h"

namespace ostia::app {

struct SeedFrame;

pipeline::SourceOptions source_options(const InputOptions& input);

/// Everything of a model's options that the command line can say; points as `frame` (seeds.h) has them.
/// Throws InvalidInput for points and files of points that cannot be read, UsageError for options that do not
/// go together.
void apply(const LumenOptions& from, const SeedFrame& frame, pipeline::ModelOptions& to);
void apply(const EndOptions& from, const SeedFrame& frame, pipeline::ModelOptions& to);
void apply(const MeshOptions& from, pipeline::ModelOptions& to);

}  // namespace ostia::app
