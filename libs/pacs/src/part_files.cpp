#include "part_files.h"

#include "ostia/core/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace ostia::pacs {
namespace {

[[noreturn]] void refuse_write() {
  const std::string why = std::strerror(errno);
  if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)
    throw ResourceError("a received object cannot be written: " + why);
  throw IoError("a received object cannot be written: " + why);
}

}  // namespace

PartFiles::~PartFiles() {
  if (file_ < 0) return;
  ::close(file_);
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void PartFiles::begin_part(std::string_view) {
  part_ = intake_.next_part();
  file_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file_ < 0) refuse_write();
}

void PartFiles::body(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) refuse_write();
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void PartFiles::end_part() {
  const int closed = ::close(file_);
  file_ = -1;
  if (closed != 0) refuse_write();
  intake_.take(part_);
  intake_.throw_if_faulty();
}

}  // namespace ostia::pacs
