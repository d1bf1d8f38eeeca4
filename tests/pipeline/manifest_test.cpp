#include "ostia/pipeline/manifest.h"

#include "shared_data.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/version.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ostia::pipeline {
namespace {

JobKey key() {
  return {"model", {{"input", "abc"}}, R"({"edge_ratio":0.4})"};
}

std::filesystem::path done_folder(ExitCode code) {
  const auto folder = testing::temporary_folder("manifest");
  core::write_file(folder / "mesh.vtu", "mesh");
  core::redact_in_logs("DOE^JANE", "patient-1");
  write_manifest(folder, {key(), code, 1.5, {"DOE^JANE has a gap"}, R"({"dice":1})"});
  return folder;
}

TEST(Manifest, SaysWhatWasDone) {
  const auto folder = done_folder(ExitCode::ok);
  const std::string text = core::read_file(folder / "manifest.json");
  const auto manifest = nlohmann::json::parse(text);
  EXPECT_EQ(manifest["v"], 1);
  EXPECT_EQ(manifest["outputs"]["mesh.vtu"], core::sha256("mesh"));
  EXPECT_EQ(manifest["quality"]["dice"], 1);
  EXPECT_EQ(manifest["program"]["version"], core::version());
  EXPECT_GT(manifest["peak_mb"].get<double>(), 1.0);
  EXPECT_EQ(text.find("DOE"), std::string::npos);
}

TEST(Manifest, ReturnsWhatItReturned) {
  EXPECT_EQ(already_done(done_folder(ExitCode::quality_failed), key()), ExitCode::quality_failed);
}

TEST(Manifest, IsNotDoneForAnotherJob) {
  const auto folder = done_folder(ExitCode::ok);
  JobKey other = key();
  other.parameters = R"({"edge_ratio":0.5})";
  EXPECT_FALSE(already_done(folder, other));
  other = key();
  other.inputs["input"] = "abd";
  EXPECT_FALSE(already_done(folder, other));
  EXPECT_FALSE(already_done(testing::temporary_folder("empty"), key()));
}

TEST(Manifest, IsNotDoneWhenAnOutputWasTouched) {
  const auto folder = done_folder(ExitCode::ok);
  core::write_file(folder / "mesh.vtu", "changed");
  EXPECT_FALSE(already_done(folder, key()));
  std::filesystem::remove(folder / "mesh.vtu");
  EXPECT_FALSE(already_done(folder, key()));
}

TEST(Manifest, OnlyNewEmptyOrOwnFoldersAreFree) {
  const auto folder = testing::temporary_folder("manifest");
  EXPECT_NO_THROW(require_free_folder(folder / "new"));
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
  EXPECT_NO_THROW(require_free_folder(folder));
  EXPECT_THROW(require_free_folder(folder / "."), InvalidInput);
  EXPECT_NO_THROW(require_free_folder(folder / "missing" / "new"));
  EXPECT_FALSE(std::filesystem::exists(folder / "missing"));
  const auto own = done_folder(ExitCode::ok);
  EXPECT_THROW(require_free_folder(own / "mesh.vtu" / "new"), IoError) << "a file is no folder";
  EXPECT_NO_THROW(require_free_folder(own));
  core::write_file(own / "letter.txt", "mine");
  EXPECT_THROW(require_free_folder(own), InvalidInput);
  core::write_file(folder / "manifest.json", R"({"outputs": 3})");
  EXPECT_THROW(require_free_folder(folder), InvalidInput);
}

TEST(Manifest, SurvivesNonsenseInItsPlace) {
  const auto folder = testing::temporary_folder("manifest");
  core::write_file(folder / "manifest.json", "{");
  EXPECT_FALSE(already_done(folder, key()));
}

}  // namespace
}  // namespace ostia::pipeline
