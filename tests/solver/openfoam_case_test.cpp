#include "ostia/solver/openfoam_case.h"

#include "solver_test_support.h"

#include "ostia/core/path_digest.h"
#include "ostia/core/task_context.h"

#include <fstream>

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;

const geometry::MixedMesh& tube() {
  static const geometry::MixedMesh mesh = vessel(geometry::straight_tube(6.0, 1.5), 0.6, 2, 0.3);
  return mesh;
}

/// An absolute new folder.
fs::path new_case() {
  return testing::temporary_folder("case") / "case";
}

/// Flow into the vessel through a patch of vectors, ml/s.
double flow_of(const std::vector<double>& velocities, const Section& section) {
  double flow = 0.0;
  for (std::size_t f = 0; f < section.facets.size(); ++f) {
    const geometry::Vec3 v(velocities[3 * f], velocities[3 * f + 1], velocities[3 * f + 2]);
    flow -= v.dot(section.area_vectors_mm2[f]);
  }
  return flow;  // m/s mm2 is ml/s
}

std::vector<double> numbers_of(const fs::path& file) {
  std::string text = core::read_file(file);
  for (char& c : text)
    if (c == '(' || c == ')') c = ' ';
  std::istringstream in(text);
  std::size_t count = 0;
  in >> count;
  std::vector<double> values;
  for (double v; in >> v;) values.push_back(v);
  EXPECT_EQ(values.size(), 3 * count);
  return values;
}

TEST(OpenfoamCase, ASteadyInletCarriesExactlyTheFlow) {
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.7;
  const fs::path folder = new_case();
  const OpenfoamCaseResult made = write_openfoam_case(tube(), options, folder);
  const Inlet& inlet = made.flow.inlets.at(0);
  const OpenfoamField velocity = read_openfoam_field(
      folder / "0" / "U", tube().tetrahedra.size() + tube().prisms.size(), facets_of(tube()));
  ASSERT_TRUE(velocity.patches.contains(inlet.name));
  EXPECT_NEAR(flow_of(velocity.patches.at(inlet.name), inlet.section), 0.7, 1e-12);
  for (const char* file :
       {"constant/polyMesh/points", "constant/polyMesh/boundary", "0/p", "constant/transportProperties",
        "constant/turbulenceProperties", "system/fvSchemes", "system/fvSolution", "system/decomposeParDict"})
    EXPECT_TRUE(fs::exists(folder / file)) << file;
  EXPECT_NE(core::read_file(folder / "system" / "controlDict").find("simpleFoam"), std::string::npos);
  EXPECT_NE((fs::status(folder / "Allrun").permissions() & fs::perms::owner_exec), fs::perms::none);
}

TEST(OpenfoamCase, APulsatileInletCarriesTheFlowAtAllTimes) {
  OpenfoamCaseOptions options;
  options.flow.waveform = builtin_waveform("coronary-left");
  options.flow.flow_ml_s = 0.6;
  options.cycles = 2;
  options.samples_per_cycle = 20;
  options.results_per_cycle = 4;
  const fs::path folder = new_case();
  const OpenfoamCaseResult made = write_openfoam_case(tube(), options, folder);
  const Inlet& inlet = made.flow.inlets.at(0);
  const fs::path data = folder / "constant" / "boundaryData" / inlet.name;
  std::size_t times = 0;
  for (const auto& entry : fs::directory_iterator(data)) {
    if (!entry.is_directory()) continue;
    ++times;
    const double time = std::stod(entry.path().filename().string());
    EXPECT_NEAR(flow_of(numbers_of(entry.path() / "U"), inlet.section), inlet.flow_ml_s(time), 1e-9) << time;
  }
  EXPECT_EQ(times, 41u);
  // The points are the facets' centres, in metres.
  const std::vector<double> points = numbers_of(data / "points");
  ASSERT_EQ(points.size(), 3 * inlet.section.centres.size());
  EXPECT_NEAR(points[4], 1e-3 * inlet.section.centres[1].y(), 1e-15);
  // A whole number of steps between results.
  const double steps = 0.8 / 4 / made.time_step_s;
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
  EXPECT_GT(steps, 2.0);
  EXPECT_NE(core::read_file(folder / "system" / "controlDict").find("pimpleFoam"), std::string::npos);
}

TEST(OpenfoamCase, IsTheSameEveryTime) {
  OpenfoamCaseOptions options;
  options.flow.outlets = OutletModel::split;
  const fs::path a = new_case(), b = new_case();
  write_openfoam_case(tube(), options, a);
  write_openfoam_case(tube(), options, b);
  EXPECT_EQ(core::sha256_of_path(a), core::sha256_of_path(b));
}

TEST(OpenfoamCase, ShearThinningBloodHasCarreausLaw) {
  OpenfoamCaseOptions options;
  options.flow.blood.rheology = Rheology::carreau;
  options.flow.blood.density_kg_m3 = 1000.0;
  const fs::path folder = new_case();
  write_openfoam_case(tube(), options, folder);
  const std::string text = core::read_file(folder / "constant" / "transportProperties");
  for (const char* part :
       {"BirdCarreau;", "nu0             5.6e-05", "nuInf           3.45e-06", "3.313", "0.3568"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(OpenfoamCase, RefusesBeforeAnythingIsWritten) {
  const auto refused = [](const geometry::MixedMesh& mesh, const OpenfoamCaseOptions& options,
                          const std::vector<std::string>& parts) {
    const fs::path folder = new_case();
    expect_refusal([&] { write_openfoam_case(mesh, options, folder); }, parts);
    EXPECT_TRUE(fs::is_empty(folder.parent_path())) << parts[0];
  };
  const auto with = [](const std::function<void(OpenfoamCaseOptions&)>& change) {
    OpenfoamCaseOptions options;
    change(options);
    return options;
  };
  refused(tube(), with([](auto& o) { o.processes = 0; }), {"processes"});
  refused(tube(), with([](auto& o) { o.iterations = 0; }), {"iterations"});
  refused(tube(), with([](auto& o) { o.tolerance = 0.0; }), {"tolerance"});
  refused(tube(), with([](auto& o) { o.cycles = 0; }), {"cycles"});
  refused(tube(), with([](auto& o) { o.samples_per_cycle = 2; }), {"samples_per_cycle"});
  refused(tube(), with([](auto& o) { o.courant = 99.0; }), {"courant"});
  refused(tube(), with([](auto& o) { o.time_step_s = -1.0; }), {"time_step_s"});
  refused(tube(), with([](auto& o) { o.flow.flow_ml_s = NAN; }), {"flow_ml_s"});
  geometry::MixedMesh walls = tube();
  for (geometry::Face& face : walls.faces) face.kind = geometry::FaceKind::wall;
  refused(walls, {}, {"no inlet"});
  geometry::MixedMesh torn = tube();
  torn.triangles.pop_back();
  torn.triangle_face_ids.pop_back();
  refused(torn, {}, {"boundary lacks it"});
}

TEST(OpenfoamCase, SaysThatOpenfoamTakesNoBlanksInAPath) {
  const fs::path folder = testing::temporary_folder("case") / "two words" / "case";
  fs::create_directory(folder.parent_path());
  const OpenfoamCaseResult made = write_openfoam_case(tube(), {}, folder);
  ASSERT_FALSE(made.warnings.empty());
  EXPECT_NE(made.warnings.back().find("blanks"), std::string::npos) << made.warnings.back();
  for (const std::string& warning : write_openfoam_case(tube(), {}, new_case()).warnings)
    EXPECT_EQ(warning.find("blanks"), std::string::npos) << warning;
}

TEST(OpenfoamCase, LeavesAFolderWithSomethingInItAlone) {
  const fs::path folder = new_case();
  fs::create_directory(folder);
  core::write_file(folder / "thesis.txt", "years of work");
  expect_refusal([&] { write_openfoam_case(tube(), {}, folder); }, {folder.string(), "holds something"});
  EXPECT_EQ(core::read_file(folder / "thesis.txt"), "years of work");
}

TEST(OpenfoamCase, CancelledItLeavesNothing) {
  const core::TaskContext task;
  task.cancel();
  const fs::path folder = new_case();
  EXPECT_THROW(write_openfoam_case(tube(), {}, folder, task), Cancelled);
  EXPECT_TRUE(fs::is_empty(folder.parent_path()));
}

}  // namespace
}  // namespace ostia::solver
