// A reader's walks through the whole window, from an opened scan to the report: on the sample's patient, and
// on two real scans that a reader would send back.

#include "sample_patient.h"
#include "shared_data.h"
#include "shell/main_window_walks.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/session/machine_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QImage>
#include <QString>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::wait_until;

constexpr int walk_ms = 25 * 60000;

/// Lines of a walk that are other ones on another scan; empty: left out there.
using OtherLines = std::map<std::string, std::string>;

/// Throws std::runtime_error for a line that the walk has not.
std::string with_lines(const std::string& walk, const OtherLines& others) {
  std::map<std::string, int> met;
  std::string all;
  std::istringstream lines(walk);
  for (std::string line; std::getline(lines, line);) {
    const auto other = others.find(line);
    if (other != others.end()) ++met[line];
    const std::string& now = other == others.end() ? line : other->second;
    if (other == others.end() || !now.empty()) all += now + '\n';
  }
  if (met.size() != others.size()) throw std::runtime_error("the walk has other lines by now");
  return all;
}

/// All of it or, with $OSTIA_WALK_PART, what stands before its line "# ---".
std::string steps_of(const fs::path& walk, const OtherLines& others) {
  const std::string all = with_lines(core::read_file(walk), others);
  return std::getenv("OSTIA_WALK_PART") ? all.substr(0, all.find("# ---")) : all;
}

struct ReaderWalk : ::testing::Test {
  testing::Folder folder;
  testing::TestWindow test{folder / "state"};

  /// Begins with what is being opened. What it looked at is left in $OSTIA_WALKED where that is set.
  void walk(const std::string& name, const OtherLines& others = {}) {
    const fs::path file = folder / name;
    core::write_file(file, steps_of(fs::path(OSTIA_WALKS) / name, others));
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
  const fs::path image = folder / "image.nrrd";
  const auto reference = testing::make_sample_patient(image, folder / "sample.ostia");
  session::MachineState(folder / "state").remember_image(reference.sha256, image);
  test.window().open(folder / "sample.ostia");
  walk("reader.walk");
}

TEST_F(ReaderWalk, OnADissectedAortaInWideVoxels) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  fs::copy_file(path, folder / "ct_cropped.nii.gz");
  test.window().open(folder / "ct_cropped.nii.gz");
  // Fewer vessels, in a scan that is hardly good enough; their walls may show no lesion.
  walk("reader.walk", {{"expect vessels >= 3", "expect vessels >= 1"}, {"expect lesions >= 1", ""}});
}

TEST_F(ReaderWalk, OnAChestWithoutTheRoot) {
  OSTIA_REQUIRE_SHARED(path, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  fs::copy_file(path, folder / "heart-crop.nrrd");
  test.window().open(folder / "heart-crop.nrrd");
  walk("chest.walk");
}

}  // namespace
}  // namespace ostia::workstation
