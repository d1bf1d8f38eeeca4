#include "ostia/io/rotterdam_file.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/graph_file.h"

#include <gmock/gmock.h>

#include <clocale>
#include <cmath>
#include <locale>
#include <numbers>

namespace ostia::io {
namespace {

using ::testing::HasSubstr;

class RotterdamFile : public ::testing::Test {
 protected:
  std::filesystem::path file = ostia::testing::temporary_folder("rotterdam") / "reference.txt";

  template <class Call>
  void expect_refusal(const Call& call, const std::string& why, const std::string& what) {
    try {
      call();
      ADD_FAILURE() << "taken: " << what;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
      EXPECT_THAT(error.what(), HasSubstr("reference.txt"));
    }
  }
  void refused(const std::string& text, const std::string& why) {
    core::write_file(file, text);
    expect_refusal([&] { read_rotterdam_reference(file); }, why, text);
  }
  void refused_line(const std::string& text, const std::string& why) {
    core::write_file(file, text);
    expect_refusal([&] { read_rotterdam_line(file); }, why, text);
  }
};

/// A helix at steps of 0.03 mm, as long as the longest vessel of a heart.
RotterdamReference long_vessel() {
  RotterdamReference out;
  constexpr double step_mm = 0.03, bend_mm = 40.0;
  for (int i = 0; i < 7450; ++i) {
    const double s = step_mm * i, turn = s / (bend_mm * std::numbers::sqrt2);
    out.points.emplace_back(bend_mm * std::cos(turn) - 123.0, bend_mm * std::sin(turn),
                            bend_mm * turn - 987.0);
    out.radius.push_back(2.0 - 1.5 * i / 7449.0);
    out.observer_spread.push_back(0.1 + 0.05 * std::sin(0.01 * i));
  }
  return out;
}

TEST_F(RotterdamFile, RoundTrips) {
  const RotterdamReference reference{{{1.0, -2.0, 3.0}, {1.03, -2.0, 3.123456}}, {1.5, 1.25}, {0.1, 0.2}};
  write_rotterdam_reference(file, reference);
  const RotterdamReference back = read_rotterdam_reference(file);
  EXPECT_EQ(back.points, reference.points);
  EXPECT_EQ(back.radius, reference.radius);
  EXPECT_EQ(back.observer_spread, reference.observer_spread);
  write_rotterdam_line(file, reference.points);
  EXPECT_EQ(read_rotterdam_line(file), reference.points);
  write_rotterdam_point(file, reference.points[1]);
  EXPECT_EQ(read_rotterdam_point(file), reference.points[1]);
}

TEST_F(RotterdamFile, StepsOfALongVesselSurvive) {
  const RotterdamReference reference = long_vessel();
  write_rotterdam_reference(file, reference);
  const RotterdamReference back = read_rotterdam_reference(file);
  ASSERT_EQ(back.points.size(), 7450u);
  for (std::size_t i = 0; i < back.points.size(); ++i) {
    EXPECT_LT((back.points[i] - reference.points[i]).cwiseAbs().maxCoeff(), 0.51e-6);
    EXPECT_NEAR(back.radius[i], reference.radius[i], 0.51e-6);
    EXPECT_NEAR(back.observer_spread[i], reference.observer_spread[i], 0.51e-6);
    if (i == 0) continue;
    EXPECT_NEAR((back.points[i] - back.points[i - 1]).norm(), 0.03, 3e-6);
  }
  const std::string once = core::read_file(file);
  write_rotterdam_reference(file, back);
  EXPECT_EQ(core::read_file(file), once);
}

TEST_F(RotterdamFile, ReadsWhatOthersWrite) {
  core::write_file(file, "\xEF\xBB\xBF# x y z r io\r\n\r\n 1\t2   3e0 +1.5 0.1 \r\n1 2 4 1.5 0.1");
  EXPECT_EQ(read_rotterdam_reference(file).points[1], Vec3(1, 2, 4));
  core::write_file(file,
                   "\xEF\xBB\xBF"
                   "1 2 3\n4 5 6\n");
  EXPECT_EQ(read_rotterdam_line(file)[0], Vec3(1, 2, 3));
  core::write_file(file, "1 2 3 0.5\n4 5 6 0.5\n");
  EXPECT_EQ(read_rotterdam_line(file)[1], Vec3(4, 5, 6)) << "a radius may follow";
}

/// Writes numbers as German readers do, whether or not the system has that locale.
class DecimalComma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_F(RotterdamFile, TheLocaleHasNoSay) {
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // does nothing where that locale is not installed
  const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
  const std::vector<Vec3> points{{1234.5, 0.25, -3.125}, {1235.5, 0.5, -3.0}};
  write_rotterdam_line(file, points);
  const std::string text = core::read_file(file);
  const std::vector<Vec3> back = read_rotterdam_line(file);
  std::locale::global(before);
  std::setlocale(LC_ALL, c_before.c_str());
  EXPECT_EQ(text, "1234.500000 0.250000 -3.125000\n1235.500000 0.500000 -3.000000\n");
  EXPECT_EQ(back, points);
}

TEST_F(RotterdamFile, RepeatedPointsAreKeptAndCounted) {
  core::write_file(
      file, "1 2 3 1 0.1\n1 2 3 1.5 0.2\n1 2 4 1 0.3\n1 2 5 1 0.4\n1 2 5 1 0.5\n1 2 5 1 0.6\n1 2 4 2 0.7\n");
  const RotterdamReference reference = read_rotterdam_reference(file);
  EXPECT_EQ(reference.points.size(), 7u);
  EXPECT_EQ(count_repeated(reference.points), 3u);
  const RotterdamReference once = without_repeated(reference);
  EXPECT_EQ(once.points, (std::vector<Vec3>{{1, 2, 3}, {1, 2, 4}, {1, 2, 5}, {1, 2, 4}}));
  EXPECT_EQ(once.radius, (std::vector<double>{1, 1, 1, 2}));
  EXPECT_EQ(once.observer_spread, (std::vector<double>{0.1, 0.3, 0.4, 0.7}));
  core::write_file(file, "1 2 3\n1 2 3\n4 5 6\n");
  EXPECT_EQ(read_rotterdam_line(file).size(), 3u);
  EXPECT_EQ(count_repeated({}), 0u);
}

TEST_F(RotterdamFile, BadInputIsNamedWithItsLine) {
  refused("", "empty");
  refused("\n\n", "empty");
  refused("\xEF\xBB\xBF", "empty");
  refused("1 2 3 1 0.1\n", "one point");
  refused("1 2 3 1 0.1\n1 2 4 1\n", "line 2");
  refused("1 2 3 1 0.1 7\n", "line 1: has 6 columns");
  refused("1,2,3,1,0.1\n", "with blanks between them");
  refused("1 2 3 1 0.1\n1 2 4,5 1 0.1\n", "line 2: \"4,5\" is no finite number; write decimals with a point");
  refused("1 2 3 1 0.1\n\n1 2 nan 1 0.1\n", "line 3");
  refused("1 2 3 1 0.1\n1 2 inf 1 0.1\n", "line 2");
  refused("1 2 3 1 0.1\n1 2 1e999 1 0.1\n", "line 2");
  refused("1 2 3 1 0.1\n1 2 3 1 0.1\n", "all of its 2 points are at one place");
  refused("1 2 3 0 0.1\n1 2 4 1 0.1\n", "line 1: the radius must be positive");
  refused("1 2 3 1 0.1\n1 2 4 1 -1\n", "line 2: the observers' spread");
  refused("x y z r io\n1 2 3 1 0.1\n", "line 1: \"x\"");
  refused_line("1 2\n1 3\n", "line 1: has 2 columns");
  refused_line("1 2 3\n1 2 4 1\n", "line 2: has another number of columns");
  refused_line("1 2 3\n1 2 3\n1 2 3\n", "all of its 3 points are at one place");
  refused_line(std::string(5000, 'z') + " 2 3\n", "is no finite number");
  core::write_file(file, "1 2 3\n1 2 4\n");
  EXPECT_THROW(read_rotterdam_point(file), InvalidInput);
  EXPECT_THROW(read_rotterdam_line(file.parent_path() / "none.txt"), IoError);
}

TEST_F(RotterdamFile, WritersRefuseWhatReadersWouldAndKeepTheOldFile) {
  core::write_file(file, "old");
  const RotterdamReference good{{{1, 2, 3}, {1, 2, 4}}, {1.0, 1.0}, {0.1, 0.1}};
  const auto refuses = [&](const auto& change, const std::string& why) {
    RotterdamReference bad = good;
    change(bad);
    expect_refusal([&] { write_rotterdam_reference(file, bad); }, why, why);
    EXPECT_EQ(core::read_file(file), "old");
  };
  refuses([](auto& r) { r.points[1].y() = std::nan(""); }, "not finite");
  refuses([](auto& r) { r.points[1].y() = 1e300; }, "1e9 mm away");
  refuses([](auto& r) { r.points[1] = r.points[0] + Vec3(1e-8, 0, 0); }, "repeats");
  refuses([](auto& r) { r.radius[1] = 0.0; }, "the radius of point 1");
  refuses([](auto& r) { r.observer_spread[0] = 1e-9; }, "spread of point 0");
  refuses([](auto& r) { r.radius.pop_back(); }, "differ in number");
  refuses([](auto& r) { r = {}; }, "0 points");
  EXPECT_THROW(write_rotterdam_line(file, {{1, 2, 3}}), InvalidInput);
  EXPECT_THROW(write_rotterdam_point(file, Vec3(std::nan(""), 0, 0)), InvalidInput);
  EXPECT_THROW(write_rotterdam_line(file / "a.txt", good.points), IoError);
  EXPECT_EQ(core::read_file(file), "old");
}

TEST_F(RotterdamFile, LinesHaveRadiiWhereColumnsSaySo) {
  core::write_file(file, "0 0 0 2.5 1\n0 0 0 2.5 1\n0 0 4 2 1\n0 3 8 1.5 1\n");
  ASSERT_TRUE(is_rotterdam_line(file));
  EXPECT_TRUE(is_graph_file(file));
  const LoadedGraph read = read_graph(file);
  ASSERT_EQ(read.graph.edges.size(), 2u);
  EXPECT_EQ(read.graph.edges[0].radius_from, 2.5);
  EXPECT_EQ(read.graph.edges[1].radius_to, 1.5);
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_THAT(read.warnings[0], HasSubstr("1 points that repeat"));
  const geometry::VesselTree tree = read_centerlines(file);
  ASSERT_EQ(tree.segments.size(), 1u);
  EXPECT_EQ(tree.segments[0].axis.points.back(), Vec3(0, 3, 8));
  EXPECT_EQ(tree.segments[0].axis.points.size(), 3u);
  EXPECT_EQ(tree.segments[0].axis.radius.back(), 1.5);
  EXPECT_EQ(read_rotterdam_line(file).size(), 4u) << "a reference is taken as a result, too";
  core::write_file(file, "0 0 0 2\n0 0 4 1\n");
  EXPECT_EQ(read_graph(file).graph.edges[0].radius_to, 1.0);
  core::write_file(file, "0 0 0\n0 0 4\n");
  EXPECT_TRUE(std::isnan(read_graph(file).graph.edges[0].radius_to));
  expect_refusal([&] { read_centerlines(file); }, "no radius", "three columns");
  core::write_file(file, "0 0 0 2 1\n0 0 4 -1 1\n");
  expect_refusal([&] { read_graph(file); }, "line 2: the radius", "a negative radius");
}

TEST_F(RotterdamFile, OtherTextsAreNoLines) {
  for (const char* text :
       {"", "1 2 3\n", "1 2\n3 4\n", "to whom it may\nconcern x y\n", "1 2 3 4 5 6\n1 2 3 4 5 6\n"}) {
    core::write_file(file, text);
    EXPECT_FALSE(is_rotterdam_line(file)) << text;
    EXPECT_FALSE(is_graph_file(file)) << text;
  }
  EXPECT_FALSE(is_rotterdam_line(file.parent_path() / "nowhere.txt"));
}

}  // namespace
}  // namespace ostia::io
