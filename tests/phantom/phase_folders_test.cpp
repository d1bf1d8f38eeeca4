#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/wfdb_file.h"
#include "ostia/phantom/case_folder.h"
#include "ostia/phantom/moving_case.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <map>
#include <thread>

namespace ostia::phantom {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

using ::testing::HasSubstr;

SuiteOptions moving(int phases) {
  SuiteOptions options;
  options.first.preset = Preset::tiny;
  options.first.surface_spacing_mm = 1.0;
  options.first.contours.points = 16;
  options.first.scan.supersampling = 1;
  options.mhd = options.dicom = false;
  options.report = false;
  options.truth_only = true;
  options.phases = phases;
  return options;
}

std::map<std::string, std::string> phase_folders_digests(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      out[fs::relative(entry.path(), folder).string()] = core::sha256_file(entry.path());
  return out;
}

TEST(PhaseFolders, HoldTheTruthOfEachPhaseWithEveryPointFollowed) {
  const fs::path folder = testing::temporary_folder("phases") / "suite";
  const SuiteOptions options = moving(8);
  const SuiteRecord record = write_suite(folder, options, {});
  const fs::path at = folder / "dataset00";
  const CasePlan plan = plan_case(options.first);
  const Heartbeat beat = heartbeat_of(plan);
  const geometry::TriMesh still = io::read_surface(at / "lumen.vtp").surface.mesh;
  const geometry::ContourSet contours = io::read_contours(at / "contours.json");
  for (const double percent : phase_percents(8)) {
    const fs::path of = at / phase_name(percent);
    const BeatPhase phase = beat.phase(percent);
    const geometry::TriMesh lumen = io::read_surface(of / "lumen.vtp").surface.mesh;
    ASSERT_EQ(lumen.triangles, still.triangles) << percent;
    double off = 0.0;
    for (std::size_t i = 0; i < lumen.points.size(); ++i)
      off = std::max(off, (lumen.points[i] - phase.at(still.points[i])).norm());
    EXPECT_LT(off, 1e-9) << percent;
    EXPECT_EQ(core::sha256_file(of / "lumen.vtp"),
              core::sha256_file(at / "lumen" / (phase_name(percent) + ".vtp")));
    EXPECT_EQ(io::read_centerlines(of / "centerlines.vtp").vessels.size(),
              vessel_tree(plan.tree).vessels.size());
    const geometry::ContourSet now = io::read_contours(of / "contours.json");
    ASSERT_FALSE(now.sections.empty());
    EXPECT_EQ(now.sections.front().observer, "truth");
    EXPECT_LT(
        (now.sections[0].contours[0].points[3] - phase.at(contours.sections[0].contours[0].points[3])).norm(),
        2e-6);
    const ChallengeVessel& first = plan.challenge.vessels.front();
    const io::RotterdamReference line =
        io::read_rotterdam_reference(of / ("vessel" + std::to_string(first.number)) / "reference.txt");
    EXPECT_LT((line.points[9] - phase.at(first.reference.points[9])).norm(), 1e-4);
    EXPECT_FALSE(fs::exists(of / "image00.nrrd"));
  }
  EXPECT_EQ(core::sha256_file(at / "phase-75" / "lumen.vtp"), core::sha256_file(at / "lumen.vtp"));
  EXPECT_EQ(core::sha256_file(at / "phase-75" / "centerlines.vtp"),
            core::sha256_file(at / "centerlines.vtp"));
  ASSERT_EQ(record.cases[0].motion.size(), 4u);
}

TEST(PhaseFolders, SayThePhasesTheBeatAndTheElectrocardiogram) {
  const fs::path folder = testing::temporary_folder("phases") / "suite";
  const SuiteRecord record = write_suite(folder, moving(3), {});
  const fs::path at = folder / "dataset00";
  const Json facts = Json::parse(core::read_file(at / "case.json"));
  ASSERT_EQ(facts["phases"].size(), 3u);
  EXPECT_EQ(facts["phases"][1]["folder"], "phase-33");
  EXPECT_EQ(facts["phases"][1]["image"], nullptr);
  EXPECT_NEAR(facts["phases"][1]["percent"].get<double>(), 100.0 / 3.0, 1e-6);
  const Json beat = Json::parse(core::read_file(at / "heartbeat.json"));
  EXPECT_EQ(beat["template_percent"], 75.0);
  EXPECT_NEAR(beat["phases"][2]["trigger_ms"].get<double>(), beat["rr_ms"].get<double>() * 2.0 / 3.0, 1e-3);
  const Json suite = Json::parse(core::read_file(folder / "suite.json"));
  EXPECT_EQ(suite["parameters"]["phases"], 3);
  EXPECT_EQ(suite["cases"][0]["motion"], beat["vessels"]);
  EXPECT_EQ(beat["vessels"][0]["vessel"], record.cases[0].motion[0].vessel);
  const Json motion = Json::parse(core::read_file(at / "motion.json"));
  const CasePlan plan = plan_case(moving(3).first);
  const std::vector<Vec3> points = axis_points(plan.tree);
  ASSERT_EQ(motion["phases"].size(), 3u);
  ASSERT_EQ(motion["phases"][1]["points"].size(), points.size());
  const Vec3 there = heartbeat_of(plan).at(points[20], 100.0 / 3.0);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(motion["phases"][1]["points"][20][axis].get<double>(), there[axis], 1e-6);
  const io::WfdbRecord ecg = io::read_wfdb(at / "ecg.hea");
  EXPECT_EQ(ecg.record.samples(), 21600u);
  EXPECT_EQ(ecg.record.samples_per_second, 360.0);
  EXPECT_NEAR(static_cast<double>(io::read_wfdb_beats(at / "ecg.atr").size()),
              beat["heart_rate_per_min"].get<double>(), 3.0);
}

TEST(PhaseFolders, ACaseThatBeatsIsAtRestTheStillCase) {
  const fs::path folder = testing::temporary_folder("phases");
  write_suite(folder / "beating", moving(2), {});
  write_suite(folder / "still", moving(1), {});
  std::map<std::string, std::string> beating = phase_folders_digests(folder / "beating");
  std::size_t files = 0;
  for (const auto& [name, digest] : phase_folders_digests(folder / "still")) {
    EXPECT_EQ(name.find("phase-"), std::string::npos) << name;
    for (const char* other : {"heartbeat.json", "motion.json", "ecg.hea"})
      EXPECT_EQ(name.find(other), std::string::npos) << name;
    ++files;
    if (name.ends_with("case.json") || name == "suite.json") continue;
    EXPECT_EQ(beating[name], digest) << name;
  }
  EXPECT_GT(files, 8u);
  const Json still = Json::parse(core::read_file(folder / "still" / "dataset00" / "case.json"));
  EXPECT_EQ(still["phases"], Json::parse(R"([{"image": null, "percent": null}])"));
  const Json suite = Json::parse(core::read_file(folder / "still" / "suite.json"));
  EXPECT_EQ(suite["parameters"]["phases"], 1);
  EXPECT_FALSE(suite["cases"][0].contains("motion"));
}

TEST(PhaseFolders, ImagesAreInThePhasesAndTheSameForAnyNumberOfThreads) {
  const fs::path folder = testing::temporary_folder("phases");
  SuiteOptions options = moving(2);
  options.truth_only = false;
  options.nrrd = false;
  options.dicom = true;
  core::set_max_threads(1);
  write_suite(folder / "one", options, {});
  core::set_max_threads(2);
  write_suite(folder / "two", options, {});
  core::set_max_threads(0);
  const auto made = phase_folders_digests(folder / "two");
  EXPECT_EQ(phase_folders_digests(folder / "one"), made);
  EXPECT_EQ(made.count("dataset00/phase-50/dicom/CT0001.dcm"), 1u);
  EXPECT_EQ(made.count("dataset00/phase-00/labels.nrrd"), 1u);
  EXPECT_EQ(made.count("dataset00/labels.nrrd"), 0u);
  EXPECT_NE(made.at("dataset00/phase-50/labels.nrrd"), made.at("dataset00/phase-00/labels.nrrd"));
  const Json facts = Json::parse(core::read_file(folder / "two" / "dataset00" / "case.json"));
  EXPECT_EQ(facts["phases"][1]["image"], "phase-50/image00");
}

TEST(PhaseFolders, CancelledTheyLeaveNothing) {
  const fs::path folder = testing::temporary_folder("cancelled");
  for (const double share : {0.1, 0.5}) {
    const core::TaskContext during;
    std::thread user([&] {
      while (during.progress() < share) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      during.cancel();
    });
    EXPECT_THROW(write_suite(folder / "suite", moving(20), {}, during), Cancelled);
    user.join();
    EXPECT_TRUE(fs::is_empty(folder));
  }
}

TEST(PhaseFolders, OtherNumbersOfPhasesAreRefused) {
  const fs::path folder = testing::temporary_folder("bad") / "suite";
  for (const int bad : {0, -3, 101}) {
    EXPECT_THROW(write_suite(folder, moving(bad), {}), InvalidInput);
    EXPECT_FALSE(fs::exists(folder));
  }
}

}  // namespace
}  // namespace ostia::phantom
