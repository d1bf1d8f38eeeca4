#include "ostia/core/folder_lock.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <system_error>
#include <thread>

namespace ostia::core {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds between_tries{50};

/// Whether the file that is locked is still the one that has the name: its last holder may have taken it away
/// in between.
bool still_there(int fd, const fs::path& file) {
  struct stat opened {
  }, named{};
  return ::fstat(fd, &opened) == 0 && ::stat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

void say_who(int fd) {
  const std::string text = std::to_string(::getpid()) + "\n";
  // Who it is helps to find the run; the lock holds without it, on a full disk, too.
  if (::ftruncate(fd, 0) == 0 && ::pwrite(fd, text.data(), text.size(), 0) < 0) return;
}

std::string who(const fs::path& file) {
  std::array<char, 16> text{};
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return "";
  const ssize_t got = ::read(fd, text.data(), text.size());
  ::close(fd);
  std::string process(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  process.resize(std::min(process.size(), process.find_first_not_of("0123456789")));
  return process.empty() ? "" : " (process " + process + ")";
}

/// The file, locked; nothing where another process has it.
std::optional<int> try_lock(const fs::path& file, const fs::path& shown) {
  while (true) {
    const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (fd < 0)
      throw IoError("cannot work in " + shown.string() + ": " + std::generic_category().message(errno));
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
      const int code = errno;
      ::close(fd);
      if (code == EWOULDBLOCK) return std::nullopt;
      if (code == EINTR) continue;
      throw IoError("cannot lock " + shown.string() + ": " + std::generic_category().message(code));
    }
    if (still_there(fd, file)) return fd;
    ::close(fd);
  }
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const fs::path& shown, const std::string& way_out,
                       WhenBusy when_busy, const TaskContext& task)
    : file_(folder / ".ostia-lock") {
  bool told = false;
  while (true) {
    if (const std::optional<int> fd = try_lock(file_, shown)) {
      fd_ = *fd;
      say_who(fd_);
      return;
    }
    const std::string busy = "another run" + who(file_) + " is at work there";
    if (when_busy == WhenBusy::refuse)
      throw ResourceError("cannot work in " + shown.string() + ": " + busy + "; " + way_out);
    if (!told) log_info("waiting for " + shown.string() + ": " + busy);
    told = true;
    task.throw_if_cancelled();
    std::this_thread::sleep_for(between_tries);
  }
}

FolderLock::~FolderLock() {
  if (still_there(fd_, file_)) ::unlink(file_.c_str());
  ::close(fd_);
}

}  // namespace ostia::core
