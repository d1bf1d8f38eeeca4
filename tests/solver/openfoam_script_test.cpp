// What Allrun does about the solver: with made-up programs in OpenFOAM's place, and after a run given up.

#include "made_up_flow.h"

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;

/// A folder for the PATH with programs in the place of OpenFOAM's: checkMesh, and a simpleFoam that goes ten
/// iterations on and measures these values there.
fs::path made_up_programs(const std::map<std::string, std::string>& values) {
  const fs::path folder = testing::temporary_folder("programs");
  std::string solver =
      "#!/bin/sh\n"
      "from=$(ls | awk '/^[0-9]+$/ && $1 + 0 >= t { t = $1 + 0 } END { print t + 0 }')\n"
      "to=$((from + 10))\nmkdir $to\ncp 0/U 0/p $to\n"
      "give() {\n  mkdir -p postProcessing/$1/$from\n"
      "  echo \"$to $2\" > postProcessing/$1/$from/surfaceFieldValue.dat\n}\n";
  for (const auto& [function, value] : values) solver += "give " + function + " " + value + "\n";
  core::write_file(folder / "simpleFoam", solver);
  core::write_file(folder / "checkMesh", "#!/bin/sh\n");
  for (const char* program : {"simpleFoam", "checkMesh"})
    fs::permissions(folder / program, fs::perms::owner_exec, fs::perm_options::add);
  return folder;
}

struct Fork {
  fs::path folder;
  BoundaryFlow flow;
};

/// A case of two outlets with resistance.
Fork fork_that_resists() {
  static const geometry::MixedMesh mesh = vessel(geometry::y_junction(5.0, 5.0, 1.5, 1.2, 60.0), 0.8, 0);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  options.flow.outlets = OutletModel::resistance;
  Fork fork{testing::temporary_folder("fork") / "case", {}};
  fork.flow = write_openfoam_case(mesh, options, fork.folder).flow;
  return fork;
}

/// Runs it, from its own folder, with a solver that finds these flows, m3/s; p = R Q at the inlet and the
/// outlets where `share` of it flows.
Shell run_made_up(const Fork& fork, const std::vector<std::string>& flows) {
  std::map<std::string, std::string> values;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    const Outlet& outlet = fork.flow.outlets[i];
    values["flow_" + outlet.name] = flows[i];
    values["pressure_" + outlet.name] =
        std::to_string(outlet.resistance_pa_s_m3 / 1060.0 * outlet.share * 0.5e-6);
  }
  values["flow_" + fork.flow.inlets[0].name] = "-0.5e-6";
  values["pressure_" + fork.flow.inlets[0].name] = values["pressure_" + fork.flow.outlets[0].name];
  return shell(fork.folder, "PATH='" + made_up_programs(values).string() + "':\"$PATH\" sh Allrun");
}

std::string flow_of(const Outlet& outlet) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12e", 0.5e-6 * outlet.share);
  return text;
}

TEST(OpenfoamScript, FlowsThatStayHaveSettled) {
  const Fork fork = fork_that_resists();
  const Shell done = run_made_up(fork, {flow_of(fork.flow.outlets[0]), flow_of(fork.flow.outlets[1])});
  EXPECT_TRUE(done.good) << done.output;
  EXPECT_EQ(times_of(fork.folder).size(), 1u);
}

TEST(OpenfoamScript, AnOutletWithoutFlowHasNotSettled) {
  for (const char* none : {"0", "", "nan"}) {
    const Fork fork = fork_that_resists();
    const Shell done = run_made_up(fork, {"0.5e-6", none});
    EXPECT_FALSE(done.good) << none;
    EXPECT_NE(done.output.find("have not settled"), std::string::npos) << none << done.output;
    EXPECT_FALSE(fs::exists(fork.folder / "log.round"));
    EXPECT_EQ(core::read_file(fork.folder / "log.outlets").find("round 2"), std::string::npos) << none;
  }
}

TEST(OpenfoamRun, ValuesOfARunGivenUpAreNotTheNextOnes) {
  NEEDS_OPENFOAM();
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(6.0, 1.5), 0.8, 0);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  const fs::path folder = testing::temporary_folder("again") / "case";
  const BoundaryFlow flow = write_openfoam_case(mesh, options, folder).flow;
  const std::string function = "flow_" + flow.outlets[0].name;
  write_series(folder, function, {{1, 7.0}, {5000, 9.0}});
  const fs::path measured = folder / "postProcessing";
  fs::create_directories(measured / "residuals" / "0");
  core::write_file(measured / "residuals" / "0" / "solverInfo.dat", "# Time p_initial\n5000 0.7\n");
  fs::create_directories(measured / function / "300");  // its time folder is gone
  core::write_file(measured / function / "300" / "surfaceFieldValue.dat", "# Time v\n6000 8.0\n");
  const Shell done = shell(folder, "./Allrun");
  ASSERT_TRUE(done.good) << done.output << last_words(folder);
  const OpenfoamSeries series = read_openfoam_series(folder, function);
  EXPECT_EQ(series.rbegin()->first, times_of(folder).back().time);
  EXPECT_NEAR(series.rbegin()->second, 0.5e-6, 1e-10);
  EXPECT_LT(series.begin()->second, 1.0);
  EXPECT_LT(read_openfoam_outcome(folder, read_case_record(folder), {}).residuals.at("p"), 1e-6);
  // Continued, it keeps what was measured before.
  const Shell again = shell(folder, "./Allrun");
  ASSERT_TRUE(again.good) << again.output << last_words(folder);
  EXPECT_EQ(read_openfoam_series(folder, function).begin()->first, series.begin()->first);
}

}  // namespace
}  // namespace ostia::solver
