#pragma once
/// \file The program under test, run as a user runs it.

#include "shared_data.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::testing {

struct Outcome {
  int code = -1;  ///< exit code; 128 + n when signal n ended it
  std::string out, err;
};

/// How the program is started.
struct Setting {
  std::filesystem::path folder;  ///< it runs there; empty: a fresh one
  std::string before;            ///< shell text in front of it: "ulimit -f 100;", "LC_ALL=de_DE.UTF-8"
};

/// One word for the shell, whatever it holds.
std::string quoted(const std::string& word);

/// Runs `ostia` with these arguments.
Outcome ostia(const std::vector<std::string>& arguments, const Setting& setting = {});

/// Starts it, sends `signal` after `seconds`, waits. Sets how long it took to end from then on.
Outcome interrupted(const std::vector<std::string>& arguments, const Setting& setting, int signal,
                    double seconds, double& seconds_to_end);

/// The names of all that a folder holds, at any depth, sorted.
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// A small image of the built-in case in a fresh folder, with the branches that its arteries are found by.
struct SmallCase {
  std::filesystem::path folder, image;
  std::vector<std::string> branch_arguments;
  std::vector<std::string> branch_arguments_ras, branch_arguments_ijk;
};
SmallCase small_case(const std::string& image_name = "heart.nrrd");

/// a followed by b.
std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b);

}  // namespace ostia::testing
