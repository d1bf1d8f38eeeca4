#pragma once
/// \file How long the program has been running.

namespace ostia::live {

/// Seconds since the process began, the loading of its libraries included; exact to the kernel's tick of 10
/// ms.
double seconds_since_start();

/// When the window showed its first picture, and when what it was opened for.
struct StartTimes {
  double first_picture_s = 0.0, prepared_s = 0.0;
};

}  // namespace ostia::live
