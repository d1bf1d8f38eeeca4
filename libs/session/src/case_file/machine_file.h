#pragma once
/// \file The file of a machine's state: read, locked, replaced, moved aside.

#include "ostia/session/machine_state.h"

#include <functional>
#include <utility>

namespace ostia::session {

struct SeenImage {
  std::filesystem::path path;
  std::int64_t seen = 0;        ///< seconds since 1970 began
  std::string series_uid = {};  ///< empty where none was chosen
};

struct MachineContent {
  std::map<std::string, SeenImage> images;  ///< by SHA-256
  std::vector<RecentCase> recent;           ///< newest first
  std::map<std::string, std::string> settings;
};

/// As JSON. Bytes of paths and UIDs that are not plain ASCII are written %XX, since they need not be UTF-8.
/// Throws InvalidInput for settings that are not UTF-8.
std::string machine_json(const MachineContent& content);
/// Throws InvalidInput for what is not such a file, or is one of a newer version.
MachineContent machine_content(const std::string& json);

class MachineFile {
 public:
  explicit MachineFile(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Empty where there is none or none that can be read. Moves a damaged one aside.
  MachineContent read();
  /// Reads, changes and replaces it, under a lock.
  void change(const std::function<void(MachineContent&)>& changing);
  std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }

 private:
  std::filesystem::path path() const { return folder_ / "machine.json"; }
  MachineContent read_or_move_aside();
  void tell(const std::string& notice);
  std::filesystem::path folder_;
  std::vector<std::string> notices_;
  std::string last_notice_;
};

}  // namespace ostia::session
