#include "vtk/trial.h"

#include <sys/wait.h>

#include <cerrno>
#include <fstream>

namespace ostia::io {
namespace fs = std::filesystem;

/// Memory that reading a file may take: meshes are not packed a hundredfold, a damaged size can ask for
/// anything.
void limit_memory(const fs::path& path) {
  long pages = 0;
  if (std::ifstream("/proc/self/statm") >> pages && pages > 0) {
    const auto in_use = static_cast<rlim_t>(pages) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
    const rlim_t limit = in_use + (rlim_t{1} << 30) + 100 * static_cast<rlim_t>(fs::file_size(path));
    const rlimit both{limit, limit};
    ::setrlimit(RLIMIT_AS, &both);
  }
}

std::pair<std::string, int> outcome_of(pid_t child, int pipe) {
  std::string said;
  char block[512];
  for (;;) {
    const ssize_t count = ::read(pipe, block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    said.append(block, static_cast<std::size_t>(count));
  }
  ::close(pipe);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return {said, status};
}

}  // namespace ostia::io
