// Runs of OpenFOAM as they are watched from outside: logs of known content, a real run, one that fails, one
// that is given up.

#include "ostia/solver/openfoam_launch.h"

#include "solver_test_support.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <future>
#include <sstream>
#include <thread>

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;

const std::string two_iterations =
    "Time = 7\n\nsmoothSolver:  Solving for Ux, Initial residual = 0.02, Final residual = 1e-5, No "
    "Iterations 3\n"
    "GAMG:  Solving for p, Initial residual = 0.5, Final residual = 1e-3, No Iterations 2\n"
    "GAMG:  Solving for p, Initial residual = 0.04, Final residual = 1e-3, No Iterations 2\n"
    "ExecutionTime = 0.6 s  ClockTime = 1 s\n\n"
    "Time = 8\n\nsmoothSolver:  Solving for Ux, Initial residual = 0.01, Final residual = 1e-5, No "
    "Iterations 3\n";

TEST(OpenfoamProgressOfLog, ReadsTimeAndTheLargestResidualOfTheLastWholeIteration) {
  const OpenfoamProgress progress = progress_of_log("cut off = 3\n\n" + two_iterations);
  EXPECT_EQ(progress.time, 8.0);
  ASSERT_TRUE(progress.residual);
  EXPECT_EQ(*progress.residual, 0.5);
  EXPECT_FALSE(progress.converged);
  const OpenfoamProgress whole = progress_of_log(
      "\n" + two_iterations +
      "GAMG:  Solving for p, Initial residual = 0.003, Final residual = 1e-6, No Iterations 2\n"
      "ExecutionTime = 0.7 s  ClockTime = 1 s\n\n\nSIMPLE solution converged in 8 iterations\n\nEnd\n");
  EXPECT_EQ(*whole.residual, 0.01);
  EXPECT_TRUE(whole.converged);
}

TEST(OpenfoamProgressOfLog, NothingIsReadFromNothing) {
  for (const char* text :
       {"", "Create mesh for time = 0\n", "\nTime = ", "\nTime = nan\n\nInitial residual = "}) {
    const OpenfoamProgress progress = progress_of_log(text);
    EXPECT_EQ(progress.time, 0.0) << text;
    EXPECT_FALSE(progress.residual) << text;
  }
}

TEST(OpenfoamProgressOfLog, ASteadyRunIsHalfDoneAtTheRootOfItsTolerance) {
  const OpenfoamRunPlan steady{"simpleFoam", 2000.0, 1e-6};
  EXPECT_NEAR(share_done({20.0, 1e-3, false}, steady), 0.5, 1e-12);
  EXPECT_NEAR(share_done({1800.0, 1e-3, false}, steady), 0.9, 1e-12);  // by its iterations
  EXPECT_EQ(share_done({20.0, 1e-9, true}, steady), 1.0);
  EXPECT_EQ(share_done({1.0, 2.0, false}, steady), 1.0 / 2000.0);  // worse than at the start
  const OpenfoamRunPlan pulsatile{"pisoFoam", 2.4, 1e-6};
  EXPECT_NEAR(share_done({0.6, 1e-9, false}, pulsatile), 0.25, 1e-12);
}

TEST(OpenfoamLaunch, AFolderThatIsNoCaseIsRefused) {
  const fs::path folder = testing::temporary_folder("run");
  expect_refusal([&] { run_openfoam_case(folder); }, {"controlDict"});
  fs::create_directories(folder / "system");
  core::write_file(folder / "system" / "controlDict", "application icoFoam;\nendTime 3;\n");
  expect_refusal([&] { run_openfoam_case(folder); }, {folder.string(), "simpleFoam", "ostia case"});
}

/// A case by hand, whose "solver" is what Allrun says.
fs::path case_of(const std::string& script) {
  const fs::path folder = testing::temporary_folder("run");
  fs::create_directories(folder / "system");
  core::write_file(folder / "system" / "controlDict", "application simpleFoam;\nendTime 100;\n");
  core::write_file(folder / "system" / "fvSolution", "residualControl\n{\n    p 1e-4;\n}\n");
  core::write_file(folder / "Allrun", script);
  return folder;
}

TEST(OpenfoamLaunch, ThePlanIsReadFromTheCase) {
  const OpenfoamRunPlan plan = openfoam_run_plan(case_of("true\n"));
  EXPECT_EQ(plan.program, "simpleFoam");
  EXPECT_EQ(plan.end_time, 100.0);
  EXPECT_EQ(plan.tolerance, 1e-4);
}

TEST(OpenfoamLaunch, AProgramThatIsNotThereIsSaidWithItsPackage) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere:", 1);
  try {
    run_openfoam_case(case_of("true\n"));
    ADD_FAILURE() << "was run";
  } catch (const IoError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("apt install openfoam"), std::string::npos) << text;
    EXPECT_NE(text.find("Allrun"), std::string::npos) << text;
  }
  ::setenv("PATH", path.c_str(), 1);
}

TEST(OpenfoamLaunch, AFailureEndsWithTheLogsLastLines) {
  NEEDS_OPENFOAM();
  const fs::path folder = case_of(
      "cd \"${0%/*}\"\nfor i in 1 2 3 4 5 6 7 8 9 10 11; do echo line $i; done > log.simpleFoam\n"
      "echo 'FOAM FATAL ERROR: no such thing' >> log.simpleFoam\nexit 3\n");
  try {
    run_openfoam_case(folder);
    ADD_FAILURE() << "was fine";
  } catch (const NumericalError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("code 3"), std::string::npos) << text;
    EXPECT_NE(text.find("log.simpleFoam"), std::string::npos) << text;
    EXPECT_NE(text.find("no such thing"), std::string::npos) << text;
    EXPECT_EQ(text.find("line 4\n"), std::string::npos) << text;
  }
}

/// The shell that runs the script tells it by an exit code, the script itself by its signal.
TEST(OpenfoamLaunch, ARunThatIsToldToStopFromOutsideIsNoFailure) {
  NEEDS_OPENFOAM();
  for (const char* script :
       {"sh -c 'kill -TERM $$' || exit $?\n", "sh -c 'kill -INT $$' || exit $?\n", "kill -HUP $$\n"}) {
    try {
      run_openfoam_case(case_of(script));
      ADD_FAILURE() << "was fine";
    } catch (const ResourceError& error) {
      EXPECT_NE(std::string(error.what()).find("ended from outside"), std::string::npos) << error.what();
    }
  }
}

TEST(OpenfoamLaunch, WhatTheScriptSaysIsToldWithTheLog) {
  NEEDS_OPENFOAM();
  const fs::path folder =
      case_of("cd \"${0%/*}\"; echo round 20 > log.outlets; echo 'they have not settled' >&2; exit 1\n");
  try {
    run_openfoam_case(folder);
    ADD_FAILURE() << "was fine";
  } catch (const NumericalError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("have not settled"), std::string::npos) << text;
    EXPECT_NE(text.find("log.outlets ends with:\nround 20"), std::string::npos) << text;
  }
}

TEST(OpenfoamLaunch, AFolderWithBlanksIsRefusedBeforeItRuns) {
  for (const char* name : {"two words", "a\ttab", "it's", "\"so\""}) {
    const fs::path folder = testing::temporary_folder("run") / name;
    fs::create_directory(folder);
    fs::copy(case_of("touch \"${0%/*}/was-run\"\n"), folder, fs::copy_options::recursive);
    expect_refusal([&] { run_openfoam_case(folder); }, {folder.string(), "blanks", "move"});
    EXPECT_FALSE(fs::exists(folder / "was-run"));
  }
}

TEST(OpenfoamLaunch, AnotherInstallationKeepsItsSettings) {
  NEEDS_OPENFOAM();
  ::setenv("WM_PROJECT_DIR", "/opt/openfoam", 1);
  ::setenv("PATIENT", "DOE^JANE", 1);
  const fs::path folder = case_of("env > \"${0%/*}/seen\"\n");
  run_openfoam_case(folder);
  ::unsetenv("WM_PROJECT_DIR");
  ::unsetenv("PATIENT");
  const std::string seen = core::read_file(folder / "seen");
  EXPECT_NE(seen.find("WM_PROJECT_DIR=/opt/openfoam"), std::string::npos) << seen;
  EXPECT_EQ(seen.find("DOE"), std::string::npos) << seen;
}

/// A process of this id that is not a zombie.
bool alive(int pid) {
  const fs::path file = "/proc/" + std::to_string(pid) + "/stat";
  std::ifstream in(file);
  std::ostringstream read;  // a process that dies meanwhile is an end of file, no exception
  read << in.rdbuf();
  const std::string text = read.str();
  const std::size_t end = text.rfind(") ");
  return end != std::string::npos && text.size() > end + 2 && text[end + 2] != 'Z';
}

TEST(OpenfoamLaunch, GivenUpItLeavesNoProcess) {
  NEEDS_OPENFOAM();
  // A child of a child, as the solver is one of the script.
  const fs::path folder = case_of(
      "cd \"${0%/*}\"\nsh -c 'echo $$ > pid.part; mv pid.part pid; sleep 600; true' > log.simpleFoam 2>&1\n");
  const core::TaskContext task;
  auto run = std::async(std::launch::async, [&] { run_openfoam_case(folder, task); });
  while (!fs::exists(folder / "pid")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const int pid = std::stoi(core::read_file(folder / "pid"));
  EXPECT_TRUE(alive(pid));
  task.cancel();
  EXPECT_THROW(run.get(), Cancelled);
  for (int i = 0; i < 200 && alive(pid); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(alive(pid));
}

TEST(OpenfoamLaunch, WhereOstiaDiesItsProcessesEnd) {
  NEEDS_OPENFOAM();
  const fs::path folder = case_of(
      "cd \"${0%/*}\"\nsh -c 'echo $$ > pid.part; mv pid.part pid; sleep 600; true' > log.simpleFoam 2>&1\n");
  const pid_t ostia = ::fork();
  ASSERT_GE(ostia, 0);
  if (ostia == 0) {
    run_openfoam_case(folder);
    ::_exit(0);
  }
  while (!fs::exists(folder / "pid")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const int pid = std::stoi(core::read_file(folder / "pid"));
  EXPECT_TRUE(alive(pid));
  ::kill(ostia, SIGKILL);
  ::waitpid(ostia, nullptr, 0);
  for (int i = 0; i < 1000 && alive(pid); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(alive(pid));
}

TEST(OpenfoamLaunch, ATubeConvergesAndSaysSo) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(6.0, 1.5), 0.8, 0);
  const fs::path folder = testing::temporary_folder("run") / "case";
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  write_openfoam_case(mesh, options, folder);
  const core::TaskContext task;
  const OpenfoamProgress done = run_openfoam_case(folder, task);
  EXPECT_TRUE(done.converged);
  EXPECT_GT(done.time, 10.0);
  ASSERT_TRUE(done.residual);
  EXPECT_LT(*done.residual, 1e-6);
  EXPECT_EQ(task.progress(), 1.0);
}

}  // namespace
}  // namespace ostia::solver
