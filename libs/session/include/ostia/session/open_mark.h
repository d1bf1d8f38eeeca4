#pragma once
/// \file Which case a running program has open, so that the next start can go on with it after a crash.

#include <filesystem>
#include <vector>

namespace ostia::session {

/// A file of one program in the folder `open` of a state folder, locked as long as the program lives: the
/// system lets go of the lock however the program ends, so that marks of the living and of the dead are told
/// apart for sure. It holds the case's path, for this user alone (0600). A mark that is not cleared stays.
class OpenMark {
 public:
  explicit OpenMark(const std::filesystem::path& state_folder);  ///< writes nothing yet
  ~OpenMark();
  OpenMark(const OpenMark&) = delete;
  OpenMark& operator=(const OpenMark&) = delete;

  /// In place of what it said before. Throws IoError naming the folder.
  void set(const std::filesystem::path& case_file);
  void clear();
  /// The cases of programs that ended without `clear`, the last one first; their marks are taken away, so
  /// that of several programs that start at once only one gets each. What cannot be read is left out.
  std::vector<std::filesystem::path> take_left();

 private:
  std::filesystem::path folder_, file_;
  int held_ = -1;
};

}  // namespace ostia::session
