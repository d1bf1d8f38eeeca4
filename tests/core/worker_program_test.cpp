#include "ostia/core/worker_program.h"

#include "ostia/core/private_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

namespace ostia::core {
namespace {

namespace fs = std::filesystem;

/// $OSTIA_WORKER as wanted, and as it was afterwards.
class WorkerVariable {
 public:
  explicit WorkerVariable(const char* value) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  WorkerVariable(const WorkerVariable&) = delete;
  WorkerVariable& operator=(const WorkerVariable&) = delete;
  ~WorkerVariable() { set(before_ ? before_->c_str() : nullptr); }

 private:
  static constexpr const char* name = "OSTIA_WORKER";
  static void set(const char* value) {
    if (value)
      ::setenv(name, value, 1);
    else
      ::unsetenv(name);
  }
  std::optional<std::string> before_;
};

void make_file(const fs::path& path) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << "a program\n";
}

/// A copy of this program in a folder of its own, run to say what worker_program() is there.
class InstalledTree : public ::testing::Test {
 protected:
  InstalledTree() { fs::create_directories(bin()); }
  fs::path root() const { return fs::canonical(folder_.path()); }
  fs::path bin() const { return root() / "bin"; }

  std::string worker_found() const {
    const fs::path program = bin() / "program", said = root() / "said";
    fs::copy_file("/proc/self/exe", program, fs::copy_options::overwrite_existing);
    const std::string command = "OSTIA_SAID='" + said.string() + "' '" + program.string() +
                                "' --gtest_also_run_disabled_tests "
                                "--gtest_filter=WorkerProgram.DISABLED_IsSaid >/dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::string line;
    std::ifstream file(said);
    std::getline(file, line);
    return line;
  }

 private:
  const WorkerVariable without_{nullptr};
  PrivateFolder folder_;
};

TEST(WorkerProgram, IsWhatTheEnvironmentSays) {
  const WorkerVariable given("/somewhere/worker");
  EXPECT_EQ(worker_program(), "/somewhere/worker");
}

TEST(WorkerProgram, DISABLED_IsSaid) {
  if (const char* told = std::getenv("OSTIA_TOLD")) set_worker_program(told);
  std::ofstream(std::getenv("OSTIA_SAID")) << worker_program().string() << "\n";
}

TEST_F(InstalledTree, HasItBesideTheProgram) {
  make_file(bin() / "ostia-worker");
  make_file(root() / "libexec" / "ostia" / "ostia-worker");
  EXPECT_EQ(worker_found(), (bin() / "ostia-worker").string());
}

TEST_F(InstalledTree, HasItAmongProgramsForPrograms) {
  make_file(root() / "libexec" / "ostia" / "ostia-worker");
  EXPECT_EQ(worker_found(), (root() / "libexec" / "ostia" / "ostia-worker").string());
}

TEST_F(InstalledTree, TakesWhatItWasTold) {
  const fs::path elsewhere = root() / "elsewhere" / "ostia-worker";
  make_file(elsewhere);
  ::setenv("OSTIA_TOLD", elsewhere.c_str(), 1);
  EXPECT_EQ(worker_found(), elsewhere.string());
  ::unsetenv("OSTIA_TOLD");
}

TEST_F(InstalledTree, NamesThePlaceBesideWhereThereIsNone) {
  EXPECT_EQ(worker_found(), (bin() / "ostia-worker").string());
}

}  // namespace
}  // namespace ostia::core
