#pragma once
/// \file Options that do not go together, refused before anything is read.

#include "program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::testing {

/// `ostia mesh` and `ostia model` of a surface that is not there end with `code` and say `part`, which is of
/// the options `more`; nothing is written.
inline void expect_mesh_and_model_refuse(const std::vector<std::string>& more, int code,
                                         const std::string& part) {
  const std::filesystem::path folder = temporary_folder("refused");
  for (const std::string command : {"mesh", "model"}) {
    const Outcome done =
        ostia(std::vector<std::string>{command, "tube.ply", "-o", "out"} + more, {folder, ""});
    EXPECT_EQ(done.code, code) << command << ": " << done.err;
    EXPECT_THAT(done.err + done.out, ::testing::HasSubstr(part)) << command;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace ostia::testing
