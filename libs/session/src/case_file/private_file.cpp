#include "case_file/private_file.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

constexpr auto longest_wait_for_lock = std::chrono::seconds(2);

int open_private(const fs::path& path, int flags) {
  const int fd = ::open(path.c_str(), flags | O_CLOEXEC, 0600);
  if (fd < 0) raise_file_error("cannot open", path, errno);
  return fd;
}

void lock_or_raise(int fd, const fs::path& file, const fs::path& lock) {
  const auto end = std::chrono::steady_clock::now() + longest_wait_for_lock;
  while (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) raise_file_error("cannot lock", lock, errno);
    if (std::chrono::steady_clock::now() > end)
      throw IoError("cannot change " + file.string() +
                    ": another window or program has been changing it for two seconds");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace

void raise_file_error(const std::string& what, const fs::path& path, int code) {
  const std::string message = what + " " + path.string() + ": " + std::generic_category().message(code);
  if (code == ENOSPC || code == EDQUOT || code == EFBIG) throw ResourceError(message);
  throw IoError(message);
}

void make_private_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), error);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    raise_file_error("cannot make the folder", folder, errno);
}

PrivateLock::PrivateLock(const fs::path& file)
    : fd_(open_private(fs::path(file).replace_extension(".lock"), O_RDWR | O_CREAT)) {
  try {
    lock_or_raise(fd_, file, fs::path(file).replace_extension(".lock"));
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

PrivateLock::~PrivateLock() {
  ::close(fd_);
}

void write_private(const fs::path& path, const std::string& text) {
  core::StagedFile staged(path);
  {
    const int out = open_private(staged.temporary(), O_WRONLY | O_CREAT | O_EXCL);
    const struct Closed {
      int fd;
      ~Closed() { ::close(fd); }
    } closed{out};
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t wrote = ::write(out, text.data() + done, text.size() - done);
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote < 0) raise_file_error("cannot write", path, errno);
      done += static_cast<std::size_t>(wrote);
    }
  }
  staged.commit();
}

}  // namespace ostia::session
