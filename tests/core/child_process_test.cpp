#include "ostia/core/child_process.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace ostia::core {
namespace {

ChildResult shell(const std::string& script, const ChildLimits& limits = {},
                  const TaskContext& task = no_task()) {
  return run_child("/bin/sh", {"-c", script}, limits, task);
}

TEST(ChildProcess, ReportsExitCodeAndStandardError) {
  const ChildResult result = shell("echo slice 7 >&2; exit 3");
  EXPECT_FALSE(result.ok());
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.standard_error, "slice 7\n");
  EXPECT_EQ(result.describe(), "exited with code 3");
  EXPECT_TRUE(shell("exit 0").ok());
}

TEST(ChildProcess, AppendsWhatItSaysToALog) {
  const std::filesystem::path log = testing::temporary_folder("child") / "a.log";
  for (const char* said : {"one", "two"})
    run_child("/bin/sh", {"-c", std::string("echo ") + said + " >&2; exit 3"}, {}, no_task(), log);
  EXPECT_EQ(read_file(log), "one\ntwo\n");
  EXPECT_THROW(run_child("/bin/sh", {"-c", "exit 0"}, {}, no_task(), log / "no"), IoError);
}

TEST(ChildProcess, KnowsItsMostMemory) {
  const double little = shell("exit 0").peak_mb;
  EXPECT_GT(little, 0.1);
  const ChildResult much = shell("head -c 100000000 /dev/zero | tail -c 100000000 > /dev/null");
  EXPECT_TRUE(much.ok());
  EXPECT_GT(much.peak_mb, 95.0);  // of its own child, which keeps 100 MB
  EXPECT_LT(much.peak_mb, 200.0);
}

TEST(ChildProcess, SurvivesAnAbortingChild) {
  const ChildResult result = shell("kill -ABRT $$");
  EXPECT_EQ(result.signal, SIGABRT);
  EXPECT_NE(result.describe().find("signal 6"), std::string::npos);
}

TEST(ChildProcess, EndsAChildThatBurnsTime) {
  ChildLimits limits;
  limits.cpu_time = std::chrono::seconds(1);
  const ChildResult result = shell("while :; do :; done", limits);
  EXPECT_TRUE(result.out_of_time);
  EXPECT_FALSE(result.ok());
}

TEST(ChildProcess, LimitsMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "memory limits are off under AddressSanitizer";
#endif
  ChildLimits limits;
  limits.memory_bytes = 256 << 20;
  const ChildResult result = run_child(
      "/usr/bin/awk", {"BEGIN { s = \"x\"; for (i = 0; i < 40; ++i) s = s s; print length(s) }"}, limits);
  EXPECT_FALSE(result.ok());
}

TEST(ChildProcess, LimitsTheFileItWrites) {
  ChildLimits limits;
  limits.output_bytes = 1000;
  EXPECT_FALSE(shell("f=$(mktemp); trap 'rm -f $f' EXIT; head -c 100000 /dev/zero > $f", limits).ok());
}

TEST(ChildProcess, KeepsTheTailOfALongStandardError) {
  const ChildResult result = shell(
      "i=0; while [ $i -lt 3000 ]; do echo 0123456789012345678901234567890123456789 >&2; "
      "i=$((i+1)); done; echo end >&2");
  EXPECT_LE(result.standard_error.size(), 65536u);
  EXPECT_EQ(result.standard_error.substr(result.standard_error.size() - 4), "end\n");
}

TEST(ChildProcess, CancelKillsTheChild) {
  const TaskContext task;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    task.cancel();
  });
  EXPECT_THROW(shell("sleep 100", {}, task), Cancelled);
  canceller.join();
}

TEST(ChildProcess, PassesNoForeignEnvironmentOn) {
  ::setenv("PATIENT", "DOE^JANE", 1);
  EXPECT_EQ(shell("env >&2").standard_error.find("DOE"), std::string::npos);
  ::unsetenv("PATIENT");
}

TEST(ChildProcess, NamesAMissingProgram) {
  EXPECT_THROW(run_child("/nonexistent/ostia-worker", {}), IoError);
}

}  // namespace
}  // namespace ostia::core
