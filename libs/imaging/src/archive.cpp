#include "ostia/imaging/archive.h"

#include "ostia/core/error.h"
#include "ostia/core/utf8.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kBlock = 1 << 20;
constexpr std::uint64_t kFreeOfRatio = 64ULL << 20;
constexpr std::size_t kLongestName = 4096;

struct ZipCloser {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct MemberCloser {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Zip = std::unique_ptr<zip_t, ZipCloser>;
using MemberFile = std::unique_ptr<zip_file_t, MemberCloser>;

/// A file to be unpacked.
struct Member {
  zip_uint64_t index = 0;
  std::uint64_t size = 0;
};

std::string named(const fs::path& zip) {
  return "the zip archive '" + zip.filename().string() + "'";
}

std::string numbered(zip_uint64_t index) {
  return "member " + std::to_string(index + 1);
}

std::string mib(std::uint64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

Zip opened(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) throw IoError(named(path) + " is not there or is no regular file");
  int code = 0;
  Zip archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (archive) return archive;
  zip_error_t why;
  zip_error_init_with_code(&why, code);
  const std::string text = zip_error_strerror(&why);
  zip_error_fini(&why);
  if (code == ZIP_ER_OPEN || code == ZIP_ER_READ) throw IoError(named(path) + " cannot be read: " + text);
  if (code == ZIP_ER_MEMORY) throw ResourceError(named(path) + ": no memory to read its directory");
  throw InvalidInput(named(path) + " is damaged or cut short: " + text + "; get it anew from its source");
}

/// What is wrong with a member's name, without the name; nothing if sound.
std::string name_fault(std::string_view name, bool marked_utf8) {
  if (name.empty()) return "has no name";
  if (name.size() > kLongestName) return "has a name of " + std::to_string(name.size()) + " bytes";
  if (name.front() == '/') return "has an absolute name";
  if (name.size() > 1 && name[1] == ':') return "names a drive";
  for (const char c : name) {
    if (c == '\\') return "has a backslash in its name";
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) return "has a control character in its name";
  }
  if (marked_utf8 && !core::is_utf8(name)) return "has a name that is not UTF-8";
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find('/', at), name.size());
    if (name.substr(at, end - at) == "..") return "leads out of the archive ('..')";
    at = end + 1;
  }
  return {};
}

/// Links, devices, pipes and sockets, where a Unix wrote the archive.
bool is_special(zip_t* archive, zip_uint64_t index) {
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  if (zip_file_get_external_attributes(archive, index, 0, &system, &attributes) != 0) return false;
  if (system != ZIP_OPSYS_UNIX && system != ZIP_OPSYS_OS_X) return false;
  const mode_t kind = static_cast<mode_t>(attributes >> 16) & S_IFMT;
  return kind != 0 && kind != S_IFREG && kind != S_IFDIR;
}

bool too_dense(std::uint64_t size, std::uint64_t packed, double ratio) {
  if (size <= kFreeOfRatio) return false;
  return static_cast<double>(size - kFreeOfRatio) > ratio * static_cast<double>(packed);
}

/// The member, if it is a file; checked. Nothing is unpacked.
bool checked_member(zip_t* archive, zip_uint64_t index, const ArchiveLimits& limits, const std::string& where,
                    Member& member, std::uint64_t& packed) {
  const auto refuse = [&](const std::string& why) -> InvalidInput {
    return InvalidInput(where + " was not opened: " + numbered(index) + " " + why);
  };
  zip_stat_t stat;
  const char* raw = zip_get_name(archive, index, ZIP_FL_ENC_RAW);
  if (raw == nullptr || zip_stat_index(archive, index, 0, &stat) != 0) throw refuse("cannot be read");
  // The name as it stands, and as decoded from the old code page: both must be harmless.
  const std::string fault = name_fault(raw, false);
  if (!fault.empty()) throw refuse(fault);
  const char* decoded = zip_get_name(archive, index, ZIP_FL_ENC_GUESS);
  if (decoded == nullptr) throw refuse("has a name that cannot be read");
  const std::string decoded_fault = name_fault(decoded, true);
  if (!decoded_fault.empty()) throw refuse(decoded_fault);
  if (is_special(archive, index)) throw refuse("is a link or a device");
  const bool known = (stat.valid & ZIP_STAT_SIZE) != 0 && (stat.valid & ZIP_STAT_COMP_SIZE) != 0;
  if (!known) throw refuse("does not say how large it is");
  if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE)
    throw refuse("is encrypted; unpack it with its password and open the folder");
  const std::string_view name = raw;
  if (name.back() == '/') {
    if (stat.size != 0) throw refuse("is a folder with content");
    return false;
  }
  if ((stat.valid & ZIP_STAT_COMP_METHOD) != 0 && zip_compression_method_supported(stat.comp_method, 0) == 0)
    throw refuse("is packed by method " + std::to_string(stat.comp_method) + ", which is not known here");
  if (stat.size > limits.member_bytes) {
    throw refuse("has " + mib(stat.size) + " unpacked; at most " + mib(limits.member_bytes) + " are allowed");
  }
  if (too_dense(stat.size, stat.comp_size, limits.ratio))
    throw refuse("unpacks to " + mib(stat.size) + " from " + std::to_string(stat.comp_size >> 10) +
                 " KiB, more than any image does");
  member = {index, stat.size};
  packed += stat.comp_size;
  return true;
}

std::vector<Member> checked_members(zip_t* archive, const fs::path& zip, const ArchiveLimits& limits) {
  const std::string where = named(zip);
  const zip_int64_t count = zip_get_num_entries(archive, 0);
  if (count < 0) throw InvalidInput(where + " cannot be read");
  if (static_cast<std::uint64_t>(count) > limits.members) {
    throw InvalidInput(where + " holds " + std::to_string(count) + " members; at most " +
                       std::to_string(limits.members) + " are allowed");
  }
  std::vector<Member> members;
  std::uint64_t total = 0, packed = 0;
  for (zip_uint64_t index = 0; index < static_cast<zip_uint64_t>(count); ++index) {
    Member member;
    if (!checked_member(archive, index, limits, where, member, packed)) continue;
    if (member.size > limits.total_bytes - total) {
      throw InvalidInput(where + " unpacks to more than " + mib(limits.total_bytes) +
                         "; unpack it yourself and open the folder");
    }
    total += member.size;
    members.push_back(member);
  }
  // Members may share their packed bytes: what counts is the file.
  std::error_code error;
  const std::uint64_t file = fs::file_size(zip, error);
  if (!error && too_dense(total, std::min<std::uint64_t>(packed, file), limits.ratio)) {
    throw InvalidInput(where + " unpacks to " + mib(total) + " from " + std::to_string(file >> 10) +
                       " KiB, more than images do");
  }
  return members;
}

/// A new file for its owner alone.
class Output {
 public:
  explicit Output(const fs::path& path)
      : descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600)) {
    if (descriptor_ < 0) fail("make a file");
  }
  ~Output() { ::close(descriptor_); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void write(const char* from, std::size_t count) {
    while (count > 0) {
      const ssize_t done = ::write(descriptor_, from, count);
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) fail("write");
      from += done;
      count -= static_cast<std::size_t>(done);
    }
  }

 private:
  [[noreturn]] static void fail(const char* what) {
    const int why = errno;
    const std::string text =
        std::string("cannot ") + what + " in the temporary folder while unpacking: " + std::strerror(why);
    if (why == ENOSPC || why == EDQUOT || why == EFBIG) {
      throw ResourceError(text + "; make room there or set TMPDIR to another disk");
    }
    throw IoError(text);
  }
  int descriptor_;
};

/// What libzip says when a member cannot be read, without any name.
InvalidInput damaged(const std::string& where, const Member& member, const char* why) {
  return InvalidInput(where + ": " + numbered(member.index) + " is damaged: " + why +
                      "; get the archive anew from its source");
}

void unpack(zip_t* archive, const Member& member, const fs::path& to, const std::string& where,
            std::vector<char>& block, const std::function<void(std::size_t)>& advanced) {
  const MemberFile file(zip_fopen_index(archive, member.index, 0));
  if (!file) throw damaged(where, member, zip_error_strerror(zip_get_error(archive)));
  Output out(to);
  std::uint64_t done = 0;
  while (true) {
    const zip_int64_t got = zip_fread(file.get(), block.data(), block.size());
    if (got < 0) throw damaged(where, member, zip_error_strerror(zip_file_get_error(file.get())));
    if (got == 0) break;
    done += static_cast<std::uint64_t>(got);
    if (done > member.size) throw damaged(where, member, "it holds more than it declares");
    out.write(block.data(), static_cast<std::size_t>(got));
    advanced(static_cast<std::size_t>(got));
  }
  if (done != member.size) throw damaged(where, member, "it holds less than it declares");
}

void require_room(const fs::path& folder, std::uint64_t total) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error || total <= space.available) return;
  throw ResourceError("unpacking needs " + mib(total) + " in the temporary folder, where " +
                      mib(space.available) + " are free; make room there or set TMPDIR to another disk");
}

}  // namespace

void validate(const ArchiveLimits& limits) {
  if (limits.total_bytes < 1 || limits.member_bytes < 1 || limits.members < 1)
    throw InvalidInput("archive limits: total_bytes, member_bytes and members must be at least 1");
  if (!(limits.ratio >= 1.0 && std::isfinite(limits.ratio)))
    throw InvalidInput("archive limits: ratio is " + std::to_string(limits.ratio) +
                       "; it must be at least 1");
}

bool is_zip_archive(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream in(path, std::ios::binary);
  std::array<char, 4> magic{};
  if (!in.read(magic.data(), magic.size())) return false;
  const std::string_view text(magic.data(), magic.size());
  return text == "PK\x03\x04" || text == "PK\x05\x06";
}

UnpackedArchive unpack_archive(const fs::path& zip, const ArchiveLimits& limits,
                               const core::TaskContext& task) {
  validate(limits);
  task.set_stage("unpacking");
  task.throw_if_cancelled();
  const Zip archive = opened(zip);
  const std::vector<Member> members = checked_members(archive.get(), zip, limits);
  UnpackedArchive result;
  std::uint64_t total = 0;
  for (const Member& member : members) total += member.size;
  require_room(result.folder(), total);
  const std::string where = named(zip);
  std::vector<char> block(kBlock);
  const auto advanced = [&](std::size_t count) {
    result.bytes_ += count;
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(result.bytes_) /
                      static_cast<double>(std::max<std::uint64_t>(1, total)));
  };
  for (const Member& member : members) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%06zu", result.files_ + 1);
    task.throw_if_cancelled();
    unpack(archive.get(), member, result.folder() / name.data(), where, block, advanced);
    ++result.files_;
  }
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::imaging
