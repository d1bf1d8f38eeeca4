#pragma once
/// \file What the programs that make the docs' pictures share.

#include "ostia/core/error.h"

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace ostia::bench {

/// The body of main(): checks the number of arguments, tells what went wrong, and with which exit code.
template <class Make>
int make_picture(int argc, char** argv, const char* parameters, int count, const Make& make) {
  if (argc != count + 1) {
    std::fprintf(stderr, "usage: %s %s\n", argv[0], parameters);
    return static_cast<int>(ExitCode::usage);
  }
  try {
    make(std::vector<std::string>(argv + 1, argv + argc));
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return static_cast<int>(error.exit_code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return static_cast<int>(ExitCode::internal);
  }
}

}  // namespace ostia::bench
