#pragma once
/// \file What is said of a case file whose rows cannot be read.

#include "ostia/core/error.h"

#include <string>

namespace ostia::session {

[[noreturn]] inline void damaged(const std::string& what) {
  throw InvalidInput("the case is damaged: " + what + "; take a copy of it from a backup");
}

}  // namespace ostia::session
