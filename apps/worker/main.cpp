// The worker: runs libraries that may crash on bad input, or swell, where a crash costs nothing but this
// process. It is started by the programs alone (ostia::core::run_child), with limits on memory, time and
// output.

#ifdef OSTIA_WORKER_DECODE
#include "ostia/imaging/dicom.h"
#endif
#ifdef OSTIA_WORKER_TETRAHEDRALIZE
#include "ostia/meshing/tetrahedralize.h"
#endif

#include <sys/prctl.h>
#include <sys/resource.h>

#include <clocale>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>

namespace {

constexpr int kUsage = 2;
constexpr int kFault = 6;

struct Task {
  std::string_view name;
  int (*run)(const std::filesystem::path& in, const std::filesystem::path& out);
};

constexpr Task kTasks[] = {
#ifdef OSTIA_WORKER_DECODE
    {"decode", ostia::imaging::decode_dicom_files},
#endif
#ifdef OSTIA_WORKER_TETRAHEDRALIZE
    {"tetrahedralize", ostia::meshing::tetrahedralize_in_worker},
#endif
};

int usage() {
  std::fprintf(stderr, "usage: ostia-worker TASK IN OUT\ntasks:");
  for (const Task& task : kTasks)
    std::fprintf(stderr, " %.*s", static_cast<int>(task.name.size()), task.name.data());
  std::fprintf(stderr, "\nThis program is run by ostia; it is of no use by itself.\n");
  return kUsage;
}

/// A crash here is expected now and then, and its memory is a patient's image: no core file.
void keep_no_core() {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::prctl(PR_SET_DUMPABLE, 0);
}

}  // namespace

int main(int argc, char** argv) {
  keep_no_core();
  std::setlocale(LC_ALL, "C");
  if (argc != 4) return usage();
  for (const Task& task : kTasks) {
    if (task.name != argv[1]) continue;
    try {
      return task.run(argv[2], argv[3]);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return kFault;
    }
  }
  return usage();
}
