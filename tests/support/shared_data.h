#pragma once
/// \file Real inputs that tests and benchmarks may use. They are not part of the project.

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

namespace ostia::testing {

/// The file or folder `relative` below $OSTIA_SHARED_DATA or, where that is unset, ../shared/data beside the
/// checkout. Nothing when it is not there.
std::optional<std::filesystem::path> shared_data(const std::string& relative);

/// Whether $OSTIA_SHARED_DATA is set: then a missing input is a failure, not a skip.
bool shared_data_required();

/// A fresh empty folder that is removed at the end of the program.
std::filesystem::path temporary_folder(const std::string& name);

/// The members of a zip archive below shared data, unpacked once into a temporary folder of this program.
std::filesystem::path unpacked(const std::filesystem::path& zip);

}  // namespace ostia::testing

/// Defines `name` as the path of a real input; skips the test (or fails it, when $OSTIA_SHARED_DATA is set)
/// by name where absent.
#define OSTIA_REQUIRE_SHARED(name, relative)                                                                 \
  const auto name##_optional = ::ostia::testing::shared_data(relative);                                      \
  if (!name##_optional) {                                                                                    \
    if (::ostia::testing::shared_data_required()) FAIL() << "missing in $OSTIA_SHARED_DATA: " << (relative); \
    GTEST_SKIP() << "needs shared data: " << (relative);                                                     \
  }                                                                                                          \
  const std::filesystem::path name = *name##_optional
