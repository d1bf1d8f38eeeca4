// The cell of a process that reads a stranger's bytes: a child tries what one that was taken over would try.

#include "ostia/core/process_cell.h"

#include "shared_data.h"

#include "ostia/core/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/io_uring.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

namespace ostia::core {
namespace {

namespace fs = std::filesystem;

struct ProcessCell : ::testing::Test {
  fs::path folder = testing::temporary_folder("cell");
  fs::path given = folder / "given", secret = folder / "secret", out = folder / "out";

  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer looks for leaks with calls that the cell refuses";
#endif
    if (!possible_cell().whole()) GTEST_SKIP() << "this kernel has no seccomp or no Landlock";
    fs::create_directory(out);
    write_file(given, "a patient's image");
    write_file(secret, "another one's");
  }

  /// How a child in the cell ends that does this: what `attempt` gives, or -(the signal).
  int in_cell(const std::function<int()>& attempt) const {
    const pid_t child = ::fork();
    if (child == 0) {
      const CellWalls walls = enter_cell({{given}, {out}});
      ::_exit(walls.whole() ? attempt() : 200);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  }
  /// 0 where the call fails with this error.
  static int refused(long result, int error = EPERM) {
    return result == -1 && errno == error ? 0 : result == -1 ? 100 + errno % 90 : 1;
  }
};

TEST_F(ProcessCell, ReadsWhatItWasGivenAndWritesWhereItMay) {
  EXPECT_EQ(in_cell([&] {
              if (read_file(given) != "a patient's image") return 1;
              write_file(out / "made", "first, and longer");
              write_file(out / "made", "second");
              return read_file(out / "made") == "second" ? 0 : 2;
            }),
            0);
  EXPECT_EQ(read_file(out / "made"), "second");
}

TEST_F(ProcessCell, ComputesInThreadsOfItsOwn) {
  EXPECT_EQ(in_cell([] {
              std::atomic<int> sum = 0;
              std::thread a([&] { sum += 3; }), b([&] { sum += 4; });
              a.join(), b.join();
              return sum == 7 ? 0 : 1;
            }),
            0);
  EXPECT_EQ(in_cell([]() -> int { std::abort(); }), -SIGABRT) << "a crash is still told";
}

TEST_F(ProcessCell, ReachesNoOtherFile) {
  for (const fs::path& file : {secret, fs::path("/etc/passwd"), fs::path("/proc/self/environ"), folder})
    EXPECT_EQ(in_cell([&] { return refused(::open(file.c_str(), O_RDONLY), EACCES); }), 0) << file;
  EXPECT_EQ(in_cell([&] { return refused(::open(given.c_str(), O_WRONLY), EACCES); }), 0);
  EXPECT_EQ(
      in_cell([&] { return refused(::open((folder / "new").c_str(), O_CREAT | O_WRONLY, 0600), EACCES); }),
      0);
  EXPECT_EQ(in_cell([&] { return refused(::open((out / "../secret").c_str(), O_RDONLY), EACCES); }), 0);
  EXPECT_EQ(in_cell([&] { return refused(::unlink(given.c_str()), EACCES); }), 0);
  EXPECT_EQ(in_cell([&] { return refused(::symlink(secret.c_str(), (out / "way").c_str())); }), 0);
  EXPECT_EQ(in_cell([&] { return refused(::link(given.c_str(), (out / "way").c_str())); }), 0);
  EXPECT_EQ(in_cell([&] { return refused(::truncate(given.c_str(), 0)); }), 0);
  EXPECT_EQ(in_cell([&] { return refused(::chmod(secret.c_str(), 0777)); }), 0);
  // A way that was laid before leads nowhere.
  fs::create_symlink(secret, out / "laid");
  EXPECT_EQ(in_cell([&] { return refused(::open((out / "laid").c_str(), O_RDONLY), EACCES); }), 0);
  EXPECT_EQ(read_file(given), "a patient's image");
}

TEST_F(ProcessCell, ReachesNoNetwork) {
  for (const int family : {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK})
    EXPECT_EQ(in_cell([&] { return refused(::socket(family, SOCK_STREAM, 0)); }), 0) << family;
  EXPECT_EQ(in_cell([] {
              int ends[2];
              return refused(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends));
            }),
            0);
  // What goes past a list of refused calls.
  EXPECT_EQ(in_cell([] {
              io_uring_params parameters{};
              return refused(::syscall(SYS_io_uring_setup, 8, &parameters));
            }),
            0);
}

TEST_F(ProcessCell, StartsNoProgramAndNoProcess) {
  EXPECT_EQ(in_cell([] {
              char* const words[] = {const_cast<char*>("sh"), const_cast<char*>("-c"),
                                     const_cast<char*>("exit 7"), nullptr};
              return refused(::execve("/bin/sh", words, nullptr));
            }),
            0);
  EXPECT_EQ(in_cell([] { return refused(::fork()); }), 0);
  EXPECT_EQ(in_cell([] { return refused(::syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, 0)); }), 0);
  EXPECT_EQ(in_cell([] { return refused(::syscall(SYS_memfd_create, "program", 0)); }), 0);
}

TEST_F(ProcessCell, TouchesNoOtherProcessAndNotTheSystem) {
  EXPECT_EQ(in_cell([] { return refused(::kill(::getppid(), 0)); }), 0);
  EXPECT_EQ(in_cell([] { return refused(::syscall(SYS_tgkill, ::getppid(), ::getppid(), 0)); }), 0);
  EXPECT_EQ(in_cell([] { return refused(::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr)); }), 0);
  EXPECT_EQ(in_cell([] { return refused(::unshare(CLONE_NEWUSER)); }), 0);
  EXPECT_EQ(in_cell([] { return refused(::mount("none", "/tmp", "tmpfs", 0, nullptr)); }), 0);
  EXPECT_EQ(in_cell([] {
              const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
              return refused(::setrlimit(RLIMIT_AS, &more));
            }),
            0);
}

#if defined(__x86_64__)
TEST_F(ProcessCell, OtherTablesOfCallsEndTheProcess) {
  EXPECT_EQ(in_cell([] { return static_cast<int>(::syscall(0x40000000 | SYS_getpid) > 0); }), -SIGSYS);
  // getpid of the table of 32-bit programs.
  EXPECT_EQ(in_cell([] {
              long result = 20;
              asm volatile("int $0x80" : "+a"(result) : : "memory");
              return 1;
            }),
            -SIGSYS);
}
#endif

}  // namespace
}  // namespace ostia::core
