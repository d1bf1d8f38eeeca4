// Outlets of a pulsatile case: tables of one cycle, and Windkessels that are coupled from cycle to cycle.

#include "made_up_flow.h"

#include "ostia/solver/case_record.h"

#include <gmock/gmock.h>

#include <array>
#include <complex>
#include <sstream>

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double period = 0.8, mean_ml_s = 0.5, swing = 0.6;
constexpr int samples = 200;
/// Kinematic, 1 / m: of 30 mm of a vessel 3 mm wide.
constexpr double inertia = 4000.0;

const geometry::MixedMesh& fork_mesh() {
  static const geometry::MixedMesh mesh = vessel(geometry::y_junction(5.0, 5.0, 1.5, 1.2, 60.0), 0.9, 0);
  return mesh;
}

/// 0.5 (1 + 0.6 cos) ml/s against 2 mmHg s / ml and 0.2 ml / mmHg: all parts of the impedance count.
OpenfoamCaseOptions windkessels() {
  OpenfoamCaseOptions options;
  FlowWaveform wave;
  wave.period_s = period;
  for (int i = 0; i < samples; ++i) {
    wave.time_s.push_back(period * i / samples);
    wave.flow_ml_s.push_back(mean_ml_s * (1.0 + swing * std::cos(2.0 * std::numbers::pi * i / samples)));
  }
  options.flow.waveform = wave;
  options.flow.outlets = OutletModel::resistance;
  options.flow.total_resistance_mmhg_s_ml = 2.0;
  options.total_compliance_ml_mmhg = 0.2;
  return options;
}

/// A model of resistances in the place of pimpleFoam's: outlet 1 hangs on the inlet by `r1`, outlet 2 by `r2`
/// (kinematic, 1 / (m s)), with inertia; flows and the first outlet's pressure are those of the tables.
fs::path made_up_network(const BoundaryFlow& flow, double r1, double r2) {
  const fs::path folder = testing::temporary_folder("programs");
  std::ostringstream text;
  text << "#!/bin/sh\n"
          "from=$(ls | awk '/^[0-9][0-9.]*$/ && $1 + 0 >= t { t = $1 + 0; n = $1 } END { print n }')\n"
          "end=$(awk '/^endTime/ { sub(\";\", \"\", $2); print $2 }' system/controlDict)\n"
          "mkdir -p \"$end\"; cp 0/U 0/p \"$end\"\n"
          "for f in flow pressure; do for e in "
       << flow.inlets[0].name << " " << flow.outlets[0].name << " " << flow.outlets[1].name
       << "; do mkdir -p postProcessing/${f}_$e/$from; done; done\n"
          "awk -v from=\"$from\" -v end=\"$end\" -v inlet="
       << flow.inlets[0].name << " -v one=" << flow.outlets[0].name << " -v two=" << flow.outlets[1].name
       << " -v r1=" << r1 << " -v r2=" << r2 << " -v l=" << inertia
       << " '\n"
          "function load(file, v,    line, p, n) { n = 0\n"
          "  while ((getline line < file) > 0) { gsub(/[()]/, \" \", line); if (split(line, p, \" \") == 2) "
          "v[n++] = p[2] } }\n"
          "function at(v, t,    x, i) { x = (t / 0.8 - int(t / 0.8 + 1e-9)) * 100; if (x < 0) x = 0\n"
          "  i = int(x); return v[i] + (v[i + 1] - v[i]) * (x - i) }\n"
          "function put(what, name, t, v) { print t, v > (\"postProcessing/\" what \"_\" name \"/\" from "
          "\"/surfaceFieldValue.dat\") }\n"
          "BEGIN {\n"
          "  load(\"constant/outletTables/\" two \".flow\", q); load(\"constant/outletTables/\" one "
          "\".pressure\", p)\n"
          "  for (i = 1; i <= 400; i++) {\n"
          "    t = from + (end - from) * i / 400; h = 0.008\n"
          "    whole = 0.5e-6 * (1 + 0.6 * cos(2 * 3.14159265358979 * t / 0.8))\n"
          "    rise = -0.5e-6 * 0.6 * 2 * 3.14159265358979 / 0.8 * sin(2 * 3.14159265358979 * t / 0.8)\n"
          "    turn2 = (at(q, t + h + 0.8) - at(q, t - h + 0.8)) / (2 * h); turn1 = rise - turn2\n"
          "    q2 = at(q, t); q1 = whole - q2; p1 = at(p, t); above = p1 + r1 * q1 + l * turn1\n"
          "    put(\"flow\", inlet, t, -whole); put(\"pressure\", inlet, t, above)\n"
          "    put(\"flow\", one, t, q1); put(\"pressure\", one, t, p1)\n"
          "    put(\"flow\", two, t, q2); put(\"pressure\", two, t, above - r2 * q2 - l * turn2)\n"
          "  }\n}'\n";
  core::write_file(folder / "pimpleFoam", text.str());
  core::write_file(folder / "checkMesh", "#!/bin/sh\n");
  for (const char* program : {"pimpleFoam", "checkMesh"})
    fs::permissions(folder / program, fs::perms::owner_exec, fs::perm_options::add);
  return folder;
}

/// The k-th harmonic of a series over its last cycle.
std::complex<double> harmonic(const fs::path& folder, const std::string& function, int k, double end) {
  const OpenfoamSeries series = read_openfoam_series(folder, function);
  std::complex<double> sum = 0.0;
  int count = 0;
  for (auto at = series.upper_bound(end - period * (1.0 - 1e-9)); at != series.end(); ++at, ++count)
    sum += at->second * std::polar(1.0, -2.0 * std::numbers::pi * k * at->first / period);
  return sum / static_cast<double>(count);
}

TEST(OpenfoamOutlets, WindkesselsHaveTheImpedanceOfTheirParts) {
  const Windkessel w{1.0, 9.0, 0.1};
  EXPECT_NEAR(std::abs(w.impedance(0.0) - 10.0), 0.0, 1e-12);
  // 1 + 9 / (1 + 0.9 i) at 1 / s.
  EXPECT_NEAR(std::abs(w.impedance(1.0) - (1.0 + 9.0 / std::complex<double>(1.0, 0.9))), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(w.impedance(1e9) - 1.0), 0.0, 1e-6);
  const BoundaryFlow flow = boundary_flow(fork_mesh(), windkessels().flow);
  double conductance = 0.0, compliance = 0.0;
  for (const Outlet& outlet : flow.outlets) {
    const Windkessel own = windkessel_of(outlet, 0.2);
    EXPECT_NEAR(own.proximal_pa_s_m3, 0.09 * outlet.resistance_pa_s_m3, 1e-6 * outlet.resistance_pa_s_m3);
    conductance += 1.0 / (own.proximal_pa_s_m3 + own.distal_pa_s_m3);
    compliance += own.compliance_m3_pa;
  }
  EXPECT_NEAR(1.0 / conductance, 2.0 * 133.322e6, 1e3);
  EXPECT_NEAR(compliance, 0.2e-6 / 133.322, 1e-13);
}

TEST(OpenfoamOutlets, TheirFlowsOverTheCycleAreTablesThatAreRepeated) {
  OpenfoamCaseOptions options = windkessels();
  options.flow.outlets = OutletModel::split;
  options.flow.total_resistance_mmhg_s_ml.reset();
  options.total_compliance_ml_mmhg.reset();
  const fs::path folder = testing::temporary_folder("tables") / "case";
  const BoundaryFlow flow = write_openfoam_case(fork_mesh(), options, folder).flow;
  EXPECT_THAT(core::read_file(folder / "0/U"), HasSubstr("outOfBounds     repeat;"));
  EXPECT_FALSE(fs::exists(folder / "constant/outletTables" / (flow.outlets[0].name + ".flow")));
  const std::string table =
      core::read_file(folder / "constant/outletTables" / (flow.outlets[1].name + ".flow"));
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "(");
  std::getline(lines, line);
  char open = 0;
  double time = -1.0, value = 0.0;
  std::istringstream(line) >> open >> time >> value;
  EXPECT_DOUBLE_EQ(time, 0.0);
  EXPECT_NEAR(value, 1e-6 * flow.outlets[1].share * flow.flow_ml_s(0.0), 1e-15);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 103);  // 100 samples, the first again, brackets
}

TEST(OpenfoamOutlets, AreCoupledWithTheModelFromCycleToCycle) {
  OpenfoamCaseOptions options = windkessels();
  options.cycles = 8;  // this network settles by a fifth a cycle
  const fs::path folder = testing::temporary_folder("coupled") / "case";
  const BoundaryFlow flow = write_openfoam_case(fork_mesh(), options, folder).flow;
  // The second branch resists a half of what its outlet does, the first nearly nothing.
  const double own = flow.outlets[1].resistance_pa_s_m3 / 1060.0;
  const fs::path programs = made_up_network(flow, 0.01 * own, 0.5 * own);
  const Shell done = shell(folder, "PATH='" + programs.string() + "':\"$PATH\" sh Allrun");
  EXPECT_TRUE(done.good) << done.output << shell(folder, "cat log.*").output;
  const double end = 8.0 * period;
  for (std::size_t i = 0; i < 2; ++i) {
    const Windkessel w = windkessel_of(flow.outlets[i], 0.2);
    for (int k = 0; k <= 2; ++k) {
      const std::complex<double> q = harmonic(folder, "flow_" + flow.outlets[i].name, k, end),
                                 p = 1060.0 * harmonic(folder, "pressure_" + flow.outlets[i].name, k, end);
      if (k == 2) {
        EXPECT_LT(std::abs(q), 1e-3 * mean_ml_s * 1e-6);
        continue;
      }
      const std::complex<double> z = w.impedance(2.0 * std::numbers::pi * k / period);
      EXPECT_LT(std::abs(p / q / z - 1.0), 5e-3) << flow.outlets[i].name << " " << k;
    }
  }
  const std::complex<double> q1 = harmonic(folder, "flow_" + flow.outlets[0].name, 0, end),
                             q2 = harmonic(folder, "flow_" + flow.outlets[1].name, 0, end);
  EXPECT_NEAR((q1 + q2).real(), 1e-6 * mean_ml_s, 1e-10);
  // Means go as 1 / (R + r).
  const double r1 = flow.outlets[0].resistance_pa_s_m3 / 1060.0;
  EXPECT_NEAR(q1.real() / q2.real(), 1.5 * own / (r1 + 0.01 * own), 5e-3 * q1.real() / q2.real());
  EXPECT_THAT(core::read_file(folder / "system/controlDict"), HasSubstr("endTime         6.4;"));
  EXPECT_THAT(core::read_file(folder / "log.outlets"), HasSubstr("cycle 8, to 6.4 s"));

  // Run again: there is nothing to do, and it is as well as it was.
  EXPECT_TRUE(shell(folder, "PATH='" + programs.string() + "':\"$PATH\" sh Allrun").good);
  EXPECT_EQ(times_of(folder).size(), 8u);
}

TEST(OpenfoamOutlets, ACycleIsNotEnough) {
  OpenfoamCaseOptions options = windkessels();
  options.cycles = 1;
  const fs::path folder = testing::temporary_folder("coupled") / "case";
  const BoundaryFlow flow = write_openfoam_case(fork_mesh(), options, folder).flow;
  const double own = flow.outlets[1].resistance_pa_s_m3 / 1060.0;
  const Shell done = shell(
      folder, "PATH='" + made_up_network(flow, 0.01 * own, 0.5 * own).string() + "':\"$PATH\" sh Allrun");
  EXPECT_FALSE(done.good);
  EXPECT_THAT(done.output, HasSubstr("have not settled"));
}

TEST(OpenfoamOutlets, AComplianceWantsAPulseAndResistances) {
  const auto refused = [](const std::function<void(OpenfoamCaseOptions&)>& change, const std::string& part) {
    OpenfoamCaseOptions options = windkessels();
    change(options);
    expect_refusal([&] { validate(options); }, {part});
  };
  refused([](auto& o) { o.flow.waveform.reset(); }, "give a waveform");
  refused([](auto& o) { o.total_compliance_ml_mmhg = 0.0; }, "total_compliance_ml_mmhg");
  refused(
      [](auto& o) {
        o.flow.outlets = OutletModel::split;
        o.flow.total_resistance_mmhg_s_ml.reset();
      },
      "outlets with resistance");
  const fs::path folder = testing::temporary_folder("record") / "case";
  write_openfoam_case(fork_mesh(), windkessels(), folder);
  const CaseRecord record = read_case_record(folder);
  EXPECT_EQ(record.compliance_m3_pa.size(), 2u);
}

}  // namespace
}  // namespace ostia::solver
