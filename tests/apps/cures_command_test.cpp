// What a message offers to type is typed, as it is printed, for a file that provokes it.

#include "program.h"

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using geometry::TriMesh;
using geometry::Vec3;
using ::testing::HasSubstr;
using Json = nlohmann::json;

/// The words of the first `ostia ...` between backticks with `part` in it, without "ostia"; IN and OUT.vtp
/// are the files. Empty where none is offered.
std::vector<std::string> offered(const std::string& said, const std::string& part, const std::string& in,
                                 const std::string& out) {
  for (std::size_t at = said.find("`ostia "); at != std::string::npos; at = said.find("`ostia ", at + 1)) {
    const std::string command = said.substr(at + 1, said.find('`', at + 1) - at - 1);
    if (command.find(part) == std::string::npos) continue;
    std::istringstream words(command);
    std::vector<std::string> typed;
    for (std::string word; words >> word;)
      typed.push_back(word == "IN" ? in : word == "OUT.vtp" ? out : word);
    typed.erase(typed.begin());
    return typed;
  }
  return {};
}

/// Of the first "(--option value ...)" that begins so.
std::vector<std::string> option_in(const std::string& said, const std::string& option) {
  const std::size_t at = said.find(option);
  if (at == std::string::npos) return {};
  std::istringstream words(said.substr(at));
  std::string name, value;
  words >> name >> value;
  while (!value.empty() && (value.back() == ')' || value.back() == ',' || value.back() == ';'))
    value.pop_back();
  return {name, value};
}

TriMesh tube_of(double length_mm, double radius_mm) {
  return geometry::surface_of(geometry::straight_tube(length_mm, radius_mm), 0.4, true);
}

TriMesh crossing_tubes() {
  const TriMesh one = tube_of(12.0, 1.5);
  TriMesh other = one;
  for (Vec3& p : other.points) p = Vec3(p.z() - 6.0, p.x() + 0.7, p.y() + 6.0);
  return geometry::merged(one, other);
}

void expect_meshes(const std::vector<std::string>& arguments, const fs::path& folder) {
  const Outcome done = ostia(arguments, {folder, ""});
  EXPECT_EQ(done.code, 0) << done.err;
}

TEST(Cures, RepairOfWhatStrictRefuses) {
  const fs::path folder = temporary_folder("cure");
  TriMesh tube = tube_of(12.0, 1.5);
  for (std::size_t i = 0; i < 40; ++i) std::swap(tube.triangles[i][0], tube.triangles[i][1]);
  io::write_surface(folder / "turned.ply", tube);
  const Outcome refused = ostia({"mesh", "turned.ply", "-o", "out", "--strict"}, {folder, ""});
  ASSERT_EQ(refused.code, 3) << refused.err;
  const std::vector<std::string> cure = offered(refused.err, "--repair", "turned.ply", "mended.vtp");
  ASSERT_FALSE(cure.empty()) << refused.err;
  EXPECT_EQ(ostia(cure, {folder, ""}).code, 0);
  expect_meshes({"mesh", "mended.vtp", "-o", "out", "--strict", "--edge-ratio", "0.6"}, folder);
}

TEST(Cures, OfPartsThatRunThroughEachOther) {
  const fs::path folder = temporary_folder("cure");
  io::write_surface(folder / "crossing.ply", crossing_tubes());
  const Outcome refused = ostia({"mesh", "crossing.ply", "-o", "out"}, {folder, ""});
  ASSERT_EQ(refused.code, 3) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("run through each other"));
  const std::vector<std::string> cure = offered(refused.err, "--largest-part", "crossing.ply", "one.vtp");
  ASSERT_FALSE(cure.empty()) << refused.err;
  EXPECT_EQ(ostia(cure, {folder, ""}).code, 0);
  expect_meshes({"mesh", "one.vtp", "-o", "one", "--edge-ratio", "0.6"}, folder);
}

TEST(Cures, OfABlindBranchThatStaysClosed) {
  const fs::path folder = temporary_folder("cure");
  TriMesh lumen = geometry::surface_of(geometry::y_junction(14.0, 14.0, 1.8, 1.5, 60.0), 0.4, false);
  io::write_surface(folder / "y.ply", lumen);
  const auto mesh = [](const std::string& out) {
    return std::vector<std::string>{"mesh",    "y.ply",        "-o",  out,     "--source",
                                    "0,0,-12", "--edge-ratio", "0.6", "--json"};
  };
  const double reach = 11.0, side = reach * 0.5;  // along a branch at 30 degrees from the trunk's way
  const std::vector<std::string> to_one{"--target",
                                        std::to_string(side) + ",0," + std::to_string(0.866 * reach)};
  const Outcome one = ostia(mesh("one") + to_one, {folder, ""});
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_THAT(one.err, HasSubstr("stays closed"));
  const std::vector<std::string> cure = option_in(one.err, "--side-branches");
  ASSERT_EQ(cure.size(), 2u);
  const Outcome both = ostia(mesh("both") + to_one + cure, {folder, ""});
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_EQ(Json::parse(both.out)["volume"]["faces"].size(),
            Json::parse(one.out)["volume"]["faces"].size() + 1);
}

TEST(Cures, OfAUnitThatIsNotTheFiles) {
  const fs::path folder = temporary_folder("cure");
  TriMesh tube = tube_of(20.0, 1.5);
  for (Vec3& p : tube.points) p *= 0.1;
  io::write_surface(folder / "tube.ply", tube);
  const Outcome told = ostia({"mesh", "tube.ply", "-o", "cm", "--edge-ratio", "0.6"}, {folder, ""});
  EXPECT_THAT(told.err, HasSubstr("centimetres"));
  const std::vector<std::string> otherwise = option_in(told.err, "--units");
  ASSERT_EQ(otherwise, (std::vector<std::string>{"--units", "mm"}));
  const Outcome done =
      ostia(std::vector<std::string>{"mesh", "tube.ply", "-o", "mm", "--edge-ratio", "0.6"} + otherwise,
            {folder, ""});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, ::testing::Not(HasSubstr("centimetres")));
}

}  // namespace
}  // namespace ostia::testing
