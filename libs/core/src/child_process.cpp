#include "ostia/core/child_process.h"

#include "ostia/core/error.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

extern char** environ;  // NOLINT(readability-redundant-declaration)

namespace ostia::core {
namespace fs = std::filesystem;
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool limit_memory = false;  // AddressSanitizer maps terabytes of address space
#else
constexpr bool limit_memory = true;
#endif

constexpr std::size_t kept_error_bytes = 64 << 10;

void set_limit(decltype(RLIMIT_CPU) what, rlim_t soft, rlim_t hard) {
  const rlimit limit{soft, hard};
  ::setrlimit(what, &limit);
}

void apply_limits(const ChildLimits& limits) {
  if (limit_memory) set_limit(RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
  const auto seconds = static_cast<rlim_t>(limits.cpu_time.count());
  set_limit(RLIMIT_CPU, seconds, seconds + 2);
  set_limit(RLIMIT_FSIZE, limits.output_bytes, limits.output_bytes);
  set_limit(RLIMIT_CORE, 0, 0);  // a core file would hold the patient's image
}

std::vector<std::string> reduced_environment() {
  std::vector<std::string> kept{"LC_ALL=C"};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    for (const std::string_view name :
         {"PATH=", "TMPDIR=", "OSTIA_", "ASAN_OPTIONS=", "UBSAN_OPTIONS=", "LD_LIBRARY_PATH="}) {
      if (text.substr(0, name.size()) == name) kept.emplace_back(text);
    }
  }
  return kept;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (std::string& text : texts) out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw ResourceError("cannot make a pipe to a child process: " + std::generic_category().message(errno));
    }
  }
  ~Pipe() {
    for (const int fd : ends) {
      if (fd >= 0) ::close(fd);
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_writer() {
    ::close(ends[1]);
    ends[1] = -1;
  }
};

// Runs in the child between fork and exec: only async-signal-safe calls.
[[noreturn]] void become(const char* program, char* const* arguments, char* const* environment,
                         const ChildLimits& limits, int error_fd, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  ::setpgid(0, 0);  // Ctrl-C in the terminal goes to the parent, which decides
  const int null_fd = ::open("/dev/null", O_RDWR);
  ::dup2(null_fd, STDIN_FILENO);
  ::dup2(null_fd, STDOUT_FILENO);
  ::dup2(error_fd, STDERR_FILENO);
  apply_limits(limits);
  ::execve(program, arguments, environment);
  ::_exit(127);
}

void keep_tail(std::string& text, const char* data, std::size_t size) {
  text.append(data, size);
  if (text.size() > 2 * kept_error_bytes) text.erase(0, text.size() - kept_error_bytes);
}

/// A file that grows; nothing where no name is given.
class GrowingLog {
 public:
  explicit GrowingLog(const fs::path& path) {
    if (path.empty()) return;
    fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (fd_ < 0)
      throw IoError("cannot write " + path.string() + ": " + std::generic_category().message(errno));
  }
  ~GrowingLog() {
    if (fd_ >= 0) ::close(fd_);
  }
  GrowingLog(const GrowingLog&) = delete;
  GrowingLog& operator=(const GrowingLog&) = delete;
  /// A log that a full disk cuts off is no reason to end the work that it is about.
  void add(const char* data, std::size_t size) const {
    while (fd_ >= 0 && size > 0) {
      const ssize_t wrote = ::write(fd_, data, size);
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote <= 0) return;
      data += wrote;
      size -= static_cast<std::size_t>(wrote);
    }
  }

 private:
  int fd_ = -1;
};

// Reads the child's standard error until it closes; kills the child on cancel.
std::string drain(int fd, pid_t child, const TaskContext& task, const GrowingLog& log) {
  std::string text;
  std::array<char, 4096> block{};
  while (true) {
    if (task.cancelled()) ::kill(-child, SIGKILL);
    pollfd wait{fd, POLLIN, 0};
    const int ready = ::poll(&wait, 1, 50);
    if (ready < 0 && errno != EINTR) break;
    if (ready <= 0) continue;
    const ssize_t got = ::read(fd, block.data(), block.size());
    if (got == 0 || (got < 0 && errno != EINTR)) break;
    if (got <= 0) continue;
    keep_tail(text, block.data(), static_cast<std::size_t>(got));
    log.add(block.data(), static_cast<std::size_t>(got));
  }
  if (text.size() > kept_error_bytes) text.erase(0, text.size() - kept_error_bytes);
  return text;
}

}  // namespace

std::string ChildResult::describe() const {
  if (out_of_time) return "ran out of its CPU time";
  if (signal != 0) {
    const char* name = ::strsignal(signal);
    return "was killed by signal " + std::to_string(signal) + " (" + (name ? name : "unknown") + ")";
  }
  return "exited with code " + std::to_string(exit_code);
}

ChildResult run_child(const fs::path& program, const std::vector<std::string>& arguments,
                      const ChildLimits& limits, const TaskContext& task, const fs::path& log_file) {
  if (::access(program.c_str(), X_OK) != 0) {
    throw IoError("the program " + program.string() + " is not there or cannot be run; install Ostia whole");
  }
  task.throw_if_cancelled();
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = reduced_environment();
  const std::vector<char*> argv = pointers(words);
  const std::vector<char*> envp = pointers(variables);
  const GrowingLog log(log_file);
  Pipe errors;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0)
    throw ResourceError("cannot start a child process: " + std::generic_category().message(errno));
  if (child == 0) become(program.c_str(), argv.data(), envp.data(), limits, errors.ends[1], parent);
  ::setpgid(child, child);
  errors.close_writer();

  ChildResult result;
  result.standard_error = drain(errors.ends[0], child, task, log);
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  result.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  task.throw_if_cancelled();
  if (WIFEXITED(status)) {
    result.exit_code = WEXITSTATUS(status);
  } else {
    result.signal = WTERMSIG(status);
    result.out_of_time = result.signal == SIGXCPU;
  }
  return result;
}

std::optional<fs::path> program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder.empty() ? "." : folder) / name;
    std::error_code ignored;
    if (fs::is_regular_file(program, ignored) && ::access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

}  // namespace ostia::core
