#include "ostia/core/version.h"

namespace ostia::core {

std::string version() {
  return OSTIA_VERSION;
}

}  // namespace ostia::core
