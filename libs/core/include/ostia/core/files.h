#pragma once
/// \file Files and folders that appear whole or not at all.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace ostia::core {

/// Whole content. Throws IoError naming the file; ResourceError when larger than `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = 8ULL << 30);

/// A file under construction beside its target, invisible until `commit` has synced and renamed it.
/// Destroyed without commit it leaves nothing behind, and the old target untouched byte for byte.
class StagedFile {
 public:
  /// Throws IoError when the folder does not exist or cannot be written.
  explicit StagedFile(std::filesystem::path target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Throws ResourceError on a full disk, IoError otherwise.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// Writes `content` through a StagedFile.
void write_file(const std::filesystem::path& path, std::string_view content);

/// A folder under construction beside its target. `commit` renames it; an existing target folder is exchanged
/// and then removed.
class StagedFolder {
 public:
  explicit StagedFolder(std::filesystem::path target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// Lower-case hexadecimal SHA-256. The file variant reads in blocks and throws IoError.
std::string sha256(std::string_view bytes);
std::string sha256_file(const std::filesystem::path& path);

}  // namespace ostia::core
