#pragma once
/// \file The libraries' errors as the exceptions of ostia/errors.py.

#include <pybind11/pybind11.h>

#include <exception>
#include <string>

namespace ostia::python {

/// Sets the Python exception that belongs to an error below ostia::Error, std::bad_alloc among them. What is
/// none of these goes on to the next translator.
void translate(std::exception_ptr error);

/// Something is asked for that the function does not have: ostia.UsageError, a TypeError.
[[noreturn]] void refuse_call(const std::string& message);

}  // namespace ostia::python
