// The worker: runs libraries that may crash on bad input, or swell, where a crash costs nothing but this
// process. It is started by the programs alone (ostia::core::run_child), with limits on memory, time and
// output.

#ifdef OSTIA_WORKER_DECODE
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/foreign_image.h"
#endif
#ifdef OSTIA_WORKER_TETRAHEDRALIZE
#include "ostia/meshing/tetrahedralize.h"
#endif

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <cerrno>
#include <clocale>
#include <cstddef>
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
    {"read-image", ostia::imaging::read_foreign_image_in_worker},
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

/// Foreign data may take a library over: it shall not reach the network. Where the kernel has no such filter
/// the work goes on.
void keep_off_network() {
  sock_filter rules[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_socket, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{sizeof rules / sizeof rules[0], rules};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

}  // namespace

int main(int argc, char** argv) {
  keep_no_core();
  keep_off_network();
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
