#include "case_file/machine_file.h"

#include "case_file/private_file.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <system_error>
#include <utility>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

using MachineJson = nlohmann::json;

constexpr std::uint64_t largest_file = 16U << 20;

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
          in.at("opened").get<std::int64_t>(), in.value("image", std::string())};
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
  for (const RecentCase& one : content.recent) {
    out["recent"].push_back(
        {{"path", escaped(one.path.string())}, {"pseudonym", one.pseudonym}, {"opened", one.opened}});
    if (!one.image_sha256.empty()) out["recent"].back()["image"] = one.image_sha256;
  }
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
    if (::rename(path().c_str(), aside.c_str()) != 0) raise_file_error("cannot move aside", path(), errno);
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
    const PrivateLock lock(path());
    return read_or_move_aside();
  } catch (const Error& e) {
    tell(e.what());
    return {};
  }
}

void MachineFile::change(const std::function<void(MachineContent&)>& changing) {
  make_private_folder(folder_);
  const PrivateLock lock(path());
  MachineContent content = read_or_move_aside();
  changing(content);
  write_private(path(), machine_json(content));
}

}  // namespace ostia::session
