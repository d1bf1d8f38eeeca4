#pragma once
/// \file A motion as Python has it.

#include "options.h"

#include "ostia/geometry/tri_mesh.h"
#include "ostia/motion/moving_cage.h"

#include <optional>
#include <utility>

namespace ostia::python {

template <>
struct WordsOf<geometry::PhaseOrigin> {
  static constexpr std::pair<const char*, geometry::PhaseOrigin> words[] = {
      {"at_rest", geometry::PhaseOrigin::at_rest},
      {"fitted", geometry::PhaseOrigin::fitted},
      {"bridged", geometry::PhaseOrigin::bridged}};
};

/// A cage over the cycle with the surface that it was fitted to. Immutable.
struct Motion {
  geometry::CageMotion cage;
  std::optional<geometry::TriMesh> surface;  ///< the template's
  motion::MovingCage moving;
  Motion(geometry::CageMotion given, std::optional<geometry::TriMesh> shape)
      : cage(std::move(given)), surface(std::move(shape)), moving(cage) {}
};

}  // namespace ostia::python
