#pragma once
/// \file Contours across vessels, and the frames and curves that they lie about.

#include "options.h"
#include "rooms.h"

#include "ostia/geometry/contour_set.h"

namespace ostia::python {

template <>
struct WordsOf<geometry::Health> {
  static constexpr std::pair<const char*, geometry::Health> words[] = {
      {"healthy", geometry::Health::healthy}, {"diseased", geometry::Health::diseased}};
};

void bind_contours(py::module_& m);

}  // namespace ostia::python
