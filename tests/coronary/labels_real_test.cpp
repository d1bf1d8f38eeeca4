#include "shared_data.h"
#include "written_names.h"

#include "ostia/coronary/mask_tree.h"
#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

namespace ostia::coronary {
namespace {

bool is_main_vessel(const std::string& name) {
  return name == "LM" || name == "LAD" || name == "LCX" || name == "RCA";
}

/// Of the names that a reader wrote down, before these rules were made, nineteen in twenty are given.
TEST(NamesOfPatients, AreThoseThatWereWrittenDown) {
  const std::vector<testing::WrittenName> written =
      testing::written_names(std::filesystem::path(OSTIA_WRITTEN_NAMES) / "patients.csv");
  ASSERT_GT(written.size(), 100U);
  std::map<std::string, geometry::VesselTree> trees;
  int right = 0, branches = 0, branches_right = 0, wrong = 0;
  std::string faults;
  for (const testing::WrittenName& one : written) {
    if (!trees.contains(one.patient)) {
      OSTIA_REQUIRE_SHARED(file, "coronary/patient-masks/" + one.patient + ".nrrd");
      MaskTree found = mask_tree(imaging::read_labels(file).volume);
      EXPECT_TRUE(found.vessels.lie.as_given) << one.patient << ": " << found.vessels.lie.word;
      EXPECT_GT(found.vessels.lie.probability, 0.9) << one.patient;
      std::printf("%s: as given %.3f, dominance %s\n", one.patient.c_str(), found.vessels.lie.probability,
                  word(found.vessels.dominance));
      trees[one.patient] = std::move(found.vessels.tree);
    }
    const geometry::Vessel& vessel = testing::vessel_at(trees[one.patient], one.place);
    const bool good = testing::is_named(vessel.name, one), main = is_main_vessel(one.name);
    right += good ? 1 : 0;
    branches += main ? 0 : 1;
    branches_right += good && !main ? 1 : 0;
    wrong += !good && vessel.name.front() != 'V' ? 1 : 0;
    if (!good) faults += "\n" + one.patient + " " + one.name + " is " + vessel.name;
  }
  std::printf("%d of %zu places named as written, %d of %d branches, %d wrong%s\n", right, written.size(),
              branches_right, branches, wrong, faults.c_str());
  EXPECT_GE(right, 0.95 * static_cast<double>(written.size())) << faults;
  EXPECT_GE(branches_right, 0.9 * branches) << faults;
}

/// A file that is mirrored or turned without saying so.
TEST(NamesOfPatients, AMirroredMaskIsTold) {
  OSTIA_REQUIRE_SHARED(file, "coronary/patient-masks/patient001.nrrd");
  geometry::VesselTree tree = mask_tree(imaging::read_labels(file).volume).vessels.tree;
  for (int axis = 0; axis < 3; ++axis) {
    geometry::VesselTree other = tree;
    for (geometry::TreeNode& node : other.nodes) node.position[axis] *= -1.0;
    for (geometry::TreeSegment& segment : other.segments) {
      for (Vec3& point : segment.axis.points) point[axis] *= -1.0;
      geometry::complete(segment.axis);
    }
    const LabelledTree found = label_branches(other);
    EXPECT_TRUE(found.lie.word.starts_with("mirrored")) << axis << found.lie.word;
    EXPECT_GT(found.lie.probability, 0.8) << axis;
    for (const geometry::Vessel& vessel : found.tree.vessels) EXPECT_EQ(vessel.name.front(), 'V');
  }
}

}  // namespace
}  // namespace ostia::coronary
