#pragma once
/// \file Every failure Ostia reports. A message names the object, the value, the unit and the way out.

#include <stdexcept>
#include <string>

namespace ostia {

/// Exit codes of the programs; scripts rely on them.
enum class ExitCode : int {
  ok = 0,
  usage = 2,           ///< wrong usage
  bad_input = 3,       ///< bad input, do not retry
  quality_failed = 4,  ///< done, but quality control failed: a person must look
  resources = 5,       ///< out of memory, disk or time: retry with more
  internal = 6,        ///< a fault of the program
};

/// Base of all errors that Ostia throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  virtual ExitCode exit_code() const noexcept { return ExitCode::internal; }
};

/// The command line asks for something that makes no sense; `--help` tells.
class UsageError : public Error {
 public:
  using Error::Error;
  ExitCode exit_code() const noexcept override { return ExitCode::usage; }
};

/// The input (file content, parameter) is not acceptable; the same call will fail again.
class InvalidInput : public Error {
 public:
  using Error::Error;
  ExitCode exit_code() const noexcept override { return ExitCode::bad_input; }
};

/// A file or folder cannot be read or written (missing, permissions). A full disk is a ResourceError.
class IoError : public Error {
 public:
  using Error::Error;
  ExitCode exit_code() const noexcept override { return ExitCode::bad_input; }
};

/// Geometry that an algorithm cannot work on (open where closed is needed, self-intersecting, unreachable).
class GeometryError : public Error {
 public:
  using Error::Error;
  ExitCode exit_code() const noexcept override { return ExitCode::bad_input; }
};

/// A computation did not converge or lost its precision.
class NumericalError : public Error {
 public:
  using Error::Error;
  ExitCode exit_code() const noexcept override { return ExitCode::internal; }
};

/// Out of memory, disk or time; the same call may succeed with more of it.
class ResourceError : public Error {
 public:
  using Error::Error;
  ExitCode exit_code() const noexcept override { return ExitCode::resources; }
};

/// The user cancelled. Nothing half-written is left behind.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
  ExitCode exit_code() const noexcept override { return static_cast<ExitCode>(130); }
};

}  // namespace ostia
