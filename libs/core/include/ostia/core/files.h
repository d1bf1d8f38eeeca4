#pragma once
/// \file Files and folders that appear whole or not at all.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::core {

class MadeParents;
class PartNumber;

/// Whole content. Throws IoError naming the file; ResourceError when larger than `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes = 8ULL << 30);

/// A file under construction beside its target, invisible until `commit` has synced and renamed it.
/// Destroyed without commit it leaves nothing behind, and the old target untouched byte for byte. Folders
/// above it that are missing are made.
class StagedFile {
 public:
  /// Throws IoError when the folder cannot be made or cannot be written.
  explicit StagedFile(std::filesystem::path target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Throws ResourceError on a full disk, IoError otherwise.
  void commit();

 private:
  std::unique_ptr<MadeParents> parents_;
  std::unique_ptr<const PartNumber> number_;
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// Writes `content` through a StagedFile.
void write_file(const std::filesystem::path& path, std::string_view content);

/// For names of folders under construction that messages should not show: what the user asked for.
class ShownAs {
 public:
  ShownAs(const std::filesystem::path& hidden, const std::filesystem::path& target);
  ~ShownAs();
  ShownAs(const ShownAs&) = delete;
  ShownAs& operator=(const ShownAs&) = delete;

 private:
  std::string hidden_;
};

/// A folder under construction beside its target, whose missing folders above are made. `commit` renames it;
/// an existing target folder is exchanged and then removed. What dead runs left of the same target is removed
/// when one is made.
class StagedFolder {
 public:
  explicit StagedFolder(std::filesystem::path target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;
  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();

 private:
  std::unique_ptr<MadeParents> parents_;
  std::unique_ptr<const PartNumber> number_;
  std::unique_ptr<const ShownAs> shown_;
  std::filesystem::path target_, temporary_;
  int lock_ = -1;  ///< held on the folder as long as it is under construction
  bool committed_ = false;
};

/// Renames a folder that was made beside `target` to it, synced; an existing target is exchanged and then
/// removed. Throws as `StagedFolder::commit`.
void publish_folder(const std::filesystem::path& made, const std::filesystem::path& target);

/// Removes what dead runs left in `folder` itself: files and folders with the hidden names of StagedFile and
/// StagedFolder whose process is gone. A folder that another process has locked (it may run elsewhere, on the
/// same disk) stays, and so does one that cannot be locked at all. For a folder that no program on another
/// machine writes files into: hold a FolderLock. Returns how many there were; never throws for what cannot be
/// removed.
std::size_t remove_dead_parts(const std::filesystem::path& folder);

/// Lower-case hexadecimal SHA-256. The file variant reads in blocks and throws IoError.
std::string sha256(std::string_view bytes);
std::string sha256_file(const std::filesystem::path& path);

}  // namespace ostia::core
