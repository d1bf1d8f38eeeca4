#pragma once
/// \file Files for this user alone (0600), replaced whole or not at all.

#include <filesystem>
#include <string>

namespace ostia::session {

/// An IoError with what the system says, a ResourceError where the disk is full.
[[noreturn]] void raise_file_error(const std::string& what, const std::filesystem::path& path, int code);

/// 0700; nothing where it is there.
void make_private_folder(const std::filesystem::path& folder);

/// Held while a file is changed; every program that changes it waits here, at most two seconds. The file
/// itself cannot be locked, since it is replaced: the lock is a file of its name with the ending .lock.
class PrivateLock {
 public:
  explicit PrivateLock(const std::filesystem::path& file);
  ~PrivateLock();
  PrivateLock(const PrivateLock&) = delete;
  PrivateLock& operator=(const PrivateLock&) = delete;

 private:
  int fd_;
};

void write_private(const std::filesystem::path& path, const std::string& text);

}  // namespace ostia::session
