// `ostia motion fit --template`: images of a beating tree by phase, as files, in folders, as DICOM; cases.

#include "../imaging/dicom_writer.h"
#include "beating_images.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using geometry::TriMesh;
using geometry::Vec3;
using motion::testing::beating_grid;
using motion::testing::beating_image;
using motion::testing::far_amount_at;
using motion::testing::still_tree;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::vector<int>& percents() {
  static const std::vector<int> three{60, 75, 90};
  return three;
}

const imaging::ImageVolume& image_at(int percent) {
  static std::map<int, imaging::ImageVolume> made;
  const auto found = made.find(percent);
  if (found != made.end()) return found->second;
  return made[percent] = beating_image(percent / 100.0, beating_grid(1.2));
}

fs::path folder_with_template() {
  const fs::path folder = temporary_folder("motion-images");
  io::write_surface(folder / "lumen.vtp", still_tree());
  fs::create_directory(folder / "heart");
  return folder;
}

Outcome fitted(const fs::path& folder, const std::vector<std::string>& more = {"--template", "lumen.vtp"}) {
  return ostia(std::vector<std::string>{"motion", "fit", "heart", "-o", "out", "--depth", "2"} + more,
               {folder, ""});
}

double error_of(const fs::path& surface, int percent) {
  const TriMesh truth = motion::testing::moved(still_tree(), far_amount_at(percent / 100.0));
  return motion::testing::target_distance(truth, io::read_surface(surface).surface.mesh);
}

void expect_found(const fs::path& folder, const Outcome& done) {
  ASSERT_EQ(done.code, 0) << done.err;
  const Json report = Json::parse(core::read_file(folder / "out" / "report.json"));
  ASSERT_EQ(report["phases"].size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(report["phases"][k]["percent"], percents()[k]);
    EXPECT_GT(report["phases"][k]["image"]["likeness"], 0.8);
    EXPECT_LT(error_of(folder / "out" / "lumen" / ("lumen_" + std::to_string(percents()[k]) + ".vtp"),
                       percents()[k]),
              0.2);
  }
  EXPECT_EQ(report["phases"][1]["origin"], "at_rest");
  EXPECT_GT(error_of(folder / "lumen.vtp", 60), 0.5);  // it had to be carried
}

TEST(MotionImagesCommand, FollowsATemplateThroughAFolderOfVolumes) {
  const fs::path folder = folder_with_template();
  for (const int percent : percents())
    imaging::write_image(folder / "heart" / ("ct_" + std::to_string(percent) + ".nrrd"), image_at(percent));
  expect_found(folder, fitted(folder));
  const Outcome again = fitted(folder);
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("nothing to do"));
  // What was found are phases by themselves.
  const Outcome judged = ostia({"motion", "evaluate", "out", "out/lumen", "--sample", "1", "--resolution",
                                "1", "--require", "msd_mm<=0.3"},
                               {folder, ""});
  EXPECT_EQ(judged.code, 0) << judged.out << judged.err;
}

TEST(MotionImagesCommand, TakesTheImageOfEachPhasesFolderAndTheExactPercents) {
  const fs::path folder = folder_with_template();
  Json beat;
  for (const int percent : percents()) {
    const std::string name = "phase-" + std::to_string(percent / 10);
    fs::create_directory(folder / "heart" / name);
    imaging::write_image(folder / "heart" / name / "image00.nrrd", image_at(percent));
    imaging::MaskVolume labels{image_at(percent).geometry, {}};
    labels.voxels.assign(image_at(percent).voxels.size(), 0);
    imaging::write_image(folder / "heart" / name / "labels.nrrd", labels);
    io::write_surface(folder / "heart" / name / "lumen.vtp", still_tree());  // not this one
    beat["phases"].push_back({{"folder", name}, {"percent", percent}});
  }
  core::write_file(folder / "heart" / "heartbeat.json", beat.dump());
  expect_found(folder, fitted(folder));
  imaging::write_image(folder / "heart" / "phase-6" / "late.nrrd", image_at(60));
  EXPECT_THAT(fitted(folder).err, AllOf(HasSubstr("several images"), HasSubstr("late.nrrd")));
}

TEST(MotionImagesCommand, ReadsThePhasesOfDicomSeries) {
  const fs::path folder = folder_with_template();
  for (const int percent : percents()) {
    imaging::DicomSeriesOptions how;
    how.uid_seed = "beat " + std::to_string(percent);
    how.cardiac_phase_percent = percent;
    imaging::write_dicom_series(folder / "heart" / ("series" + std::to_string(percent % 7)),
                                image_at(percent), how);
  }
  expect_found(folder, fitted(folder));
}

TEST(MotionImagesCommand, TakesATemplateInsteadOfItsPhasesOwnSurface) {
  const fs::path folder = folder_with_template();
  const TriMesh other = geometry::surface_of(motion::testing::tree_shape(), 1.1, false);
  for (const int percent : percents())
    io::write_surface(folder / "heart" / ("s_" + std::to_string(percent) + ".vtp"),
                      motion::testing::moved(other, far_amount_at(percent / 100.0)));
  const Outcome done = fitted(folder);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(io::read_surface(folder / "out" / "template.vtp").surface.mesh.points.size(),
            still_tree().points.size());
  EXPECT_FALSE(fs::exists(folder / "out" / "lumen"));
  // A percent that is given rounded is the phase that is there, and not one more beside it.
  const std::size_t phases =
      nlohmann::json::parse(core::read_file(folder / "out" / "report.json"))["phases"].size();
  ASSERT_EQ(fitted(folder, {"--template", "lumen.vtp", "--template-phase", "75.1"}).code, 0);
  EXPECT_EQ(nlohmann::json::parse(core::read_file(folder / "out" / "report.json"))["phases"].size(), phases);
}

/// A vessel of 20 mm along z, `up` higher.
lumen::LumenModel vessel(double up) {
  geometry::Centerline axis = geometry::straight_tube(20.0, 1.5, 0.5).tubes.front().axis;
  for (Vec3& p : axis.points) p.z() += up;
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, "LAD", {3}}};
  return lumen::model_of_tubes(tree);
}

TEST(MotionImagesCommand, ReadsACaseAPhaseAndACaseAsTheTemplate) {
  const fs::path folder = folder_with_template();
  for (const int percent : {0, 25, 50})
    session::CaseFile::create(folder / "heart" / ("heart_" + std::to_string(percent) + ".ostia"),
                              vessel(0.02 * (75 - percent)));
  session::CaseFile::create(folder / "still.ostia", vessel(0.0));
  const Outcome done = fitted(folder, {"--template", "still.ostia"});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json report = Json::parse(core::read_file(folder / "out" / "report.json"));
  ASSERT_EQ(report["phases"].size(), 4U);
  EXPECT_EQ(report["template_percent"], 75.0);
  ASSERT_EQ(
      ostia({"motion", "apply", "out", "out/template.vtp", "-o", "moved.vtp", "--phase", "0"}, {folder, ""})
          .code,
      0);
  // 1.5 mm up, both ends.
  const auto top = [](const fs::path& file) {
    return geometry::bounds(io::read_surface(file).surface.mesh.points).max().z();
  };
  EXPECT_NEAR(top(folder / "moved.vtp") - top(folder / "out" / "template.vtp"), 1.5, 0.1);
}

/// One series of all phases, told apart by their trigger times, 800 ms a cycle.
void write_by_trigger_time(const fs::path& folder, const std::vector<int>& all) {
  int number = 0;
  for (const int percent : all) {
    const imaging::ImageVolume& image = image_at(percent);
    const auto& grid = image.geometry;
    for (std::int64_t k = 0; k < grid.size[2]; ++k) {
      CtSlice slice;
      const Vec3 at = grid.world({0.0, 0.0, static_cast<double>(k)});
      const auto text = [](double value) { return std::to_string(value); };
      slice.position = text(at.x()) + "\\" + text(at.y()) + "\\" + text(at.z());
      slice.pixel_spacing = text(grid.spacing.y()) + "\\" + text(grid.spacing.x());
      slice.thickness = text(grid.spacing.z());
      slice.columns = static_cast<unsigned>(grid.size[0]);
      slice.rows = static_cast<unsigned>(grid.size[1]);
      slice.instance = std::to_string(++number);
      slice.sop_instance = "1.2.3.4." + slice.instance;
      slice.trigger_time = std::to_string(8 * percent);
      slice.value = [&](int i, int j) {
        return 1024 + image.voxels[static_cast<std::size_t>((k * grid.size[1] + j) * grid.size[0] + i)];
      };
      write_bytes(folder / (slice.instance + ".dcm"), part10(slice.transfer_syntax, slice.data_set()));
    }
  }
}

/// The lumen found nearest to a phase.
fs::path lumen_near(const fs::path& folder, double percent) {
  fs::path best;
  double least = 1.0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const double off = std::abs(std::stod(entry.path().stem().string().substr(6)) - percent);
    if (off < least) best = entry.path();
    least = std::min(least, off);
  }
  return best;
}

TEST(MotionImagesCommand, ReadsThePhasesOfOneSeriesByItsTriggerTimes) {
  const fs::path folder = folder_with_template();
  const std::vector<int> all{0, 15, 30, 45, 60, 75, 90};
  write_by_trigger_time(folder / "heart", all);
  // Steps of 120 ms, seven of them: the cycle that they make is 840 ms long.
  const Outcome done = fitted(folder, {"--template", "lumen.vtp", "--template-phase", "71.428571"});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json report = Json::parse(core::read_file(folder / "out" / "report.json"));
  ASSERT_EQ(report["phases"].size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_NEAR(report["phases"][k]["percent"].get<double>(), 100.0 * static_cast<double>(k) / 7.0, 1e-6);
    EXPECT_EQ(report["phases"][k]["origin"], k == 5 ? "at_rest" : "fitted");
  }
  EXPECT_LT(error_of(lumen_near(folder / "out" / "lumen", 600.0 / 7.0), 90), 0.2);
  EXPECT_LT(error_of(lumen_near(folder / "out" / "lumen", 400.0 / 7.0), 60), 0.2);
}

TEST(MotionImagesCommand, WhatIsWrongWithAnImageIsToldByFile) {
  const fs::path folder = folder_with_template();
  for (const int percent : percents())
    imaging::write_image(folder / "heart" / ("ct_" + std::to_string(percent) + ".nrrd"), image_at(percent));
  const auto told = [&](const std::vector<std::string>& more) {
    const Outcome done = fitted(folder, more);
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_FALSE(fs::exists(folder / "out"));
    return done.err;
  };
  EXPECT_THAT(told({}), AllOf(HasSubstr("ct_60.nrrd"), HasSubstr("--template")));
  EXPECT_THAT(told({"--template", "lumen.vtp", "--template-phase", "70"}),
              AllOf(HasSubstr("no image of that phase"), HasSubstr("60 %, 75 %, 90 %")));
  io::write_surface(folder / "heart" / "s_95.vtp", still_tree());
  EXPECT_THAT(told({"--template", "lumen.vtp"}), AllOf(HasSubstr("ct_90.nrrd"), HasSubstr("s_95.vtp")));
  fs::remove(folder / "heart" / "s_95.vtp");
  imaging::ImageVolume nothing = image_at(90);
  for (std::size_t i = 0; i < nothing.voxels.size(); ++i)
    nothing.voxels[i] = static_cast<std::int16_t>(i * 7919 % 101);
  imaging::write_image(folder / "heart" / "ct_95.nrrd", nothing);
  const Outcome bridged = fitted(folder);  // for a person to look at
  EXPECT_EQ(bridged.code, 4) << bridged.err;
  EXPECT_THAT(bridged.err, HasSubstr("phase 95 %: its image does not show the vessel"));
}

}  // namespace
}  // namespace ostia::testing
