#pragma once
/// \file What values have in common: views of their members, parts that keep the whole alive, copies.

#include "array.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ostia::python {

/// A member that is a vector, as a read-only view that keeps the object alive.
template <class T, class Member>
auto view(Member T::*member) {
  return [member](const py::object& self) { return view_of(self.cast<const T&>().*member, self); };
}

/// A part of an object as a value of its own that shares the object's memory, and keeps it alive.
template <class Part>
std::shared_ptr<Part> part_of(Part& part, const py::object& whole) {
  const auto held = std::make_shared<Held>(whole);
  return {&part, [held](Part*) {}};
}
template <class T, class Part>
auto part(Part T::*member) {
  return [member](const py::object& self) { return part_of(self.cast<T&>().*member, self); };
}

/// Items of a vector as objects that keep the one that holds them alive.
template <class T>
py::list items(const std::vector<T>& values, const py::object& owner) {
  py::list list;
  for (const T& value : values)
    list.append(py::cast(&value, py::return_value_policy::reference_internal, owner));
  return list;
}

/// Immutable values: a copy is the same.
template <class Class>
void same_when_copied(Class& type) {
  type.def("__copy__", [](const py::object& self) { return self; });
  type.def(
      "__deepcopy__", [](const py::object& self, const py::object&) { return self; }, py::arg("memo"));
}

/// Copies as arrays of their own: (n,), (n, 3), (n, N).
template <class T>
py::array array_of(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}
inline py::array array_of(const std::vector<geometry::Vec3>& places) {
  static_assert(sizeof(geometry::Vec3) == 3 * sizeof(double));
  py::array_t<double> out({static_cast<py::ssize_t>(places.size()), py::ssize_t{3}});
  double* to = out.mutable_data();
  for (const geometry::Vec3& p : places)
    for (int axis = 0; axis < 3; ++axis) *to++ = p[axis];
  return out;
}
template <std::size_t N>
py::array array_of(const std::vector<std::array<std::int32_t, N>>& rows) {
  py::array_t<std::int32_t> out({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(N)});
  std::int32_t* to = out.mutable_data();
  for (const auto& row : rows) to = std::copy(row.begin(), row.end(), to);
  return out;
}
/// The other way. Throws InvalidInput that names the argument.
template <std::size_t N>
std::vector<std::array<std::int32_t, N>> rows_of(const py::object& given, const std::string& name) {
  const py::array array = taken(given, {name, 'i', 4, {-1, static_cast<py::ssize_t>(N)}}, {true, true});
  std::vector<std::array<std::int32_t, N>> rows(static_cast<std::size_t>(array.shape(0)));
  const auto* from = static_cast<const std::int32_t*>(array.data());
  for (auto& row : rows)
    for (std::int32_t& value : row) value = *from++;
  return rows;
}
inline std::vector<std::int32_t> whole_numbers_of(const py::object& given, const std::string& name) {
  const py::array array = taken(given, {name, 'i', 4, {-1}}, {true, true});
  const auto* first = static_cast<const std::int32_t*>(array.data());
  return {first, first + array.size()};
}

/// What JSON says, as dictionaries and lists.
inline py::object json_of(const std::string& text) {
  return py::module_::import("json").attr("loads")(text);
}

}  // namespace ostia::python
