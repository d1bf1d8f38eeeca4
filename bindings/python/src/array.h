#pragma once
/// \file NumPy arrays and the libraries' vectors as one memory, both ways.

#include "ostia/geometry/vec.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ostia::python {

namespace py = pybind11;

/// What an argument must be.
struct ArrayWanted {
  std::string name;                ///< of the argument: "points"
  char kind = 'f';                 ///< 'f', 'i', 'u' as numpy.dtype.kind has them
  std::size_t bytes = 8;           ///< of a value
  std::vector<py::ssize_t> shape;  ///< -1: any
};
/// Whether an array that is not kept as it is may be copied: None (it is, and logged once), True, False.
struct Copying {
  bool allowed = true, asked = false;
};
Copying copying_of(const py::object& copy);

/// Of anything that NumPy can make an array of. Throws InvalidInput that names the argument.
py::array any_array(const py::object& given, const std::string& name);
/// An array with contiguous values of the type that is wanted, kept as it is where it has that already.
/// Throws InvalidInput that names the argument, what it is and the way out.
py::array taken(const py::object& given, const ArrayWanted& wanted, const Copying& copying);
/// Throws InvalidInput for a value that is not finite, with its index.
void require_finite(const py::array& array, const std::string& name);
/// "(3, 100) of float32".
std::string described(const py::array& array);

/// A view of memory that `owner` keeps alive; nobody may write to it.
py::array view_of(const py::dtype& type, std::vector<py::ssize_t> shape, const void* data,
                  const py::handle& owner);

template <class T>
py::array view_of(const std::vector<T>& values, const py::handle& owner) {
  return view_of(py::dtype::of<T>(), {static_cast<py::ssize_t>(values.size())}, values.data(), owner);
}
inline py::array view_of(const std::vector<geometry::Vec3>& places, const py::handle& owner) {
  static_assert(sizeof(geometry::Vec3) == 3 * sizeof(double));
  return view_of(py::dtype::of<double>(), {static_cast<py::ssize_t>(places.size()), 3}, places.data(), owner);
}
template <std::size_t N>
py::array view_of(const std::vector<std::array<std::int32_t, N>>& rows, const py::handle& owner) {
  static_assert(sizeof(std::array<std::int32_t, N>) == N * sizeof(std::int32_t));
  return view_of(py::dtype::of<std::int32_t>(),
                 {static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(N)}, rows.data(), owner);
}

/// A Python object that may be let go from any thread.
class Held {
 public:
  explicit Held(py::object object) : object_(std::move(object)) {}
  ~Held();
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

 private:
  py::object object_;
};

// The libraries take std::vectors, and an array of NumPy's is not one. A vector whose three pointers are set
// to the array's memory is, for who reads it and never lets it grow or end: values that came from Python are
// const, and `take_back` empties the vector before its destructor runs. A cast to a base that is not
// accessible is allowed to this kind of cast alone; no memory is seen as what it is not. The pointers' names
// are those of one library, and any other does not compile.
#if !defined(__GLIBCXX__) || defined(_GLIBCXX_DEBUG)
#error "arrays are lent to the vectors of libstdc++, without its debug mode"
#endif
template <class T>
void set_pointers(std::vector<T>& vector, T* first, T* last) noexcept {
  auto& pointers = ((std::_Vector_base<T, std::allocator<T>>&)vector)._M_impl;
  pointers._M_start = first;
  pointers._M_finish = pointers._M_end_of_storage = last;
}
/// The vector is empty and has no memory of its own.
template <class T>
void lend(std::vector<T>& vector, const void* data, std::size_t count) {
  T* first = const_cast<T*>(static_cast<const T*>(data));
  set_pointers(vector, first, first + count);
}
template <class T>
void take_back(std::vector<T>& vector) noexcept {
  set_pointers<T>(vector, nullptr, nullptr);
}

/// A place, or places, from anything that NumPy can make an array of. Throws InvalidInput.
geometry::Vec3 place_of(const py::object& given, const std::string& name);
std::vector<geometry::Vec3> places_of(const py::object& given, const std::string& name);
std::vector<double> numbers_of(const py::object& given, const std::string& name);
py::tuple tuple_of(const geometry::Vec3& place);

}  // namespace ostia::python
