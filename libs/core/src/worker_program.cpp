#include "ostia/core/worker_program.h"

#include <cstdlib>
#include <system_error>

namespace fs = std::filesystem;

namespace ostia::core {
namespace {

// In a function, since programs tell it before main begins.
fs::path& told_worker() {
#ifdef OSTIA_BUILD_WORKER
  static fs::path told = OSTIA_BUILD_WORKER;  // part of another project's build: nothing is installed
#else
  static fs::path told;
#endif
  return told;
}

}  // namespace

fs::path worker_program() {
  if (const char* given = std::getenv("OSTIA_WORKER")) return given;
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const fs::path beside = folder / "ostia-worker";
  for (const fs::path& place :
       {beside, folder / OSTIA_LIBEXEC_FROM_BIN / "ostia" / "ostia-worker", told_worker()})
    if (fs::exists(place, ignored)) return place.lexically_normal();
  return beside;
}

void set_worker_program(const fs::path& program) {
  told_worker() = program;
}

}  // namespace ostia::core
