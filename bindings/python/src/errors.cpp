#include "errors.h"

#include "ostia/core/error.h"

#include <new>

namespace ostia::python {
namespace py = pybind11;
namespace {

void set(const char* name, const char* message) {
  const py::object type = py::module_::import("ostia.errors").attr(name);
  PyErr_SetString(type.ptr(), message);
}

}  // namespace

void translate(std::exception_ptr error) {
  if (!error) return;
  try {
    std::rethrow_exception(error);
  } catch (const UsageError& e) {
    set("UsageError", e.what());
  } catch (const InvalidInput& e) {
    set("InvalidInput", e.what());
  } catch (const IoError& e) {
    set("IoError", e.what());
  } catch (const GeometryError& e) {
    set("GeometryError", e.what());
  } catch (const NumericalError& e) {
    set("NumericalError", e.what());
  } catch (const ResourceError& e) {
    set("ResourceError", e.what());
  } catch (const Cancelled& e) {
    set("Cancelled", e.what());
  } catch (const Error& e) {
    set("Error", e.what());
  } catch (const std::bad_alloc&) {
    set("ResourceError", "out of memory");
  }
}

void refuse_call(const std::string& message) {
  throw UsageError(message);
}

}  // namespace ostia::python
