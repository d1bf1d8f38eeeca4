#pragma once
/// \file The program under test, and its window under the X server's own keys and mouse.

#include "ostia/core/files.h"
#include "ostia/glview/offscreen.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace ostia::live {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

#define REQUIRE_OPENGL() \
  if (const std::string why = glview::offscreen_trouble(); !why.empty()) GTEST_SKIP() << why

struct LiveProgramGui : ::testing::Test {
  fs::path folder =
      fs::path(::testing::TempDir()) /
      (std::string("live_program_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  LiveProgramGui() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~LiveProgramGui() override { fs::remove_all(folder); }

  /// A shell's line in the folder, in which $live is the program.
  Outcome shell(const std::string& line) const {
    const std::string all =
        "cd '" + folder.string() + "' && live='" OSTIA_LIVE "' && { " + line + "; } > out 2> err";
    const int status = std::system(all.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), core::read_file(folder / "out"),
            core::read_file(folder / "err")};
  }
  Outcome live(const std::string& arguments, const std::string& before = "") const {
    return shell(before + " \"$live\" " + arguments);
  }
  /// The window under some commands of xdotool, one a line; it ends by itself at the latest.
  Outcome driven(const std::string& arguments, const std::string& commands) const {
    return shell(
        "\"$live\" " + arguments +
        " --measure --seconds 30 & p=$!; w=$(timeout 20 xdotool search --sync --onlyvisible --name '^Ostia "
        "live$' | head -n 1); xdotool windowfocus --sync $w; sleep 0.7; " +
        commands + "; sleep 0.3; xdotool key q; wait $p");
  }
};

inline bool has_xdotool() {
  return std::system("command -v xdotool > /dev/null 2>&1") == 0;
}

}  // namespace ostia::live
