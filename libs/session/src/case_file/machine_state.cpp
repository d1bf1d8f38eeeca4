#include "ostia/session/machine_state.h"

#include "case_file/machine_file.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

/// The same place under one name, without following links.
fs::path place(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

void erase_case(std::vector<RecentCase>& cases, const fs::path& path) {
  std::erase_if(cases, [&](const RecentCase& one) { return one.path == path; });
}

/// Those seen longest ago go.
void shorten(std::map<std::string, SeenImage>& images) {
  while (images.size() > MachineState::most_images)
    images.erase(std::min_element(images.begin(), images.end(), [](const auto& a, const auto& b) {
      return a.second.seen < b.second.seen;
    }));
}

}  // namespace

struct MachineState::Impl {
  MachineFile file;
};

MachineState::MachineState(fs::path folder) : impl_(new Impl{MachineFile(std::move(folder))}) {}
MachineState::~MachineState() = default;
MachineState::MachineState(MachineState&&) noexcept = default;
MachineState& MachineState::operator=(MachineState&&) noexcept = default;

std::optional<KnownImage> MachineState::find_image(const std::string& sha256) const {
  const MachineContent content = impl_->file.read();
  const auto found = content.images.find(sha256);
  std::error_code error;
  if (found == content.images.end() || !fs::exists(found->second.path, error)) return std::nullopt;
  return KnownImage{found->second.path, found->second.series_uid};
}

void MachineState::remember_image(const std::string& sha256, const fs::path& path,
                                  const std::string& series_uid) {
  impl_->file.change([&](MachineContent& content) {
    content.images[sha256] = {place(path), now(), series_uid};
    shorten(content.images);
  });
}

std::vector<RecentCase> MachineState::recent_cases() const {
  return impl_->file.read().recent;
}

void MachineState::remember_case(const RecentCase& opened) {
  RecentCase added = opened;
  added.path = place(opened.path);
  impl_->file.change([&](MachineContent& content) {
    erase_case(content.recent, added.path);
    content.recent.insert(content.recent.begin(), added);
    if (content.recent.size() > most_recent_cases) content.recent.resize(most_recent_cases);
  });
}

void MachineState::forget_case(const fs::path& path) {
  impl_->file.change([&](MachineContent& content) { erase_case(content.recent, place(path)); });
}

std::optional<std::string> MachineState::setting(const std::string& key) const {
  const MachineContent content = impl_->file.read();
  const auto found = content.settings.find(key);
  return found == content.settings.end() ? std::nullopt : std::optional(found->second);
}

std::map<std::string, std::string> MachineState::settings() const {
  return impl_->file.read().settings;
}

void MachineState::set_setting(const std::string& key, const std::string& value) {
  set_settings({{key, value}});
}

void MachineState::set_settings(const std::map<std::string, std::string>& values) {
  impl_->file.change([&](MachineContent& content) {
    for (const auto& [key, value] : values) content.settings[key] = value;
  });
}

std::vector<std::string> MachineState::take_notices() {
  return impl_->file.take_notices();
}

}  // namespace ostia::session
