#pragma once
/// \file A program that runs as long as a test needs it.

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::testing {

/// A port that was free a moment ago.
int free_port();
/// Something on this machine takes connections there.
bool answers(int port);
/// The same within half a minute.
bool comes_to_answer(int port);

/// Killed at the end; what it says goes into `log`.
class StartedProgram {
 public:
  explicit StartedProgram(const std::vector<std::string>& words,
                          const std::filesystem::path& log = "/dev/null");
  ~StartedProgram() { kill(); }
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;
  bool running() const { return process_ > 0; }
  void kill();  ///< as a power cut does

 private:
  pid_t process_ = -1;
};

}  // namespace ostia::testing
