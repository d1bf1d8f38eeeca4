// A case that goes on for longer, with what it has.

#include "ostia/solver/openfoam_continue.h"

#include "solver_test_support.h"

#include "ostia/solver/case_record.h"
#include "ostia/solver/openfoam_launch.h"

#include <gmock/gmock.h>

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const geometry::MixedMesh& continued_tube() {
  static const geometry::MixedMesh mesh = vessel(geometry::straight_tube(6.0, 1.5), 0.7, 0);
  return mesh;
}

fs::path written(const OpenfoamCaseOptions& options) {
  const fs::path folder = testing::temporary_folder("continue") / "case";
  write_openfoam_case(continued_tube(), options, folder);
  return folder;
}

OpenfoamCaseOptions pulse(int cycles) {
  OpenfoamCaseOptions options;
  options.flow.waveform = builtin_waveform("coronary-left");
  options.cycles = cycles;
  options.samples_per_cycle = 10;
  return options;
}

TEST(OpenfoamContinue, ASteadyCaseEndsLaterAndIsElseTheSame) {
  OpenfoamCaseOptions options;
  const fs::path folder = written(options);
  fs::create_directory(folder / "2000");  // its result
  EXPECT_DOUBLE_EQ(length_of(folder).now, 2000.0);
  const CaseLength length = continue_openfoam_case(folder, 4000, std::nullopt);
  EXPECT_DOUBLE_EQ(length.now, 2000.0);
  EXPECT_DOUBLE_EQ(length.end, 4000.0);
  EXPECT_DOUBLE_EQ(openfoam_run_plan(folder).end_time, 4000.0);
  EXPECT_THAT(core::read_file(folder / "system/controlDict"), HasSubstr("\nwriteInterval   4000;\n"));
  EXPECT_TRUE(fs::is_directory(folder / "2000"));
  EXPECT_NE(fs::status(folder / "Allrun").permissions() & fs::perms::owner_exec, fs::perms::none);
  // As if it had been written so.
  options.iterations = 4000;
  const fs::path fresh = written(options);
  for (const char* file : {"system/controlDict", "Allrun"})
    EXPECT_EQ(core::read_file(folder / file), core::read_file(fresh / file)) << file;
  EXPECT_EQ(difference_of_cases(folder, fresh), "");
}

TEST(OpenfoamContinue, SoDoesOneWhoseOutletsAreCoupled) {
  OpenfoamCaseOptions options;
  options.flow.outlets = OutletModel::resistance;
  const geometry::MixedMesh fork = vessel(geometry::y_junction(5.0, 5.0, 1.5, 1.2, 60.0), 0.9, 0);
  const fs::path folder = testing::temporary_folder("continue");
  write_openfoam_case(fork, options, folder / "a");
  continue_openfoam_case(folder / "a", 5000, std::nullopt);
  options.iterations = 5000;
  write_openfoam_case(fork, options, folder / "b");
  EXPECT_EQ(core::read_file(folder / "a/Allrun"), core::read_file(folder / "b/Allrun"));
  EXPECT_THAT(core::read_file(folder / "a/Allrun"), HasSubstr("-ge 5000 ]"));
}

TEST(OpenfoamContinue, APulseGetsTheVelocitiesOfMoreCycles) {
  const fs::path folder = written(pulse(2)), fresh = written(pulse(4));
  EXPECT_EQ(difference_of_cases(folder, fresh), "");
  const CaseLength length = continue_openfoam_case(folder, std::nullopt, 4);
  EXPECT_TRUE(length.pulsatile);
  EXPECT_NEAR(length.end, 3.2, 1e-12);
  EXPECT_EQ(read_case_record(folder).cycles, 4);
  const fs::path inlets = "constant/boundaryData";
  for (const auto& entry : fs::recursive_directory_iterator(fresh / inlets)) {
    if (!entry.is_regular_file()) continue;
    const fs::path own = folder / fs::relative(entry.path(), fresh);
    ASSERT_TRUE(fs::exists(own)) << own;
    EXPECT_EQ(core::read_file(own), core::read_file(entry.path())) << own;
  }
  EXPECT_EQ(core::read_file(folder / "system/controlDict"), core::read_file(fresh / "system/controlDict"));
}

TEST(OpenfoamContinue, RefusesByName) {
  const fs::path steady = written({}), pulsatile = written(pulse(2));
  fs::create_directory(steady / "2000");
  fs::create_directory(pulsatile / "1.6");
  const auto refused = [](const fs::path& folder, std::optional<int> iterations, std::optional<int> cycles,
                          const std::string& part) {
    expect_refusal([&] { continue_openfoam_case(folder, iterations, cycles); }, {part});
  };
  refused(steady, 1000, std::nullopt, "has come to 2000 iterations already");
  refused(steady, 0, std::nullopt, "iterations must be in [1, 1000000]");
  refused(steady, std::nullopt, 4, "goes on by --iterations");
  refused(steady, std::nullopt, std::nullopt, "goes on by --iterations");
  refused(pulsatile, 4000, std::nullopt, "goes on by --cycles");
  refused(pulsatile, std::nullopt, 1, "has come to 1.6 s already");
  refused(pulsatile, std::nullopt, 101, "cycles must be in [1, 100]");
  refused(testing::temporary_folder("continue"), 4000, std::nullopt, "is no case of `ostia case`");
}

TEST(OpenfoamContinue, AnotherCaseIsKnownByWhatIsDifferent) {
  const fs::path folder = written({});
  OpenfoamCaseOptions other;
  other.flow.flow_ml_s = 0.1;
  EXPECT_EQ(difference_of_cases(folder, written(other)), "0/U");
  other = {};
  other.flow.blood.viscosity_mpa_s = 4.0;
  EXPECT_EQ(difference_of_cases(folder, written(other)), "constant/transportProperties");
  other = {};
  other.tolerance = 1e-5;
  EXPECT_EQ(difference_of_cases(folder, written(other)), "system/fvSolution");
  const fs::path made = testing::temporary_folder("continue") / "case";
  write_openfoam_case(vessel(geometry::straight_tube(6.2, 1.5), 0.7, 0), {}, made);
  EXPECT_NE(difference_of_cases(folder, made), "");
}

}  // namespace
}  // namespace ostia::solver
