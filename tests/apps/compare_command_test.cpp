// `ostia compare`: two cases of one patient, and tables of pairs.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/image_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using CompareJson = nlohmann::json;
namespace fs = std::filesystem;

constexpr double compared_length_mm = 30.0;

/// Along z, narrowed by `share` of its diameter at 16 mm, `shift_mm` aside.
lumen::LumenModel compared_tube(double share, double shift_mm = 0.0, const std::string& name = "LAD") {
  geometry::VesselTree tree;
  geometry::Centerline axis = geometry::straight_tube(compared_length_mm, 1.5, 0.5).tubes.front().axis;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const double t = (axis.points[i].z() - 16.0) / 3.5;
    if (std::abs(t) < 1.0) axis.radius[i] *= 1.0 - 0.5 * share * (1.0 + std::cos(3.14159265358979 * t));
    axis.points[i].x() += shift_mm;
  }
  geometry::complete(axis);
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, name, {3}}};
  return lumen::model_of_tubes(tree);
}

/// A repeatability that tells 0.5 of everything.
void write_compared_table(const fs::path& file) {
  CompareJson lesion;
  for (const char* key : {"mld_mm", "mla_mm2", "stenosis_percent", "length_mm", "plaque_mm3"})
    lesion[key] = {{"sd", 0.5 / 1.96}, {"share", 0.0}};
  core::write_file(file, CompareJson{{"repeatability", {{"from", "a test"}, {"lesion", lesion}}}}.dump());
}

fs::path compared_folder() {
  const fs::path folder = temporary_folder("compare");
  session::CaseFile::create(folder / "old.ostia", compared_tube(0.3));
  session::CaseFile::create(folder / "new.ostia", compared_tube(0.6, 12.0));
  write_compared_table(folder / "table.json");
  return folder;
}

TEST(CompareCommand, TellsWhatGrew) {
  const fs::path folder = compared_folder();
  const std::vector<std::string> command{"compare", "old.ostia",       "new.ostia", "-o",
                                         "out",     "--repeatability", "table.json"};
  const Outcome made = ostia(command, {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("LAD, both: "));
  EXPECT_THAT(made.err, HasSubstr("plaque is not compared"));
  EXPECT_THAT(names_in(folder / "out"),
              ElementsAre("comparison.csv", "comparison.html", "comparison.json", "comparison.pdf", "images",
                          "images/vessel-4.png", "manifest.json"));
  const CompareJson json = CompareJson::parse(core::read_file(folder / "out" / "comparison.json"));
  ASSERT_EQ(json["lesions"].size(), 1u);
  const CompareJson& area = json["lesions"][0]["measures"]["mla_mm2"];
  EXPECT_EQ(area["verdict"], "less");
  EXPECT_NEAR(area["after"].get<double>() / area["before"].get<double>(), std::pow(0.4 / 0.7, 2), 0.08);
  EXPECT_NEAR(json["map"]["rigid"]["shift_mm"][0].get<double>(), 12.0, 1e-3);
  const Outcome again = ostia(command + std::vector<std::string>{"--json"}, {folder, ""});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("nothing to do"));
  EXPECT_EQ(CompareJson::parse(again.out), json);
}

TEST(CompareCommand, MeasuresPlaqueInTheImages) {
  const fs::path folder = temporary_folder("compare");
  for (const auto& [name, outer_mm] : {std::pair("old", 2.3), std::pair("new", 2.8)}) {
    imaging::ImageVolume image;
    image.geometry.size = {40, 40, 84};
    image.geometry.spacing = {0.4, 0.4, 0.4};
    image.geometry.origin = {-7.8, -7.8, -1.6};
    for (int z = 0; z < 84; ++z)
      for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) {
          const double rho = std::hypot(0.4 * x - 7.8, 0.4 * y - 7.8);
          const auto inside = [&](double edge) {
            return 0.5 * std::erfc((rho - edge) / (0.3 * std::sqrt(2.0)));
          };
          image.voxels.push_back(
              static_cast<std::int16_t>(std::lround(330.0 * inside(1.5) + 160.0 * inside(outer_mm) - 90.0)));
        }
    imaging::write_image(folder / (std::string(name) + ".nrrd"), image);
    session::CaseFile::create(folder / (std::string(name) + ".ostia"), compared_tube(0.0),
                              session::image_reference(folder / (std::string(name) + ".nrrd")));
  }
  const Outcome made = ostia({"compare", "old.ostia", "new.ostia", "--old-image", "old.nrrd", "--new-image",
                              "new.nrrd", "-o", "out", "--json"},
                             {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  const CompareJson json = CompareJson::parse(made.out);
  const CompareJson& plaque = json["patient"]["plaque_mm3"];
  EXPECT_GT(plaque["change"].get<double>(), 40.0);
  EXPECT_NEAR(json["vessels"][0]["measures"]["plaque_mm3"]["change"].get<double>(),
              plaque["change"].get<double>(), 1e-9);
  const Outcome wrong =
      ostia({"compare", "old.ostia", "new.ostia", "--old-image", "new.nrrd", "-o", "other"}, {folder, ""});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("new.nrrd"));
  EXPECT_FALSE(fs::exists(folder / "other"));
}

TEST(CompareCommand, RefusesWhatIsNoPair) {
  const fs::path folder = compared_folder();
  session::CaseFile::create(folder / "other.ostia", compared_tube(0.3, 0.0, "RCA"));
  session::CaseFile::create(folder / "nameless.ostia", compared_tube(0.3, 0.0, "V1"));
  core::write_file(folder / "bad.json", "{}");
  const auto refused = [&](const std::vector<std::string>& words, int code, const std::string& why) {
    const Outcome made = ostia(std::vector<std::string>{"compare", "-o", "out"} + words, {folder, ""});
    EXPECT_EQ(made.code, code) << why;
    EXPECT_THAT(made.err, HasSubstr(why));
    EXPECT_FALSE(fs::exists(folder / "out"));
  };
  refused({"old.ostia", "other.ostia"}, 3, "no vessel has the same name");
  refused({"old.ostia", "nameless.ostia"}, 3, "name the vessels");
  refused({"old.ostia"}, 2, "two cases");
  refused({"old.ostia", "new.ostia", "--repeatability", "bad.json"}, 3, "bad.json");
  refused({"old.ostia", "missing.ostia"}, 3, "missing.ostia");
  refused({"old.ostia", "new.ostia", "--map", "images"}, 3, "needs both");
}

TEST(CompareCommand, ATableOfPairsIsACohort) {
  const fs::path folder = compared_folder();
  fs::create_directory(folder / "cases");
  for (const char* name : {"old.ostia", "new.ostia"}) fs::copy(folder / name, folder / "cases" / name);
  core::write_file(
      folder / "cases" / "pairs.csv",
      "pair,old,new\nfirst,old.ostia,new.ostia\nsecond,old.ostia,old.ostia\nthird,old.ostia,gone.ostia\n");
  const Outcome made = ostia({"compare", "--pairs", "cases/pairs.csv", "-o", "out", "--json"}, {folder, ""});
  EXPECT_EQ(made.code, 4) << "one pair could not be compared";
  EXPECT_THAT(made.err, HasSubstr("third: not compared"));
  const CompareJson json = CompareJson::parse(made.out);
  EXPECT_EQ(json["pairs"], 2);
  EXPECT_EQ(json["warnings"].size(), 1u);
  EXPECT_GT(json["repeatability"]["lesion"]["mla_mm2"]["sd"].get<double>(), 0.1);
  EXPECT_TRUE(fs::exists(folder / "out" / "first" / "comparison.pdf"));
  EXPECT_TRUE(fs::exists(folder / "out" / "cohort.html"));
  // The cohort's file is a table for the next.
  const Outcome next = ostia(
      {"compare", "old.ostia", "new.ostia", "-o", "next", "--repeatability", "out/cohort.json", "--json"},
      {folder, ""});
  ASSERT_EQ(next.code, 0) << next.err;
  EXPECT_FALSE(CompareJson::parse(next.out)["lesions"][0]["measures"]["mla_mm2"]["smallest_real"].is_null());
  core::write_file(folder / "cases" / "bad.csv", "pair,old\nfirst,old.ostia\n");
  const Outcome bad = ostia({"compare", "--pairs", "cases/bad.csv", "-o", "none"}, {folder, ""});
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("no column `new`"));
}

}  // namespace
}  // namespace ostia::testing
