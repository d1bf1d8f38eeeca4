#pragma once
/// \file Standard output kept for one result.

#include <unistd.h>

#include <cstdio>

namespace ostia::app {

/// What a command prints on standard output goes to standard error while it lives, where it is asked for one
/// JSON object.
class OutputAside {
 public:
  explicit OutputAside(bool aside) {
    if (!aside) return;
    std::fflush(stdout);
    kept_ = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~OutputAside() {
    if (kept_ < 0) return;
    std::fflush(stdout);
    ::dup2(kept_, STDOUT_FILENO);
    ::close(kept_);
  }
  OutputAside(const OutputAside&) = delete;
  OutputAside& operator=(const OutputAside&) = delete;

 private:
  int kept_ = -1;
};

}  // namespace ostia::app
