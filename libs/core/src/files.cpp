#include "ostia/core/files.h"

#include "sha256.h"

#include "ostia/core/error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <system_error>
#include <utility>

namespace ostia::core {
namespace fs = std::filesystem;
namespace {

/// Folders under construction, by their hidden names: messages name what the user asked for.
struct FoldersInWork {
  std::mutex mutex;
  std::map<std::string, std::string> targets;
};

FoldersInWork& folders_in_work() {
  static FoldersInWork instance;
  return instance;
}

std::string shown(const fs::path& path) {
  std::string text = path.string();
  FoldersInWork& folders = folders_in_work();
  const std::lock_guard lock(folders.mutex);
  for (const auto& [hidden, target] : folders.targets) {
    if (text.starts_with(hidden)) text.replace(0, hidden.size(), target);
  }
  return text;
}

[[noreturn]] void throw_errno(const std::string& what, const fs::path& path, int code) {
  const std::string message = what + " " + shown(path) + ": " + std::generic_category().message(code);
  if (code == ENOSPC || code == EDQUOT || code == EFBIG)
    throw ResourceError(message + "; make room and try again");
  throw IoError(message);
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

void sync(const fs::path& path, int flags) {
  const Descriptor file(path, flags);
  if (file.get() < 0 || ::fsync(file.get()) != 0) {
    if (errno == EINVAL) return;  // some file systems cannot sync a folder
    throw_errno("cannot write", path, errno);
  }
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

void require_writable_folder(const fs::path& folder, const fs::path& target) {
  if (!fs::is_directory(folder)) {
    throw IoError("cannot write " + shown(target) + ": the folder " + shown(folder) +
                  " does not exist; create it first");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw IoError("cannot write " + shown(target) + ": no permission to write in " + shown(folder));
  }
}

fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const std::string suffix = ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  // The extension is kept: writers of some libraries choose the format by it. Long names are shortened so
  // that the file system's limit of 255 bytes holds.
  std::string stem = target.filename().string();
  if (stem.size() > 180) stem = stem.substr(stem.size() - 180);
  return folder_of(target) / ("." + suffix.substr(1) + "-" + stem);
}

fs::path without_trailing_slash(fs::path path) {
  if (!path.has_filename() && path.has_parent_path()) path = path.parent_path();
  return path;
}

}  // namespace

std::string read_file(const fs::path& path, std::uint64_t max_bytes) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw IoError("cannot read " + path.string() + ": it is a folder");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw_errno("cannot read", path, errno ? errno : ENOENT);
  std::string content;
  std::array<char, 1 << 16> block{};
  while (in.read(block.data(), block.size()) || in.gcount() > 0) {
    content.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (content.size() > max_bytes) {
      throw ResourceError("cannot read " + path.string() + ": it is larger than " +
                          std::to_string(max_bytes) + " bytes");
    }
  }
  if (in.bad()) throw_errno("cannot read", path, EIO);
  return content;
}

StagedFile::StagedFile(fs::path target) : target_(std::move(target)) {
  if (target_.filename().empty())
    throw IoError("cannot write " + target_.string() + ": it names a folder, not a file");
  if (fs::is_directory(target_))
    throw IoError("cannot write " + target_.string() + ": a folder of that name exists");
  require_writable_folder(folder_of(target_), target_);
  temporary_ = temporary_beside(target_);
}

StagedFile::~StagedFile() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void StagedFile::commit() {
  sync(temporary_, O_RDONLY);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw_errno("cannot write", target_, errno);
  committed_ = true;
  sync(folder_of(target_), O_RDONLY | O_DIRECTORY);
}

void write_file(const fs::path& path, std::string_view content) {
  StagedFile staged(path);
  {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(staged.temporary().c_str(), "wbe"),
                                                        &std::fclose);
    if (!out) throw_errno("cannot write", path, errno);
    const bool whole = std::fwrite(content.data(), 1, content.size(), out.get()) == content.size();
    if (!whole || std::fflush(out.get()) != 0) throw_errno("cannot write", path, errno);
  }
  staged.commit();
}

StagedFolder::StagedFolder(fs::path target) : target_(without_trailing_slash(std::move(target))) {
  if (target_.filename().empty()) throw IoError("cannot write " + target_.string() + ": name a new folder");
  if (fs::exists(target_) && !fs::is_directory(target_)) {
    throw IoError("cannot write " + target_.string() + ": a file of that name exists");
  }
  require_writable_folder(folder_of(target_), target_);
  temporary_ = temporary_beside(target_);
  std::error_code error;
  if (!fs::create_directory(temporary_, error)) throw_errno("cannot write", target_, error.value());
  FoldersInWork& folders = folders_in_work();
  const std::lock_guard lock(folders.mutex);
  folders.targets[temporary_.string()] = target_.string();
}

StagedFolder::~StagedFolder() {
  {
    FoldersInWork& folders = folders_in_work();
    const std::lock_guard lock(folders.mutex);
    folders.targets.erase(temporary_.string());
  }
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void StagedFolder::commit() {
  for (const auto& entry : fs::recursive_directory_iterator(temporary_)) {
    if (entry.is_regular_file()) sync(entry.path(), O_RDONLY);
  }
  sync(temporary_, O_RDONLY | O_DIRECTORY);
  if (fs::exists(target_)) {
    if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0) {
      throw_errno("cannot write", target_, errno);
    }
    committed_ = true;
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
  } else {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw_errno("cannot write", target_, errno);
    committed_ = true;
  }
  sync(folder_of(target_), O_RDONLY | O_DIRECTORY);
}

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.result();
}

std::string sha256_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path)) throw IoError("cannot read " + path.string());
  Sha256 hash;
  std::array<char, 1 << 16> block{};
  while (in.read(block.data(), block.size()) || in.gcount() > 0)
    hash.add(block.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw IoError("cannot read " + path.string());
  return hash.result();
}

}  // namespace ostia::core
