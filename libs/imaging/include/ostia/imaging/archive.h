#pragma once
/// \file Zip archives, unpacked where nobody else can read and nothing else can be overwritten.

#include "ostia/core/private_folder.h"
#include "ostia/core/task_context.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace ostia::imaging {

struct ArchiveLimits {
  std::uint64_t total_bytes = 16ULL << 30;  ///< of all members unpacked, >= 1
  std::uint64_t member_bytes = 4ULL << 30;  ///< of one member, >= 1
  /// Unpacked over packed size, of a member and of the whole, beyond the first 64 MiB; >= 1. Deflate cannot
  /// exceed 1,032; CT images reach 4, an empty mask some hundreds.
  double ratio = 400.0;
  std::size_t members = 200'000;  ///< files and folders, >= 1
};
void validate(const ArchiveLimits& limits);  ///< throws InvalidInput

/// The files of an archive in a private folder that goes with this object. They are numbered in the archive's
/// order (`000001`, ...): no name from inside ever reaches the file system, a log or a message.
class UnpackedArchive {
 public:
  const std::filesystem::path& folder() const { return folder_->path(); }
  std::size_t files() const { return files_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  friend UnpackedArchive unpack_archive(const std::filesystem::path&, const ArchiveLimits&,
                                        const core::TaskContext&);
  UnpackedArchive() : folder_(std::make_unique<core::PrivateFolder>()) {}
  std::unique_ptr<core::PrivateFolder> folder_;
  std::size_t files_ = 0;
  std::uint64_t bytes_ = 0;
};

/// By the first bytes: a local file header, or the end record of an empty archive. False for what cannot be
/// read, and for a folder.
bool is_zip_archive(const std::filesystem::path& path);

/// Everything is checked before the first byte is unpacked: names (absolute, `..`, a drive, backslashes,
/// control characters, not UTF-8, too long), links and devices, encryption, methods that are not known, sizes
/// against the limits and the room on the disk; one bad member refuses the whole. Then members are streamed,
/// none beyond its declared size, and their check sums compared. A zip inside is a file as any other and is
/// not opened. Members are named by number. Throws InvalidInput, IoError, ResourceError (disk full),
/// Cancelled.
UnpackedArchive unpack_archive(const std::filesystem::path& zip, const ArchiveLimits& limits = {},
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::imaging
