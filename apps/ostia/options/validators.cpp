#include "options/validators.h"

#include <CLI/App.hpp>

#include <cmath>
#include <string>

namespace ostia::app {
namespace {

CLI::Validator at_least(bool zero_too, const char* name, const char* words) {
  return {[zero_too, words](std::string& text) {
            double value = 0.0;
            const bool fine = CLI::detail::lexical_cast(text, value) && std::isfinite(value) &&
                              (zero_too ? value >= 0.0 : value > 0.0);
            return fine ? std::string() : text + " is not a number " + words;
          },
          name};
}

}  // namespace

CLI::Validator above_zero() {
  return at_least(false, "above 0", "above 0");
}

CLI::Validator zero_or_above() {
  return at_least(true, "0 or above", "that is 0 or above");
}

}  // namespace ostia::app
