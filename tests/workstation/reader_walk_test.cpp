// A reader's walks through the whole window, from an opened scan to the report: on the sample's patient, and
// on two real scans that a reader would send back.

#include "kept_scan.h"
#include "shared_data.h"
#include "shell/main_window_walks.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QImage>
#include <QString>
#include <algorithm>
#include <fstream>
#include <iostream>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::wait_until;

constexpr int walk_ms = 25 * 60000, opened_ms = 600000;

/// All of it or, with $OSTIA_WALK_PART, what stands before its line "# ---".
std::string steps_of(const fs::path& walk) {
  const std::string all = core::read_file(walk);
  return std::getenv("OSTIA_WALK_PART") ? all.substr(0, all.find("# ---")) : all;
}

/// A vessel tree with walls from its image, as the search would leave it.
void make_case(const fs::path& case_file, const fs::path& state) {
  phantom::CaseOptions options;
  options.preset = phantom::Preset::small;
  const phantom::CasePlan plan = phantom::plan_case(options);
  const imaging::ImageVolume image = ostia::testing::kept_scan(plan).image;
  const fs::path image_file = case_file.parent_path() / "image.nrrd";
  imaging::write_image(image_file, image);
  const geometry::VesselTree tree = phantom::vessel_tree(plan.tree);
  const session::ImageReference reference = session::image_reference(image_file);
  session::CaseFile::create(
      case_file, lumen::model_of_walls(tree, pipeline::walls_from_image(tree, image, core::no_task())),
      reference);
  session::MachineState(state).remember_image(reference.sha256, image_file);
}

struct ReaderWalk : ::testing::Test {
  testing::Folder folder;
  testing::TestWindow test{folder / "state"};

  bool at_rest() {
    return wait_until([&] { return !test.window().jobs().any(); }, opened_ms);
  }
  /// What it looked at is left in $OSTIA_WALKED where that is set.
  void walk(const std::string& name) {
    const fs::path file = folder / name;
    core::write_file(file, steps_of(fs::path(OSTIA_WALKS) / name));
    const char* keep = std::getenv("OSTIA_WALKED");
    const fs::path out = keep ? fs::path(keep) / file.stem() : folder / "walked";
    bool ended = false;
    QString why;
    double blocked_ms = 0.0;
    begin_walk(test.window(), file, out, [&](const QString& failure) {
      why = failure;
      ended = true;
    });
    ASSERT_TRUE(wait_until([&] { return ended; }, walk_ms));
    EXPECT_EQ(why.toStdString(), "");
    int pictures = 0;
    for (const auto& one : fs::directory_iterator(out))
      if (one.path().extension() == ".png") {
        EXPECT_FALSE(QImage(QString::fromStdString(one.path().string())).isNull()) << one.path().filename();
        ++pictures;
      }
    EXPECT_GE(pictures, 3);
    std::ifstream table(out / "walk.csv");
    std::string slowest;
    for (std::string line; std::getline(table, line);) {
      const auto comma = line.rfind(',');
      const double ms = std::atof(line.c_str() + comma + 1);
      if (ms > blocked_ms) blocked_ms = ms, slowest = line;
    }
    RecordProperty("blocked_ms", static_cast<int>(blocked_ms));
    std::cout << "longest block: " << slowest << '\n';
  }
};

TEST_F(ReaderWalk, OnTheSamplesPatient) {
  make_case(folder / "sample.ostia", folder / "state");
  test.open(folder / "sample.ostia");
  walk("reader.walk");
}

TEST_F(ReaderWalk, OnADissectedAortaInWideVoxels) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  fs::copy_file(path, folder / "ct_cropped.nii.gz");
  test.window().open(folder / "ct_cropped.nii.gz");
  ASSERT_TRUE(at_rest());
  walk("dissected.walk");
}

TEST_F(ReaderWalk, OnAChestWithoutTheRoot) {
  OSTIA_REQUIRE_SHARED(path, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  fs::copy_file(path, folder / "heart-crop.nrrd");
  test.window().open(folder / "heart-crop.nrrd");
  ASSERT_TRUE(at_rest());
  walk("chest.walk");
}

}  // namespace
}  // namespace ostia::workstation
