#include "dicom_source.h"

#include "ostia/core/error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace ostia::imaging {
namespace {

constexpr std::size_t kWindow = 64 * 1024;

/// Reads until `count` bytes are there; false at the end of the file or on an error.
bool read_fully(int descriptor, std::uint64_t offset, char* to, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::pread(descriptor, to, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    offset += static_cast<std::uint64_t>(got);
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

DicomSource DicomSource::file(const std::filesystem::path& path) {
  DicomSource source;
  // O_NONBLOCK: opening a pipe must not wait for its writer.
  source.descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (source.descriptor_ < 0) {
    throw IoError("cannot open '" + path.string() + "': " + std::strerror(errno));
  }
  struct stat status {};
  if (::fstat(source.descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    throw IoError("'" + path.string() + "' is not a regular file");
  }
  source.size_ = static_cast<std::uint64_t>(status.st_size);
  return source;
}

DicomSource DicomSource::memory(std::string bytes) {
  DicomSource source;
  source.memory_ = std::move(bytes);
  source.size_ = source.memory_.size();
  return source;
}

DicomSource::~DicomSource() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

DicomSource::DicomSource(DicomSource&& other) noexcept {
  *this = std::move(other);
}

DicomSource& DicomSource::operator=(DicomSource&& other) noexcept {
  if (this == &other) return *this;
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  size_ = std::exchange(other.size_, 0);
  memory_ = std::move(other.memory_);
  window_start_ = other.window_start_;
  window_ = std::move(other.window_);
  return *this;
}

bool DicomSource::fill(std::uint64_t offset) {
  const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(kWindow, size_ - offset));
  window_.resize(count);
  window_start_ = offset;
  if (read_fully(descriptor_, offset, window_.data(), count)) return true;
  window_.clear();
  return false;
}

bool DicomSource::read(std::uint64_t offset, void* to, std::size_t count) {
  if (offset > size_ || count > size_ - offset) return false;
  if (count == 0) return true;
  if (descriptor_ < 0) {
    std::memcpy(to, memory_.data() + offset, count);
    return true;
  }
  if (count > kWindow / 4) return read_fully(descriptor_, offset, static_cast<char*>(to), count);
  const bool inside = offset >= window_start_ && offset + count <= window_start_ + window_.size();
  if (!inside && !fill(offset)) return false;
  if (offset + count > window_start_ + window_.size()) return false;
  std::memcpy(to, window_.data() + (offset - window_start_), count);
  return true;
}

std::string DicomSource::bytes(std::uint64_t offset, std::size_t count) {
  if (offset > size_ || count > size_ - offset) return {};
  std::string result(count, '\0');
  if (!read(offset, result.data(), count)) return {};
  return result;
}

std::string inflated(DicomSource& source, std::uint64_t offset, std::uint64_t max_bytes) {
  struct Stream {
    z_stream z{};
    ~Stream() { inflateEnd(&z); }
  } stream;
  if (inflateInit2(&stream.z, -MAX_WBITS) != Z_OK)
    throw ResourceError("no memory to inflate a DICOM data set");
  std::string result;
  std::array<char, 64 * 1024> out;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    const std::size_t left =
        static_cast<std::size_t>(std::min<std::uint64_t>(source.size() - offset, 16 * 1024));
    std::string in = source.bytes(offset, left);
    if (in.empty()) throw InvalidInput("the deflated data set is cut short");
    offset += in.size();
    stream.z.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.z.avail_in = static_cast<uInt>(in.size());
    do {
      stream.z.next_out = reinterpret_cast<Bytef*>(out.data());
      stream.z.avail_out = static_cast<uInt>(out.size());
      state = inflate(&stream.z, Z_NO_FLUSH);
      if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR) {
        throw InvalidInput("the deflated data set is damaged");
      }
      result.append(out.data(), out.size() - stream.z.avail_out);
      if (result.size() > max_bytes) {
        throw InvalidInput("the deflated data set is larger than " + std::to_string(max_bytes >> 20) +
                           " MiB");
      }
    } while (stream.z.avail_out == 0 && state != Z_STREAM_END);
  }
  return result;
}

}  // namespace ostia::imaging
