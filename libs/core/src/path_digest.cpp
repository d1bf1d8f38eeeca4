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

struct Files {
  std::vector<fs::path> paths;
  std::uint64_t size = 0;
};

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files.paths.push_back(entry.path());
    files.size += entry.file_size();
  }
  if (files.paths.empty()) throw InvalidInput("the folder " + folder.string() + " holds no files");
  return files;
}

std::string digest_of_folder(const fs::path& folder, const TaskContext& task) {
  const Files files = files_in(folder);
  Reading reading(files.size, task);
  std::vector<std::string> digests;
  for (const fs::path& path : files.paths) digests.push_back(digest_of_file(path, reading));
  std::sort(digests.begin(), digests.end());
  std::string all;
  for (const std::string& digest : digests) all += digest;
  return sha256(all);
}

std::string digest_of(const fs::path& path, const TaskContext& task) {
  if (fs::is_directory(path)) return digest_of_folder(path, task);
  if (!fs::exists(path)) throw IoError("cannot read " + path.string() + ": there is no such file or folder");
  if (!fs::is_regular_file(path))
    throw InvalidInput("cannot read " + path.string() + ": it is neither a file nor a folder");
  Reading reading(fs::file_size(path), task);
  return digest_of_file(path, reading);
}

}  // namespace

std::string sha256_of_path(const fs::path& path, const TaskContext& task) {
  try {
    task.throw_if_cancelled();
    const std::string digest = digest_of(path, task);
    task.set_progress(1.0);
    return digest;
  } catch (const fs::filesystem_error& e) {
    throw IoError("cannot read " + path.string() + ": " + e.code().message());
  }
}

}  // namespace ostia::core
