#include "array.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <stdexcept>

namespace ostia::python {
namespace {

std::string shape_text(const std::vector<py::ssize_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i == 0 ? "" : ", ") + (shape[i] < 0 ? std::string("n") : std::to_string(shape[i]));
  return text + (shape.size() == 1 ? ",)" : ")");
}

std::string type_text(char kind, std::size_t bytes) {
  const std::string word = kind == 'f' ? "float" : kind == 'i' ? "int" : "uint";
  return word + std::to_string(8 * bytes);
}

std::vector<py::ssize_t> shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

bool fits(const std::vector<py::ssize_t>& shape, const std::vector<py::ssize_t>& wanted) {
  if (shape.size() != wanted.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (wanted[i] >= 0 && shape[i] != wanted[i]) return false;
  return true;
}

void require_shape(const py::array& array, const ArrayWanted& wanted) {
  const std::vector<py::ssize_t> shape = shape_of(array);
  if (fits(shape, wanted.shape)) return;
  const std::vector<py::ssize_t> turned(shape.rbegin(), shape.rend());
  const std::string way =
      shape.size() == 2 && fits(turned, wanted.shape) ? "; give " + wanted.name + ".T" : "";
  throw InvalidInput(wanted.name + ": an array of shape " + described(array) + "; it must be of shape " +
                     shape_text(wanted.shape) + way);
}

void require_numbers(const py::array& array, const ArrayWanted& wanted) {
  const char kind = array.dtype().kind();
  const bool whole = kind == 'i' || kind == 'u' || kind == 'b';
  if (whole || (kind == 'f' && wanted.kind == 'f')) return;
  const std::string type = type_text(wanted.kind, wanted.bytes);
  throw InvalidInput(wanted.name + ": an array of shape " + described(array) + " holds no " +
                     (wanted.kind == 'f' ? "numbers" : "whole numbers") + "; give " + wanted.name +
                     ".astype('" + type + "')");
}

bool as_wanted(const py::array& array, const ArrayWanted& wanted) {
  const py::dtype type = array.dtype();
  const bool native = type.attr("isnative").cast<bool>();
  const std::uintptr_t address = reinterpret_cast<std::uintptr_t>(array.data());
  return type.kind() == wanted.kind && static_cast<std::size_t>(type.itemsize()) == wanted.bytes && native &&
         (array.flags() & py::array::c_style) != 0 && address % wanted.bytes == 0;
}

/// Each reason once in a process: a loop over a thousand meshes says it once.
void tell_copy(const py::array& array, const std::string& name, const std::string& type) {
  static std::set<std::string> told;
  const bool ordered = (array.flags() & py::array::c_style) != 0;
  const std::string why = name + (ordered ? "" : " of another order in memory") + " as " + type + " from " +
                          py::str(array.dtype()).cast<std::string>();
  if (!told.insert(why).second) return;
  py::module_::import("logging").attr("getLogger")("ostia").attr("warning")(
      "copied %s, %.1f MB; give it C-contiguous, or copy=False to refuse it (told once)", why,
      static_cast<double>(array.nbytes()) / 1e6);
}

}  // namespace

Copying copying_of(const py::object& copy) {
  if (copy.is_none()) return {};
  if (!PyBool_Check(copy.ptr())) throw InvalidInput("copy: True, False, or None for only where it must be");
  return copy.cast<bool>() ? Copying{true, true} : Copying{false, false};
}

std::string described(const py::array& array) {
  return shape_text(shape_of(array)) + " of " + py::str(array.dtype()).cast<std::string>();
}

py::array any_array(const py::object& given, const std::string& name) {
  if (py::isinstance<py::array>(given)) return py::reinterpret_borrow<py::array>(given);
  try {
    return py::module_::import("numpy").attr("asarray")(given).cast<py::array>();
  } catch (const py::error_already_set& error) {
    if (error.matches(PyExc_MemoryError) || error.matches(PyExc_KeyboardInterrupt)) throw;
    throw InvalidInput(name + ": it is not rows of the same number of numbers; give a numpy array");
  }
}

py::array taken(const py::object& given, const ArrayWanted& wanted, const Copying& copying) {
  const bool foreign = !py::isinstance<py::array>(given);
  const py::array array = any_array(given, wanted.name);
  require_shape(array, wanted);
  require_numbers(array, wanted);
  if (as_wanted(array, wanted) && !copying.asked) return array;
  const std::string type = type_text(wanted.kind, wanted.bytes);
  if (!copying.allowed)
    throw InvalidInput(wanted.name + ": an array of shape " + described(array) +
                       " would have to be copied; give numpy.ascontiguousarray(" + wanted.name + ", '" +
                       type + "'), or leave copy=False out");
  if (!copying.asked && !foreign) tell_copy(array, wanted.name, type);
  const py::object made = py::module_::import("numpy").attr("array")(
      array, py::arg("dtype") = type, py::arg("order") = "C", py::arg("copy") = true);
  if (wanted.kind != 'f' && !py::module_::import("numpy").attr("array_equal")(made, array).cast<bool>())
    throw InvalidInput(wanted.name + ": an array of shape " + described(array) + " has values that " + type +
                       " cannot hold; scale it, or clip it first");
  return made.cast<py::array>();
}

namespace {

constexpr py::ssize_t many_values = 100000;  // from here on others may work meanwhile
constexpr std::size_t block = 4096;          // a number that is known lets the compiler take many at once

/// Whether all exponents are those of finite numbers: with one more, the rest reach the highest bit.
template <class T, class Bits, Bits exponent, Bits least>
bool finite_block(const T* values) {
  Bits reached = 0;
  for (std::size_t i = 0; i < block; ++i) {
    Bits bits = 0;
    std::memcpy(&bits, values + i, sizeof(bits));
    reached |= (bits & exponent) + least;
  }
  return reached >> (8 * sizeof(Bits) - 1) == 0;
}
bool finite_block(const float* values) {
  return finite_block<float, std::uint32_t, 0x7f800000U, 0x00800000U>(values);
}
bool finite_block(const double* values) {
  return finite_block<double, std::uint64_t, 0x7ff0000000000000U, 0x0010000000000000U>(values);
}

/// Of [first, last); `last` where there is none.
template <class T>
std::size_t not_finite_in(const T* values, std::size_t first, std::size_t last) {
  for (; first + block <= last && finite_block(values + first); first += block) {
  }
  while (first < last && std::isfinite(values[first])) ++first;
  return first;
}

template <class T>
py::ssize_t first_not_finite(const py::array& array) {
  constexpr std::size_t grain = std::size_t{1} << 20;
  const T* values = static_cast<const T*>(array.data());
  const auto count = static_cast<std::size_t>(array.size());
  std::optional<py::gil_scoped_release> released;
  if (array.size() > many_values) released.emplace();
  const std::size_t found = core::parallel_reduce(
      count, grain, count,
      [&](std::size_t first, std::size_t last) {
        const std::size_t at = not_finite_in(values, first, last);
        return at == last ? count : at;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  return found == count ? -1 : static_cast<py::ssize_t>(found);
}

}  // namespace

void require_finite(const py::array& array, const std::string& name) {
  const py::ssize_t at =
      array.itemsize() == 4 ? first_not_finite<float>(array) : first_not_finite<double>(array);
  if (at < 0) return;
  const py::object index = py::module_::import("numpy").attr("unravel_index")(at, array.attr("shape"));
  throw InvalidInput(name + ": an array of shape " + described(array) + " is not finite at " +
                     py::str(index).cast<std::string>() + "; leave such values out");
}

py::array view_of(const py::dtype& type, std::vector<py::ssize_t> shape, const void* data,
                  const py::handle& owner) {
  py::array view(type, std::move(shape), {}, data, owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

Held::~Held() {
  if (Py_IsInitialized() == 0) {
    object_.release();  // the interpreter has ended: nothing is left to let go
    return;
  }
  const py::gil_scoped_acquire locked;
  object_ = py::object();
}

geometry::Vec3 place_of(const py::object& given, const std::string& name) {
  const py::array array = taken(given, {name, 'f', 8, {3}}, {true, true});
  require_finite(array, name);
  const auto* values = static_cast<const double*>(array.data());
  return {values[0], values[1], values[2]};
}

std::vector<geometry::Vec3> places_of(const py::object& given, const std::string& name) {
  if (given.is_none() || (py::isinstance<py::sequence>(given) && py::len(given) == 0)) return {};
  const py::array array = taken(given, {name, 'f', 8, {-1, 3}}, {true, true});
  require_finite(array, name);
  std::vector<geometry::Vec3> places(static_cast<std::size_t>(array.shape(0)));
  std::memcpy(static_cast<void*>(places.data()), array.data(), static_cast<std::size_t>(array.nbytes()));
  return places;
}

std::vector<double> numbers_of(const py::object& given, const std::string& name) {
  const py::array array = taken(given, {name, 'f', 8, {-1}}, {true, true});
  require_finite(array, name);
  const auto* values = static_cast<const double*>(array.data());
  return {values, values + array.size()};
}

py::tuple tuple_of(const geometry::Vec3& place) {
  return py::make_tuple(place.x(), place.y(), place.z());
}

}  // namespace ostia::python
