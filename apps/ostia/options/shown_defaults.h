#pragma once
/// \file Defaults in the help, taken from the variables that options are read into.

#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

/// Before options are declared: their defaults are taken down.
void capture_defaults(CLI::App& app);
/// Afterwards: each option's text gets "; default 0.5" at its end, that of all commands below, too. Not where
/// the text says it already ("default", "left out"), nor where the variable holds what the option itself
/// would not take: that stands for a choice that is made later.
void show_defaults(CLI::App& app);

/// "; default 0.5", for a text whose variable does not hold it.
std::string default_text(double value);

}  // namespace ostia::app
