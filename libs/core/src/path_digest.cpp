#include "ostia/core/path_digest.h"

#include "sha256.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <vector>

namespace ostia::core {
namespace fs = std::filesystem;
namespace {

/// Bytes read of those that there are.
class Reading {
 public:
  Reading(std::uint64_t size, const TaskContext& task) : size_(size), task_(&task) {}
  void add(std::size_t bytes) {
    done_ += bytes;
    task_->throw_if_cancelled();
    task_->set_progress(size_ == 0 ? 1.0 : static_cast<double>(done_) / static_cast<double>(size_));
  }

 private:
  std::uint64_t size_ = 0, done_ = 0;
  const TaskContext* task_;
};

std::string digest_of_file(const fs::path& path, Reading& reading) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw IoError("cannot read " + path.string() + "; check that it may be read");
  Sha256 hash;
  std::vector<char> block(std::size_t{1} << 20);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    hash.add(block.data(), static_cast<std::size_t>(in.gcount()));
    reading.add(static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw IoError("cannot read " + path.string() + " to its end");
  return hash.result();
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  if (files.empty()) throw InvalidInput("the folder " + folder.string() + " holds no files");
  return files;
}

void check_is_file(const fs::path& path) {
  if (!fs::exists(path)) throw IoError("cannot read " + path.string() + ": there is no such file or folder");
  if (!fs::is_regular_file(path))
    throw InvalidInput("cannot read " + path.string() + ": it is neither a file nor a folder");
}

}  // namespace

std::vector<std::string> sha256_of_each(const std::vector<fs::path>& files, const TaskContext& task) {
  task.throw_if_cancelled();
  try {
    std::uint64_t size = 0;
    for (const fs::path& path : files) {
      check_is_file(path);
      size += fs::file_size(path);
    }
    Reading reading(size, task);
    std::vector<std::string> digests;
    for (const fs::path& path : files) digests.push_back(digest_of_file(path, reading));
    task.set_progress(1.0);
    return digests;
  } catch (const fs::filesystem_error& e) {
    throw IoError("cannot read " + e.path1().string() + ": " + e.code().message());
  }
}

std::string sha256_of_digests(std::vector<std::string> digests) {
  if (digests.empty()) throw InvalidInput("there is no file to be known by");
  std::sort(digests.begin(), digests.end());
  std::string all;
  for (const std::string& digest : digests) all += digest;
  return sha256(all);
}

std::string sha256_of_files(const std::vector<fs::path>& files, const TaskContext& task) {
  std::vector<fs::path> once = files;
  std::sort(once.begin(), once.end());
  once.erase(std::unique(once.begin(), once.end()), once.end());
  return sha256_of_digests(sha256_of_each(once, task));
}

std::string sha256_of_path(const fs::path& path, const TaskContext& task) {
  task.throw_if_cancelled();
  try {
    if (fs::is_directory(path)) return sha256_of_files(files_in(path), task);
    return sha256_of_each({path}, task).front();
  } catch (const fs::filesystem_error& e) {
    throw IoError("cannot read " + path.string() + ": " + e.code().message());
  }
}

}  // namespace ostia::core
