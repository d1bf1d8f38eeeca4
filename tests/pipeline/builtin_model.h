#pragma once
/// \file The built-in case and its model, made once for all tests of a program.

#include "ostia/pipeline/model.h"
#include "ostia/pipeline/truth.h"

namespace ostia::pipeline {

inline const phantom::BuiltinCase& builtin_case() {
  static const phantom::BuiltinCase instance = phantom::make_builtin_case();
  return instance;
}

inline ModelOptions builtin_options() {
  ModelOptions options;
  options.branches = branches_of(builtin_case());
  return options;
}

inline const Model& builtin_model() {
  static const Model instance = build_model(source_of(builtin_case()), builtin_options());
  return instance;
}

}  // namespace ostia::pipeline
