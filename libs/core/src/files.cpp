#include "ostia/core/files.h"

#include "made_parents.h"
#include "part_names.h"
#include "sha256.h"

#include "ostia/core/error.h"
#include "ostia/core/job.h"
#include "ostia/core/write_back.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <future>
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

/// A folder with all regular files and folders below it. Writing begins for all files before the first is
/// waited for, and several wait at a time, so that the file system puts them into few transactions: of
/// hundreds of files one by one each would wait for its own.
void sync_all_of(const fs::path& folder) {
  std::vector<fs::path> files, folders{folder};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
    if (entry.is_directory() && !entry.is_symlink()) folders.push_back(entry.path());
  }
  for (const fs::path& file : files) begin_writing_back(file);
  constexpr std::size_t most_waiting = 8;
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto wait_for_some = [&] {
    try {
      for (std::size_t n = next++; n < files.size(); n = next++) sync(files[n], O_RDONLY);
    } catch (...) {
      next = files.size();
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  };
  std::vector<std::future<void>> others;
  try {
    for (std::size_t n = 1; n < std::min(most_waiting, files.size()); ++n)
      others.push_back(std::async(std::launch::async, wait_for_some));
  } catch (const std::system_error&) {  // no thread to be had: fewer wait
  }
  wait_for_some();
  for (std::future<void>& other : others) other.get();
  if (thrown) std::rethrow_exception(thrown);
  for (const fs::path& one : folders) sync(one, O_RDONLY | O_DIRECTORY);  // the files' names
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// Folders that are not there are made, and go again where nothing is written into them.
std::unique_ptr<MadeParents> made_writable(const fs::path& folder, const fs::path& target) {
  const fs::path there = nearest_there(folder);
  if (!fs::is_directory(there))
    throw IoError("cannot write " + shown(target) + ": " + shown(there) + " is a file and no folder");
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    throw IoError("cannot write " + shown(target) + ": no permission to write in " + shown(there));
  return std::make_unique<MadeParents>(folder);
}

/// A lock that the system takes back when this process ends; -1 where there is none to be had.
int locked(const fs::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0 || ::flock(fd, LOCK_EX | LOCK_NB) == 0) return fd;
  ::close(fd);
  return -1;
}

/// Removes it where its process is gone; for a folder the lock must be free, too.
bool remove_dead(const fs::directory_entry& entry) {
  if (!of_dead_process(entry.path().filename().string())) return false;
  std::error_code error;
  if (!entry.is_directory(error) || entry.is_symlink(error)) return fs::remove(entry.path(), error);
  const int lock = locked(entry.path());
  if (lock < 0) return false;
  fs::remove_all(entry.path(), error);
  ::close(lock);
  return !error;
}

void remove_dead_of(const fs::path& target) {
  const std::string name = shortened(target.filename().string());
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_of(target), ignored))
    if (entry.is_directory(ignored) && target_in(entry.path().filename().string()) == name)
      remove_dead(entry);
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
    throw_if_job_cancelled();
    content.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (content.size() > max_bytes) {
      throw ResourceError("cannot read " + path.string() + ": it is larger than " +
                          std::to_string(max_bytes) + " bytes");
    }
  }
  if (in.bad()) throw_errno("cannot read", path, EIO);
  return content;
}

StagedFile::StagedFile(fs::path target)
    : number_(std::make_unique<PartNumber>()), target_(std::move(target)) {
  if (target_.filename().empty())
    throw IoError("cannot write " + target_.string() + ": it names a folder, not a file");
  if (fs::is_directory(target_))
    throw IoError("cannot write " + target_.string() + ": a folder of that name exists");
  parents_ = made_writable(folder_of(target_), target_);
  temporary_ = folder_of(target_) / number_->name(target_.filename().string());
}

StagedFile::~StagedFile() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void StagedFile::commit() {
  throw_if_job_cancelled();
  sync(temporary_, O_RDONLY);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw_errno("cannot write", target_, errno);
  committed_ = true;
  parents_->keep();
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

ShownAs::ShownAs(const fs::path& hidden, const fs::path& target) : hidden_(hidden.string()) {
  FoldersInWork& folders = folders_in_work();
  const std::lock_guard lock(folders.mutex);
  folders.targets[hidden_] = target.string();
}

ShownAs::~ShownAs() {
  FoldersInWork& folders = folders_in_work();
  const std::lock_guard lock(folders.mutex);
  folders.targets.erase(hidden_);
}

StagedFolder::StagedFolder(fs::path target) : target_(without_trailing_slash(std::move(target))) {
  if (target_.filename().empty()) throw IoError("cannot write " + target_.string() + ": name a new folder");
  if (fs::exists(target_) && !fs::is_directory(target_)) {
    throw IoError("cannot write " + target_.string() + ": a file of that name exists");
  }
  parents_ = made_writable(folder_of(target_), target_);
  remove_dead_of(target_);
  std::error_code error;
  do {  // a name may be taken by what an earlier process of this number left, and could not be removed
    number_ = std::make_unique<PartNumber>();
    temporary_ = folder_of(target_) / number_->name(target_.filename().string());
  } while (!fs::create_directory(temporary_, error) && !error);
  if (error) throw_errno("cannot write", target_, error.value());
  lock_ = locked(temporary_);
  shown_ = std::make_unique<const ShownAs>(temporary_, target_);
}

StagedFolder::~StagedFolder() {
  if (!committed_) {
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
  }
  if (lock_ >= 0) ::close(lock_);
}

void StagedFolder::commit() {
  throw_if_job_cancelled();
  publish_folder(temporary_, target_);
  parents_->keep();
  committed_ = true;
}

void publish_folder(const fs::path& made, const fs::path& target) {
  sync_all_of(made);
  if (fs::exists(target)) {
    if (::renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) != 0) {
      throw_errno("cannot write", target, errno);
    }
    std::error_code ignored;
    fs::remove_all(made, ignored);
  } else if (::rename(made.c_str(), target.c_str()) != 0) {
    throw_errno("cannot write", target, errno);
  }
  sync(folder_of(target), O_RDONLY | O_DIRECTORY);
}

void begin_writing_back(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (file.get() >= 0) ::sync_file_range(file.get(), 0, 0, SYNC_FILE_RANGE_WRITE);
}

std::size_t remove_dead_parts(const fs::path& folder) {
  std::size_t removed = 0;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    removed += remove_dead(*entry) ? 1 : 0;
  return removed;
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
