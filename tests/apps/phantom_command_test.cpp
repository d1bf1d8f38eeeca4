// `ostia phantom`: what it leaves, again, interrupted, and what it refuses.

#include "program.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>

namespace ostia::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using Json = nlohmann::json;

const std::vector<std::string> tiny{"phantom",    "--preset",          "tiny", "-o", "out", "--formats",
                                    "nrrd,dicom", "--surface-spacing", "1"};

TEST(PhantomCommand, LeavesAWholeFolderAndIsNotDoneTwice) {
  const auto folder = temporary_folder("phantom");
  const Outcome first = ostia(tiny + std::vector<std::string>{"--json"}, {folder, ""});
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(names_in(folder / "out"),
              IsSupersetOf({"manifest.json", "suite.json", "dataset00/case.json", "dataset00/contours.json",
                            "dataset00/image00.nrrd", "dataset00/labels.nrrd", "dataset00/lumen.vtp",
                            "dataset00/wall.vtp", "dataset00/centerlines.vtp", "dataset00/report.html",
                            "dataset00/report/planes.png", "dataset00/report/tree.png",
                            "dataset00/dicom/CT0001.dcm"}));
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "dataset00" / "image00.mhd"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  EXPECT_EQ(Json::parse(first.out), Json::parse(core::read_file(folder / "out" / "suite.json")));
  const std::string manifest = core::read_file(folder / "out" / "manifest.json");
  for (const auto& [name, digest] : Json::parse(manifest)["outputs"].items())
    EXPECT_EQ(core::sha256_file(folder / "out" / name), digest) << name;

  const Outcome again = ostia(tiny, {folder, ""});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("nothing to do"));
  EXPECT_EQ(core::read_file(folder / "out" / "manifest.json"), manifest);

  // The program's other commands read it.
  const Outcome info = ostia({"info", "out/dataset00/dicom", "--json"}, {folder, ""});
  EXPECT_EQ(info.code, 0) << info.err;
}

TEST(PhantomCommand, OtherParametersMakeItAnew) {
  const auto folder = temporary_folder("phantom");
  const std::vector<std::string> truth{"phantom",      "--preset",          "tiny", "-o",         "out",
                                       "--truth-only", "--surface-spacing", "1",    "--no-report"};
  ASSERT_EQ(ostia(truth, {folder, ""}).code, 0);
  const std::string one = core::read_file(folder / "out" / "dataset00" / "contours.json");
  ASSERT_EQ(ostia(truth + std::vector<std::string>{"--seed", "5", "--cases", "2"}, {folder, ""}).code, 0);
  EXPECT_NE(core::read_file(folder / "out" / "dataset00" / "contours.json"), one);
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "dataset01" / "case.json"));
}

TEST(PhantomCommand, RealScannersAreAskedForByNameAndWrittenDown) {
  const auto folder = temporary_folder("phantom");
  const std::vector<std::string> truth{"phantom",      "--preset",          "tiny", "-o",         "out",
                                       "--truth-only", "--surface-spacing", "1",    "--no-report"};
  const Outcome made = ostia(truth + std::vector<std::string>{"--scanner", "measured", "--realism",
                                                              "tail=0.1,clips=3", "--noise", "20", "--json"},
                             {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  const Json scan = Json::parse(made.out)["parameters"]["scan"];
  EXPECT_EQ(scan["noise_hu"], 20.0);
  EXPECT_EQ(scan["realism"]["tail"], 0.1);
  EXPECT_EQ(scan["realism"]["clips"], 3);
  EXPECT_GT(scan["realism"]["noise_structure"], 0.0);  // as measured
  EXPECT_FALSE(scan["realism"].contains("half_scan_motion_mm"));
  const auto refused = [&](const std::string& given) {
    const Outcome none = ostia(truth + std::vector<std::string>{"--realism", given}, {folder, ""});
    EXPECT_EQ(none.code, 2) << given;
    return none.err;
  };
  EXPECT_THAT(refused("snow=1"), AllOf(HasSubstr("snow"), HasSubstr("undershoot")));
  EXPECT_THAT(refused("tail=much"), HasSubstr("tail=0.1"));
  EXPECT_THAT(refused("tail"), HasSubstr("tail=0.1"));
  EXPECT_THAT(refused("clips=1,tail=7"), HasSubstr("[0.000000, 0.400000]"));
}

TEST(PhantomCommand, PhasesAreReadByWhatComparesMotions) {
  const auto folder = temporary_folder("phantom");
  const Outcome made = ostia({"phantom", "--preset", "tiny", "-o", "out", "--phases", "2", "--truth-only",
                              "--no-report", "--surface-spacing", "1"},
                             {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("displacement"));
  EXPECT_THAT(
      names_in(folder / "out" / "dataset00"),
      IsSupersetOf({"heartbeat.json", "motion.json", "ecg.hea", "ecg.atr", "lumen.vtp", "lumen/phase-50.vtp",
                    "phase-00/lumen.vtp", "phase-50/centerlines.vtp", "phase-50/contours.json"}));
  for (const char* name : {"lumen", "motion.json"}) {
    const std::string path = std::string("out/dataset00/") + name;
    const Outcome same = ostia({"evaluate", "motion", path, path, "--json"}, {folder, ""});
    ASSERT_EQ(same.code, 0) << same.err;
    const Json figures = Json::parse(same.out);
    EXPECT_EQ(figures["phases"].size(), 2u);
    EXPECT_LT(figures[std::string(name) == "lumen" ? "msd_mm" : "mean_mm"].get<double>(), 1e-9);
  }
}

TEST(PhantomCommand, WrongUsageIsTwoAndLeavesNothing) {
  const std::vector<std::vector<std::string>> wrong{{"phantom"},
                                                    {"phantom", "-o", "out", "--preset", "huge"},
                                                    {"phantom", "-o", "out", "--cases", "0"},
                                                    {"phantom", "-o", "out", "--phases", "0"},
                                                    {"phantom", "-o", "out", "--phases", "101"},
                                                    {"phantom", "-o", "out", "--formats", "nifti"},
                                                    {"phantom", "-o", "out", "--noise", "-3"},
                                                    {"phantom", "-o", "out", "--contour-points", "2"}};
  for (const auto& words : wrong) {
    const auto folder = temporary_folder("phantom");
    const Outcome done = ostia(words, {folder, ""});
    EXPECT_EQ(done.code, 2) << words.back() << ": " << done.err;
    EXPECT_THAT(names_in(folder), IsEmpty());
  }
  const Outcome phases = ostia({"phantom", "-o", "out", "--phases", "101"});
  EXPECT_THAT(phases.err, HasSubstr("to 100 phases"));
}

TEST(PhantomCommand, AFolderWithOtherThingsIsNotTouched) {
  const auto folder = temporary_folder("phantom");
  std::filesystem::create_directory(folder / "out");
  core::write_file(folder / "out" / "thesis.txt", "years of work");
  const Outcome done = ostia(tiny, {folder, ""});
  EXPECT_EQ(done.code, 3) << done.err;
  EXPECT_EQ(core::read_file(folder / "out" / "thesis.txt"), "years of work");
  EXPECT_EQ(ostia({"phantom", "--preset", "tiny", "-o", "out/thesis.txt/out"}, {folder, ""}).code, 3);
}

TEST(PhantomCommand, InterruptedItStopsSoonAndLeavesNothing) {
  for (const double seconds : {0.3, 1.5}) {
    const auto folder = temporary_folder("interrupted");
    double to_end = 0.0;
    const Outcome done =
        interrupted({"phantom", "--preset", "small", "-o", "out"}, {folder, ""}, SIGINT, seconds, to_end);
    if (done.code == 0) continue;  // a fast machine
    EXPECT_EQ(done.code, 130) << "after " << seconds << " s: " << done.err;
    EXPECT_LT(to_end, 10.0) << "after " << seconds << " s";  // one second is meant; machines may be busy
    EXPECT_THAT(names_in(folder), IsEmpty()) << "after " << seconds << " s";
  }
}

}  // namespace
}  // namespace ostia::testing
