#pragma once
/// \file What is known at points and elements, as arrays.

#include "array.h"

#include "ostia/core/error.h"
#include "ostia/io/volume_fields.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace ostia::python {

/// (n,) or (n, components).
inline py::array field_array(const io::FieldValues& field) {
  const auto rows = static_cast<py::ssize_t>(field.values.size()) / field.components;
  py::array_t<double> array = field.components == 1
                                  ? py::array_t<double>(rows)
                                  : py::array_t<double>({rows, static_cast<py::ssize_t>(field.components)});
  std::copy(field.values.begin(), field.values.end(), array.mutable_data());
  return array;
}
inline py::dict field_arrays(const std::map<std::string, io::FieldValues>& fields) {
  py::dict out;
  for (const auto& [name, field] : fields) out[name.c_str()] = field_array(field);
  return out;
}

/// The other way. Throws InvalidInput that names the field.
inline io::FieldValues field_of(const std::string& name, const py::object& given) {
  const py::array any = any_array(given, "fields['" + name + "']");
  const std::vector<py::ssize_t> shape =
      any.ndim() == 1 ? std::vector<py::ssize_t>{-1} : std::vector<py::ssize_t>{-1, -1};
  const py::array array = taken(any, {"fields['" + name + "']", 'f', 8, shape}, {true, true});
  const auto* first = static_cast<const double*>(array.data());
  return {any.ndim() == 1 ? 1 : static_cast<int>(array.shape(1)), {first, first + array.size()}};
}
inline std::map<std::string, io::FieldValues> fields_of(const py::dict& given) {
  std::map<std::string, io::FieldValues> fields;
  for (const auto& [key, value] : given) {
    const std::string name = py::str(key);
    fields[name] = field_of(name, py::reinterpret_borrow<py::object>(value));
  }
  return fields;
}

}  // namespace ostia::python
