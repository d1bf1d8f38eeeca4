#pragma once
/// \file The options that say what synthetic scans are made.

#include "commands.h"

namespace CLI {
class App;
}

namespace ostia::app {

void add_phantom(CLI::App& app, PhantomCommand& o);

}  // namespace ostia::app
