#include "ostia/core/process_cell.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

namespace ostia::core {
namespace {

namespace fs = std::filesystem;

#if defined(__x86_64__)
constexpr std::uint32_t native_calls = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t native_calls = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t native_calls = 0;  // no filter of calls
#endif

// Of kernels that are newer than Debian 12's headers; one that does not know them is not asked for them.
constexpr std::uint64_t truncate_right = 1ULL << 14, device_right = 1ULL << 15;
constexpr std::uint64_t bind_tcp = 1ULL << 0, connect_tcp = 1ULL << 1;
constexpr std::uint64_t abstract_sockets = 1ULL << 0, signals = 1ULL << 1;
struct Ruleset {
  std::uint64_t files = 0, network = 0, scoped = 0;
};

constexpr std::uint64_t read_file = LANDLOCK_ACCESS_FS_READ_FILE;
constexpr std::uint64_t read_below = read_file | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t first_rights =
    LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | read_below | LANDLOCK_ACCESS_FS_REMOVE_DIR |
    LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR |
    LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
    LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
constexpr std::uint64_t write_below = LANDLOCK_ACCESS_FS_WRITE_FILE | read_below |
                                      LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG |
                                      truncate_right;

/// What a library may look up of the system while it runs.
constexpr const char* system_reads[] = {
    "/usr",         "/lib",          "/lib64",        "/etc/ld.so.cache",        "/dev/null",
    "/dev/urandom", "/proc/cpuinfo", "/proc/meminfo", "/sys/devices/system/cpu", "/sys/devices/system/node"};

int landlock_version() {
  return static_cast<int>(
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
}

std::uint64_t known_rights(int version) {
  std::uint64_t rights = first_rights;
  if (version >= 2) rights |= LANDLOCK_ACCESS_FS_REFER;
  if (version >= 3) rights |= truncate_right;
  if (version >= 5) rights |= device_right;
  return rights;
}

/// A file that is not there needs no rule.
void allow(int ruleset, const fs::path& path, std::uint64_t rights) {
  const int at = ::open(path.c_str(), O_PATH | O_CLOEXEC);
  if (at < 0) return;
  struct stat what {};
  if (::fstat(at, &what) == 0) {
    if (!S_ISDIR(what.st_mode)) rights &= read_file | LANDLOCK_ACCESS_FS_WRITE_FILE | truncate_right;
    landlock_path_beneath_attr rule{};
    rule.allowed_access = rights;
    rule.parent_fd = at;
    ::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  }
  ::close(at);
}

bool wall_off_files(const CellRules& rules) {
  const int version = landlock_version();
  if (version < 1) return false;
  const std::uint64_t known = known_rights(version);
  Ruleset wanted;
  wanted.files = known;
  std::size_t size = sizeof wanted.files;
  if (version >= 4) wanted.network = bind_tcp | connect_tcp, size = 2 * sizeof wanted.files;
  if (version >= 6) wanted.scoped = abstract_sockets | signals, size = sizeof wanted;
  const int ruleset = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &wanted, size, 0));
  if (ruleset < 0) return false;
  for (const char* path : system_reads) allow(ruleset, path, read_below & known);
  for (const fs::path& path : rules.reads) allow(ruleset, path, read_below & known);
  for (const fs::path& path : rules.writes) allow(ruleset, path, write_below & known);
  const bool done = ::syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
  ::close(ruleset);
  return done;
}

// What computing, reading and writing of files, and threads need. What is missing on an architecture has no
// number there.
constexpr long plain_calls[] = {
    SYS_read,
    SYS_write,
    SYS_readv,
    SYS_writev,
    SYS_pread64,
    SYS_pwrite64,
    SYS_preadv,
    SYS_pwritev,
    SYS_lseek,
    SYS_openat,
    SYS_close,
    SYS_fstat,
    SYS_statx,
    SYS_statfs,
    SYS_fstatfs,
    SYS_faccessat,
    SYS_faccessat2,
    SYS_readlinkat,
    SYS_getdents64,
    SYS_getcwd,
    SYS_ftruncate,
    SYS_fallocate,
    SYS_fadvise64,
    SYS_fsync,
    SYS_fdatasync,
    SYS_unlinkat,
    SYS_renameat2,
    SYS_fcntl,
    SYS_flock,
    SYS_dup,
    SYS_dup3,
    SYS_pipe2,
    SYS_eventfd2,
    SYS_ppoll,
    SYS_mmap,
    SYS_munmap,
    SYS_mprotect,
    SYS_mremap,
    SYS_madvise,
    SYS_msync,
    SYS_mincore,
    SYS_brk,
    SYS_get_mempolicy,
    SYS_membarrier,
    SYS_futex,
    SYS_set_robust_list,
    SYS_get_robust_list,
    SYS_rseq,
    SYS_set_tid_address,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_sched_getparam,
    SYS_sched_getscheduler,
    SYS_sched_get_priority_max,
    SYS_sched_get_priority_min,
    SYS_getpriority,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sigaltstack,
    SYS_restart_syscall,
    SYS_exit,
    SYS_exit_group,
    SYS_getpid,
    SYS_getppid,
    SYS_gettid,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_getrusage,
    SYS_times,
    SYS_uname,
    SYS_sysinfo,
    SYS_getrandom,
    SYS_getcpu,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_clock_nanosleep,
    SYS_nanosleep,
    SYS_gettimeofday,
#if defined(__x86_64__)
    SYS_open,
    SYS_stat,
    SYS_lstat,
    SYS_newfstatat,
    SYS_access,
    SYS_readlink,
    SYS_unlink,
    SYS_rename,
    SYS_dup2,
    SYS_pipe,
    SYS_poll,
    SYS_getrlimit,
    SYS_time,
    SYS_arch_prctl,
    SYS_renameat,
#endif
};

class CallFilter {
 public:
  CallFilter() {
    load(offsetof(seccomp_data, arch));
    unless(native_calls, SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
#if defined(__x86_64__)
    // The x32 table of calls stands beside the own one, above this bit.
    rules_.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1));
    give(SECCOMP_RET_KILL_PROCESS);
#endif
    for (const long call : plain_calls) when(call, SECCOMP_RET_ALLOW);
    // Its arguments lie behind a pointer that no filter can read; the C library takes clone instead.
    when(SYS_clone3, SECCOMP_RET_ERRNO | ENOSYS);
    // A thread, no process.
    argument_has(SYS_clone, 0, CLONE_THREAD);
    argument_is(SYS_prctl, 0, {PR_SET_NAME});
    argument_is(SYS_ioctl, 1, {TCGETS, FIONREAD});
    argument_is(SYS_tgkill, 0, {static_cast<std::uint32_t>(::getpid())});  // abort()
    argument_is(SYS_prlimit64, 2, {0});                                    // asks alone; high half below
    give(SECCOMP_RET_ERRNO | EPERM);
  }
  bool install() {
    const sock_fprog program{static_cast<unsigned short>(rules_.size()), rules_.data()};
    return native_calls != 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }

 private:
  static std::uint32_t argument(int index) {  // its low half: all machines that are known here begin with it
    return static_cast<std::uint32_t>(offsetof(seccomp_data, args) +
                                      sizeof(std::uint64_t) * static_cast<std::size_t>(index));
  }
  void load(std::size_t from) {
    rules_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(from)));
  }
  void give(std::uint32_t answer) {
    rules_.push_back(BPF_STMT(BPF_RET | BPF_K, answer));
  }
  void unless(std::uint32_t value, std::uint32_t answer) {
    rules_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 1, 0));
    give(answer);
  }
  void when(long call, std::uint32_t answer) {
    rules_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    give(answer);
  }
  /// Allowed where the argument is one of the values, whose high half is 0; then nothing is asked further.
  void argument_is(long call, int index, std::vector<std::uint32_t> values) {
    const auto rest = static_cast<std::uint8_t>(2 * values.size() + 4);
    rules_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, rest));
    load(argument(index) + sizeof(std::uint32_t));
    unless(0, SECCOMP_RET_ERRNO | EPERM);
    load(argument(index));
    for (const std::uint32_t value : values) when(static_cast<long>(value), SECCOMP_RET_ALLOW);
    load(offsetof(seccomp_data, nr));
    // One call alone comes to here, and no other rule is about it.
  }
  void argument_has(long call, int index, std::uint32_t bits) {
    rules_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 4));
    load(argument(index));
    rules_.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, 1));
    give(SECCOMP_RET_ALLOW);
    load(offsetof(seccomp_data, nr));
  }

  std::vector<sock_filter> rules_;
};

bool has_call_filter() {
  const std::uint32_t answer = SECCOMP_RET_KILL_PROCESS;
  return native_calls != 0 && ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &answer) == 0;
}

}  // namespace

CellWalls possible_cell() {
  return {has_call_filter(), landlock_version() >= 1};
}

CellWalls enter_cell(const CellRules& rules) {
  CellWalls walls;
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return walls;
  walls.files = wall_off_files(rules);
  walls.calls = CallFilter().install();
  return walls;
}

}  // namespace ostia::core
