#pragma once
/// \file A library's results as dictionaries of their members, named once by OSTIA_FIGURES: numbers, words,
/// lists of such dictionaries, and arrays.

#include "options.h"
#include "values.h"

#include <cstdint>
#include <type_traits>

/// As OSTIA_OPTIONS: a member that is new does not compile until it is named.
#define OSTIA_FIGURES(Type, shown, others) OSTIA_OPTIONS(Type, shown, others)

namespace ostia::python {

template <class T>
py::object figure_of(const T& value);

/// All members of a result by name. Vectors of numbers become (n,) arrays, of places (n, 3) ones.
template <class T>
py::dict figures(const T& value) {
  py::dict members;
  T copy = value;
  OptionsOf<T>::visit(copy, [&](const char* name, auto& member) {
    members[detail::spelled(name).c_str()] = figure_of(member);
  });
  return members;
}

template <class T>
py::object figure_of(const T& value) {
  if constexpr (detail::Optional<T>::value) {
    return value ? figure_of(*value) : py::none();
  } else if constexpr (OptionsOf<T>::known) {
    return figures(value);
  } else if constexpr (std::is_enum_v<T>) {
    return py::str(detail::word_of(value));
  } else if constexpr (std::is_same_v<T, geometry::Vec3>) {
    return tuple_of(value);
  } else if constexpr (detail::Vector<T>::value) {
    using Item = typename detail::Vector<T>::Value;
    if constexpr ((std::is_arithmetic_v<Item> && !std::is_same_v<Item, bool>) ||
                  std::is_same_v<Item, geometry::Vec3>) {
      return array_of(value);
    } else {
      py::list list;
      for (const auto& one : value) list.append(figure_of(Item(one)));
      return list;
    }
  } else {
    return py::cast(value);
  }
}

/// The same of a list of results.
template <class T>
py::list figures_of(const std::vector<T>& values) {
  py::list rows;
  for (const T& value : values) rows.append(figures(value));
  return rows;
}

}  // namespace ostia::python
