#include "ostia/io/contour_file.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::io {
namespace {

using geometry::Contour;
using geometry::ContourSection;
using geometry::ContourSet;
using geometry::Vec3;
using ::testing::HasSubstr;

ContourSet rings(int contours, int points) {
  ContourSection section;
  section.section = "s01";
  section.vessel = "LAD";
  section.observer = "observer1";
  section.health = geometry::Health::diseased;
  for (int k = 0; k < contours; ++k) {
    Contour contour{0.5 * k, {}};
    for (int i = 0; i < points; ++i) {
      const double a = -2.0 * std::numbers::pi * i / points;
      contour.points.emplace_back(10.0 + 1.5 * std::cos(a), 1.5 * std::sin(a), 0.5 * k);
    }
    section.contours.push_back(contour);
  }
  return {{section}};
}

class ContourFile : public ::testing::Test {
 protected:
  std::filesystem::path file = ostia::testing::temporary_folder("contours") / "contours.json";
  void refused(const std::string& from, const std::string& to, const std::string& why) {
    write_contours(file, rings(2, 4));
    std::string text = core::read_file(file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    core::write_file(file, text);
    try {
      read_contours(file);
      ADD_FAILURE() << "taken with " << to;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
      EXPECT_THAT(error.what(), HasSubstr("contours.json"));
    }
  }
};

TEST_F(ContourFile, RoundTripsToAMillionthOfAMillimetre) {
  const ContourSet set = rings(3, 32);
  write_contours(file, set);
  const ContourSet back = read_contours(file);
  ASSERT_EQ(back.sections.size(), 1u);
  const ContourSection& a = set.sections[0];
  const ContourSection& b = back.sections[0];
  EXPECT_EQ(b.section, a.section);
  EXPECT_EQ(b.vessel, a.vessel);
  EXPECT_EQ(b.observer, a.observer);
  EXPECT_EQ(b.boundary, a.boundary);
  EXPECT_EQ(b.health, a.health);
  ASSERT_EQ(b.contours.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 32; ++i)
      EXPECT_LT((a.contours[k].points[i] - b.contours[k].points[i]).norm(), 1e-6);
}

TEST_F(ContourFile, BadInputIsNamed) {
  refused("\"v\":1", "\"v\":2", "v");
  refused("\"mm\"", "\"cm\"", "unit");
  refused("\"LPS\"", "\"RAS\"", "axes");
  refused("\"health\":\"diseased\"", "\"health\":\"ill\"", "health");
  refused("\"boundary\":\"lumen\"", "\"boundary\":\"edge\"", "boundary");
  refused("\"vessel\":\"LAD\",", "", "vessel");
  refused("\"s_mm\":0.5", "\"s_mm\":-0.5", "s01");
  refused("\"s_mm\":0.5", "\"s_mm\":null", "finite");
  refused("[11.5,0,0]", "[11.5,0]", "points");
  core::write_file(file, "");
  EXPECT_THROW(read_contours(file), InvalidInput);
  core::write_file(file, "{\"v\":1");
  EXPECT_THROW(read_contours(file), InvalidInput);
  EXPECT_THROW(read_contours(file.parent_path() / "none.json"), IoError);
}

/// docs/reference/contours.md, "What is refused", one by one.
TEST_F(ContourFile, EveryMemberThatIsMissingOrOfAnotherTypeIsNamed) {
  refused("\"v\":1,", "", "v: is missing");
  refused("\"unit\":\"mm\",", "", "unit: is missing");
  refused("\"axes\":\"LPS\",", "", "axes: is missing");
  refused("\"sections\":[", "\"parts\":[", "sections: is missing");
  refused("\"section\":\"s01\",", "", "sections[0].section: is missing");
  refused("\"observer\":\"observer1\",", "", "sections[0].observer: is missing");
  refused("\"boundary\":\"lumen\",", "", "sections[0].boundary: is missing");
  refused("\"health\":\"diseased\",", "", "sections[0].health: is missing");
  refused("\"contours\":[", "\"lines\":[", "sections[0].contours: is missing");
  refused("\"s_mm\":0.5,", "", "sections[0].contours[1].s_mm: is missing");
  refused("\"s_mm\":0,\"points\"", "\"s_mm\":0,\"corners\"", "sections[0].contours[0].points: is missing");
  refused("\"section\":\"s01\"", "\"section\":\"\"", "sections[0].section");
  refused("\"observer\":\"observer1\"", "\"observer\":1", "sections[0].observer");
  refused("\"s_mm\":0.5", "\"s_mm\":\"0.5\"", "sections[0].contours[1].s_mm");
  refused("[11.5,0,0]", "[11.5,\"0\",0]", "sections[0].contours[0].points");
  refused("[11.5,0,0]", "7", "sections[0].contours[0].points");
}

TEST_F(ContourFile, EveryFaultOfASectionIsNamed) {
  const auto refused_set = [&](const ContourSet& set, const std::string& why) {
    write_contours(file, set);
    try {
      read_contours(file);
      ADD_FAILURE() << "taken: " << why;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("contours.json"));
      EXPECT_THAT(error.what(), HasSubstr("sections[0].contours"));
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  };
  refused_set(rings(1, 8), "s01");
  refused_set(rings(2, 2), "s01");
  ContourSet repeated = rings(3, 8);
  repeated.sections[0].contours[1].points[3] = repeated.sections[0].contours[1].points[2];
  refused_set(repeated, "0.5");
  ContourSet standing = rings(3, 8);
  standing.sections[0].contours[2].s_mm = standing.sections[0].contours[1].s_mm;
  refused_set(standing, "s01");
  ContourSet crossing = rings(3, 8);
  std::swap(crossing.sections[0].contours[1].points[1], crossing.sections[0].contours[1].points[4]);
  refused_set(crossing, "0.5");
  ContourSet against = rings(3, 8);
  std::reverse(against.sections[0].contours[1].points.begin() + 1,
               against.sections[0].contours[1].points.end());
  refused_set(against, "s01");
}

TEST_F(ContourFile, ForeignDocumentsAreRefused) {
  for (const char* text :
       {"[]", "7", "{\"v\":1,\"unit\":\"mm\",\"axes\":\"LPS\",\"sections\":{}}", "# x y z\n1 2 3\n"}) {
    core::write_file(file, text);
    EXPECT_THROW(read_contours(file), InvalidInput) << text;
  }
}

TEST_F(ContourFile, TablesNameTheLineOrTheSection) {
  const auto refused_table = [&](const std::string& text, const std::string& why) {
    core::write_file(file, text);
    try {
      read_contour_table(file, {});
      ADD_FAILURE() << "taken: " << text;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("contours.json"));
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  };
  refused_table("# nothing but a comment\n", "empty");
  refused_table("s01 0 1 2\n", "line 1");
  refused_table("s01 0 1 2 3\ns01 0 1 two 3\n", "line 2");
  refused_table("s01 0 1 2 nan\n", "line 1");
  refused_table("s01 0 1 0 0\ns01 0 0 1 0\ns01 0 0 0 0\n", "s01");
  ContourColumns columns;
  columns.unit_mm = 0.0;
  EXPECT_THROW(read_contour_table(file, columns), InvalidInput);
}

TEST_F(ContourFile, ForeignTablesAreReadByTheirColumns) {
  std::string text = "# section s x y z in cm, RAS\n";
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 8; ++i) {
      const double a = 2.0 * std::numbers::pi * i / 8;  // the other way round: turned when read
      text += "7;" + std::to_string(0.05 * k) + ";" + std::to_string(-(1.0 + 0.15 * std::cos(a))) + ";" +
              std::to_string(-0.15 * std::sin(a)) + ";" + std::to_string(0.05 * k) + "\n";
    }
  }
  core::write_file(file, text);
  ContourColumns columns;
  columns.separator = ';';
  columns.ras = true;
  columns.unit_mm = 10.0;
  const ContourSet set = read_contour_table(file, columns);
  ASSERT_EQ(set.sections.size(), 1u);
  ASSERT_EQ(set.sections[0].contours.size(), 3u);
  const Contour& first = set.sections[0].contours[0];
  EXPECT_NEAR(first.points[0].x(), 11.5, 1e-4);
  EXPECT_GT(geometry::contour_normal(first).z(), 0.99);
  EXPECT_NEAR(set.sections[0].contours[2].s_mm, 1.0, 1e-9);
  columns.health = 9;
  EXPECT_THROW(read_contour_table(file, columns), InvalidInput);
  core::write_file(file, "");
  EXPECT_THROW(read_contour_table(file, {}), InvalidInput);
}

}  // namespace
}  // namespace ostia::io
