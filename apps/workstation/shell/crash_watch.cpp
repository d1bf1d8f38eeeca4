#include "shell/crash_watch.h"

#include "ostia/core/version.h"

#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <stdexcept>

namespace ostia::workstation {
namespace {

constexpr std::array<int, 5> crashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr unsigned longest_writing_s = 10;  // a report that hangs is given up
constexpr std::size_t most_commands = 24, command_bytes = 48, most_modules = 1024, name_bytes = 64;
constexpr std::size_t stack_bytes = 1U << 16;
constexpr int most_frames = 64;

struct Module {
  std::uintptr_t from, to, base;
  char name[name_bytes];
};

// All that the handler reads lies here, made beforehand: it may neither allocate nor lock.
struct Kept {
  char folder[3840];
  char version[64];
  char commands[most_commands][command_bytes];
  std::atomic<unsigned> given{0};
  Module modules[most_modules];
  std::atomic<std::size_t> module_count{0};
  alignas(16) char stack[stack_bytes];  // of its own: the thread's may be what overflowed
};
Kept kept;
std::atomic<bool> watching{false};
std::atomic_flag written = ATOMIC_FLAG_INIT;

/// Text into a file by functions that a signal handler may call.
class Out {
 public:
  explicit Out(int file) : file_(file) {}
  Out& operator<<(const char* text) {
    for (std::size_t left = std::strlen(text); left > 0;) {
      const ssize_t done = ::write(file_, text, left);
      if (done <= 0) return *this;
      text += done;
      left -= static_cast<std::size_t>(done);
    }
    return *this;
  }
  Out& number(std::uint64_t value, unsigned base = 10) {
    char digits[24];
    char* at = digits + sizeof digits - 1;
    *at = 0;
    do *--at = "0123456789abcdef"[value % base];
    while ((value /= base) != 0);
    return *this << at;
  }

 private:
  int file_;
};

const char* name_of_signal(int signal) {
  return signal == SIGSEGV   ? "SIGSEGV"
         : signal == SIGBUS  ? "SIGBUS"
         : signal == SIGFPE  ? "SIGFPE"
         : signal == SIGILL  ? "SIGILL"
         : signal == SIGABRT ? "SIGABRT"
                             : "?";
}

void append(char* text, std::size_t size, const char* more) {
  const std::size_t length = std::strlen(text), added = std::strlen(more);
  if (length + added < size) std::memcpy(text + length, more, added + 1);
}

void append(char* text, std::size_t size, std::uint64_t value) {
  char digits[24];
  char* at = digits + sizeof digits - 1;
  *at = 0;
  do *--at = static_cast<char>('0' + value % 10);
  while ((value /= 10) != 0);
  append(text, size, at);
}

int open_report(std::uint64_t now) {
  ::mkdir(kept.folder, 0700);
  ::chmod(kept.folder, 0700);
  static char path[4096];
  path[0] = 0;
  append(path, sizeof path, kept.folder);
  append(path, sizeof path, "/crash-");
  append(path, sizeof path, now);
  append(path, sizeof path, "-");
  append(path, sizeof path, static_cast<std::uint64_t>(::getpid()));
  append(path, sizeof path, ".txt");
  return ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
}

void write_frame(Out& out, std::uintptr_t at) {
  const std::size_t count = kept.module_count.load(std::memory_order_acquire);
  for (std::size_t i = 0; i < count; ++i) {
    const Module& one = kept.modules[i];
    if (at < one.from || at >= one.to) continue;
    out << "  " << one.name << " +0x";
    out.number(at - one.base, 16) << "\n";
    return;
  }
  out << "  ?\n";
}

void write_report(int signal) {
  const auto now = static_cast<std::uint64_t>(::time(nullptr));
  const int file = open_report(now);
  if (file < 0) return;
  Out out(file);
  out << "Ostia workstation ended by itself\nversion: " << kept.version
      << "\nsignal: " << name_of_signal(signal) << "\ntime: ";
  out.number(now) << " s since 1970 (UTC)\nlast commands, the newest last:\n";
  const unsigned given = kept.given.load();
  const unsigned first = given > most_commands ? given - static_cast<unsigned>(most_commands) : 0;
  for (unsigned i = first; i < given; ++i) out << "  " << kept.commands[i % most_commands] << "\n";
  out << "call stack, the newest first:\n";
  void* frames[most_frames];
  const int count = ::backtrace(frames, most_frames);
  for (int i = 0; i < count; ++i) write_frame(out, reinterpret_cast<std::uintptr_t>(frames[i]));
  ::close(file);
}

extern "C" void crashed(int signal) {
  std::signal(signal, SIG_DFL);
  if (!written.test_and_set()) {
    ::alarm(longest_writing_s);
    write_report(signal);
    ::alarm(0);
  }
  ::raise(signal);  // as it would have ended
}

void copy_to(char* to, std::size_t size, const std::string& text) {
  const std::size_t length = std::min(size - 1, text.size());
  std::memcpy(to, text.data(), length);
  to[length] = 0;
}

int add_module(dl_phdr_info* info, std::size_t, void* count) {
  auto& at = *static_cast<std::size_t*>(count);
  if (at == most_modules) return 1;
  Module& one = kept.modules[at];
  one = {UINTPTR_MAX, 0, static_cast<std::uintptr_t>(info->dlpi_addr), {}};
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type != PT_LOAD) continue;
    one.from = std::min(one.from, static_cast<std::uintptr_t>(info->dlpi_addr + part.p_vaddr));
    one.to = std::max(one.to, static_cast<std::uintptr_t>(info->dlpi_addr + part.p_vaddr + part.p_memsz));
  }
  // The folder may be a person's own. The program itself has no name here.
  const char* name = info->dlpi_name && *info->dlpi_name ? info->dlpi_name : "ostia-workstation";
  if (const char* slash = std::strrchr(name, '/')) name = slash + 1;
  copy_to(one.name, name_bytes, name);
  ++at;
  return 0;
}

}  // namespace

void know_modules() {
  std::size_t count = 0;
  kept.module_count.store(0, std::memory_order_release);
  ::dl_iterate_phdr(add_module, &count);
  kept.module_count.store(count, std::memory_order_release);
}

void note_command(const std::string& id) {
  const unsigned at = kept.given.load();
  copy_to(kept.commands[at % most_commands], command_bytes, id);
  kept.given.store(at + 1);
}

CrashWatch::CrashWatch(const std::filesystem::path& folder) {
  if (watching.exchange(true)) throw std::logic_error("crashes are being watched already");
  copy_to(kept.folder, sizeof kept.folder, std::filesystem::absolute(folder).string());
  copy_to(kept.version, sizeof kept.version, core::version());
  void* once[1];
  ::backtrace(once, 1);  // loads what it needs, which a handler may not
  know_modules();
  stack_t own{};
  own.ss_sp = kept.stack;
  own.ss_size = stack_bytes;
  ::sigaltstack(&own, nullptr);
  struct sigaction action {};
  action.sa_handler = crashed;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  for (const int signal : crashes) ::sigaction(signal, &action, nullptr);
}

CrashWatch::~CrashWatch() {
  for (const int signal : crashes) std::signal(signal, SIG_DFL);
  stack_t none{};
  none.ss_flags = SS_DISABLE;
  ::sigaltstack(&none, nullptr);
  watching = false;
}

std::filesystem::path crash_folder(const std::filesystem::path& state_folder) {
  return state_folder / "crashes";
}

std::vector<std::filesystem::path> crash_reports(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("crash-", 0) == 0 && entry.path().extension() == ".txt" && entry.is_regular_file(ignored))
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace ostia::workstation
