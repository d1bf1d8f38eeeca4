#include "ostia/session/open_mark.h"

#include "ostia/core/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void raise(const fs::path& path) {
  throw IoError("cannot write " + path.string() + ": " + std::generic_category().message(errno));
}

/// An open file, closed and so unlocked at the end.
class Opened {
 public:
  Opened(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~Opened() {
    if (fd_ >= 0) ::close(fd_);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  bool good() const { return fd_ >= 0; }
  bool lock(int how) const { return good() && ::flock(fd_, how) == 0; }
  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

std::string text_of(int fd) {
  std::string text;
  std::array<char, 4096> block{};
  for (ssize_t got = 0; (got = ::read(fd, block.data(), block.size())) > 0;)
    text.append(block.data(), static_cast<std::size_t>(got));
  return text;
}

/// Held for moments only: nobody sees a mark that is made and not yet locked.
struct Door {
  Opened file;
  Door(const fs::path& folder, int flags) : file(folder / "lock", O_RDWR | flags) { file.lock(LOCK_EX); }
  bool shut() const { return file.good(); }
};

}  // namespace

OpenMark::OpenMark(const fs::path& state_folder) : folder_(state_folder / "open") {}

OpenMark::~OpenMark() {
  if (held_ >= 0) ::close(held_);
}

void OpenMark::set(const fs::path& case_file) {
  const std::string text = case_file.string();
  if (held_ < 0) {
    std::error_code error;
    fs::create_directories(folder_.parent_path(), error);
    if (::mkdir(folder_.c_str(), 0700) != 0 && errno != EEXIST) raise(folder_);
    const Door door(folder_, O_CREAT);
    if (!door.shut()) raise(folder_);
    for (int number = 1; held_ < 0; ++number) {
      file_ = folder_ / (std::to_string(::getpid()) + "-" + std::to_string(number) + ".mark");
      Opened made(file_, O_RDWR | O_CREAT | O_EXCL);
      if (!made.good() && errno == EEXIST) continue;
      if (!made.lock(LOCK_EX | LOCK_NB)) raise(file_);
      held_ = made.release();
    }
  }
  if (::ftruncate(held_, 0) != 0 ||
      ::pwrite(held_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    raise(file_);
}

void OpenMark::clear() {
  if (held_ < 0) return;
  std::error_code ignored;
  fs::remove(file_, ignored);
  ::close(std::exchange(held_, -1));
}

std::vector<fs::path> OpenMark::take_left() {
  const Door door(folder_, 0);
  if (!door.shut()) return {};
  std::vector<std::pair<fs::file_time_type, fs::path>> left;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    if (entry.path().extension() != ".mark") continue;
    const Opened mark(entry.path(), O_RDWR);
    if (!mark.lock(LOCK_EX | LOCK_NB)) continue;  // its program lives
    const std::string text = text_of(mark.get());
    if (!text.empty()) left.emplace_back(entry.last_write_time(ignored), text);
    fs::remove(entry.path(), ignored);
  }
  std::sort(left.begin(), left.end(), [](const auto& a, const auto& b) { return a > b; });
  std::vector<fs::path> cases;
  for (const auto& [when, path] : left) cases.push_back(path);
  return cases;
}

}  // namespace ostia::session
