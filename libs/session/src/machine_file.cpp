#include "machine_file.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

using MachineJson = nlohmann::json;

constexpr std::uint64_t largest_file = 16U << 20;
constexpr auto longest_wait = std::chrono::seconds(2);

std::string escaped(const std::string& bytes) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > 0x20 && byte < 0x7f && c != '%')
      text += c;
    else
      (text += '%').append({digits[byte >> 4], digits[byte & 15]});
  }
  return text;
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  throw InvalidInput("a path or UID has a wrong escape");
}

std::string unescaped(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      bytes += text[i];
      continue;
    }
    if (i + 2 >= text.size()) throw InvalidInput("a path or UID ends within an escape");
    bytes += static_cast<char>(digit(text[i + 1]) * 16 + digit(text[i + 2]));
    i += 2;
  }
  return bytes;
}

[[noreturn]] void raise(const std::string& what, const fs::path& path, int code) {
  const std::string message = what + " " + path.string() + ": " + std::generic_category().message(code);
  if (code == ENOSPC || code == EDQUOT || code == EFBIG) throw ResourceError(message);
  throw IoError(message);
}

class MachineDescriptor {
 public:
  MachineDescriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {
    if (fd_ < 0) raise("cannot open", path, errno);
  }
  ~MachineDescriptor() { ::close(fd_); }
  MachineDescriptor(const MachineDescriptor&) = delete;
  MachineDescriptor& operator=(const MachineDescriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), error);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) raise("cannot make the folder", folder, errno);
}

/// Held while the file is changed; every program that changes it waits here. The file itself cannot be
/// locked, since it is replaced.
class Lock {
 public:
  explicit Lock(const fs::path& folder) : file_(folder / "machine.lock", O_RDWR | O_CREAT) {
    const auto end = std::chrono::steady_clock::now() + longest_wait;
    while (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK && errno != EINTR) raise("cannot lock", folder / "machine.lock", errno);
      if (std::chrono::steady_clock::now() > end)
        throw IoError("cannot change " + (folder / "machine.json").string() +
                      ": another window or program has been changing it for two seconds");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

 private:
  MachineDescriptor file_;
};

void write_private(const fs::path& path, const std::string& text) {
  core::StagedFile staged(path);
  {
    const MachineDescriptor out(staged.temporary(), O_WRONLY | O_CREAT | O_EXCL);
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t wrote = ::write(out.get(), text.data() + done, text.size() - done);
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote < 0) raise("cannot write", path, errno);
      done += static_cast<std::size_t>(wrote);
    }
  }
  staged.commit();
}

/// A name beside the file that is not taken.
fs::path free_name(const fs::path& path) {
  for (int k = 1;; ++k) {
    const fs::path name = path.string() + ".damaged-" + std::to_string(k);
    std::error_code error;
    if (!fs::exists(fs::symlink_status(name, error))) return name;
  }
}

RecentCase recent_case(const MachineJson& in) {
  return {unescaped(in.at("path").get<std::string>()), in.at("pseudonym").get<std::string>(),
          in.at("opened").get<std::int64_t>()};
}

MachineContent content_of(const MachineJson& in) {
  if (in.at("v") != 1) throw InvalidInput("it is of version " + in.at("v").dump() + ", this program reads 1");
  MachineContent content;
  for (const auto& [sha256, image] : in.at("images").items())
    content.images[sha256] = {unescaped(image.at("path").get<std::string>()),
                              image.at("seen").get<std::int64_t>(),
                              unescaped(image.value("series", std::string()))};
  for (const MachineJson& one : in.at("recent")) content.recent.push_back(recent_case(one));
  if (content.recent.size() > MachineState::most_recent_cases)
    content.recent.resize(MachineState::most_recent_cases);
  content.settings = in.at("settings").get<std::map<std::string, std::string>>();
  return content;
}

}  // namespace

std::string machine_json(const MachineContent& content) {
  MachineJson out{{"v", 1},
                  {"images", MachineJson::object()},
                  {"recent", MachineJson::array()},
                  {"settings", content.settings}};
  for (const auto& [sha256, image] : content.images) {
    MachineJson& one = out["images"][sha256] = {{"path", escaped(image.path.string())}, {"seen", image.seen}};
    if (!image.series_uid.empty()) one["series"] = escaped(image.series_uid);
  }
  for (const RecentCase& one : content.recent)
    out["recent"].push_back(
        {{"path", escaped(one.path.string())}, {"pseudonym", one.pseudonym}, {"opened", one.opened}});
  try {
    return out.dump(1) + "\n";
  } catch (const MachineJson::exception&) {
    throw InvalidInput("a setting or a pseudonym is not UTF-8 and cannot be kept");
  }
}

MachineContent machine_content(const std::string& json) {
  try {
    return content_of(MachineJson::parse(json));
  } catch (const MachineJson::exception& e) {
    throw InvalidInput(e.what());
  }
}

/// What cannot be put right is not told at every reading.
void MachineFile::tell(const std::string& notice) {
  if (notice != last_notice_) notices_.push_back(notice);
  last_notice_ = notice;
}

MachineContent MachineFile::read_or_move_aside() {
  std::error_code error;
  if (!fs::exists(path(), error)) return {};
  try {
    return machine_content(core::read_file(path(), largest_file));
  } catch (const IoError& e) {
    throw IoError(std::string("what is known of this machine cannot be read: ") + e.what());
  } catch (const Error& e) {
    const fs::path aside = free_name(path());
    if (::rename(path().c_str(), aside.c_str()) != 0) raise("cannot move aside", path(), errno);
    notices_.push_back(
        "what was known of this machine (recent cases, where images lie, the window) could not "
        "be read and was moved to " +
        aside.string() + ": " + e.what());
    return {};
  }
}

MachineContent MachineFile::read() {
  std::error_code error;
  if (!fs::exists(path(), error)) return {};
  try {
    return machine_content(core::read_file(path(), largest_file));
  } catch (const Error&) {
    // Another program may have put it right meanwhile: once more, with the lock.
  }
  try {
    const Lock lock(folder_);
    return read_or_move_aside();
  } catch (const Error& e) {
    tell(e.what());
    return {};
  }
}

void MachineFile::change(const std::function<void(MachineContent&)>& changing) {
  make_folder(folder_);
  const Lock lock(folder_);
  MachineContent content = read_or_move_aside();
  changing(content);
  write_private(path(), machine_json(content));
}

}  // namespace ostia::session
