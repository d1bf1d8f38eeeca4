// The worker: runs libraries that may crash on bad input, or swell, where a crash costs nothing but this
// process. It is started by the programs alone (ostia::core::run_child), with limits on memory, time and
// output.

#ifdef OSTIA_WORKER_DECODE
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/foreign_image.h"
#include "ostia/imaging/worker_reads.h"
#endif
#ifdef OSTIA_WORKER_TETRAHEDRALIZE
#include "ostia/meshing/tetrahedralize.h"
#endif

#include "ostia/core/process_cell.h"

#include <sys/prctl.h>
#include <sys/resource.h>

#include <clocale>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>
#include <vector>

namespace {

constexpr int kUsage = 2;
constexpr int kFault = 6;

using Paths = std::vector<std::filesystem::path>;
Paths itself(const std::filesystem::path& in) {
  return {in};
}

struct Task {
  std::string_view name;
  int (*run)(const std::filesystem::path& in, const std::filesystem::path& out);
  Paths (*reads)(const std::filesystem::path& in);  ///< what `run` has to read
};

constexpr Task kTasks[] = {
#ifdef OSTIA_WORKER_DECODE
    {"decode", ostia::imaging::decode_dicom_files, ostia::imaging::reads_of_decoding},
    {"read-image", ostia::imaging::read_foreign_image_in_worker, ostia::imaging::reads_of_foreign_image},
#endif
#ifdef OSTIA_WORKER_TETRAHEDRALIZE
    {"tetrahedralize", ostia::meshing::tetrahedralize_in_worker, itself},
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

/// Foreign data may take a library over: it shall reach no network, no program, and no file but those of the
/// task. What the kernel does not have is left out, and the work goes on (`ostia doctor` says so).
void enter_cell(const Task& task, const std::filesystem::path& in, const std::filesystem::path& out) {
#ifndef __SANITIZE_ADDRESS__  // which looks for leaks with calls that the cell refuses
  ostia::core::CellRules rules;
  rules.reads = task.reads(in);
  rules.reads.push_back(in);
  rules.writes = {out.parent_path()};
  ostia::core::enter_cell(rules);
#else
  static_cast<void>(task), static_cast<void>(in), static_cast<void>(out);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_no_core();
  std::setlocale(LC_ALL, "C");
  if (argc != 4) return usage();
  for (const Task& task : kTasks) {
    if (task.name != argv[1]) continue;
    try {
      enter_cell(task, argv[2], argv[3]);
      return task.run(argv[2], argv[3]);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return kFault;
    }
  }
  return usage();
}
