// `ostia model`: the whole way, again, elsewhere, interrupted, on a full disk.

#include "program.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>

namespace ostia::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

Json json_file(const std::filesystem::path& path) {
  return Json::parse(core::read_file(path));
}

TEST(ModelCommand, BuiltinIsTheSameElsewhereAndIsNotDoneTwice) {
  const auto here = temporary_folder("here"), there = temporary_folder("there äö");
  const Outcome first = ostia({"model", "--builtin", "-o", "out"}, {here, ""});
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(names_in(here / "out"),
              ::testing::IsSupersetOf({"centerlines.vtp", "lumen.stl", "lumen.vtp", "manifest.json",
                                       "mesh.vtu", "report.html", "report.json"}));
  EXPECT_THAT(names_in(here), Contains("out")) << "and nothing beside it";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(here), {}), 1);

  const std::string manifest = core::read_file(here / "out" / "manifest.json");
  const Outcome again = ostia({"model", "--builtin", "-o", "out"}, {here, ""});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("nothing to do"));
  EXPECT_EQ(core::read_file(here / "out" / "manifest.json"), manifest);

  const Outcome one_thread =
      ostia({"model", "--builtin", "-o", "o u t", "--threads", "1", "--json"}, {there, ""});
  ASSERT_EQ(one_thread.code, 0) << one_thread.err;
  for (const char* name : {"lumen.stl", "lumen.vtp", "mesh.vtu", "centerlines.vtp"}) {
    EXPECT_TRUE(core::read_file(here / "out" / name) == core::read_file(there / "o u t" / name)) << name;
  }
  EXPECT_EQ(Json::parse(one_thread.out), json_file(there / "o u t" / "report.json"));
  EXPECT_EQ(Json::parse(manifest)["inputs"], json_file(there / "o u t" / "manifest.json")["inputs"]);
}

TEST(ModelCommand, ManifestHoldsTheDigestOfEveryFile) {
  const SmallCase small = small_case();
  const Outcome done =
      ostia(std::vector<std::string>{"model", "heart.nrrd", "-o", "out", "--edge-ratio", "0.8"} +
                small.branch_arguments,
            {small.folder, ""});
  ASSERT_TRUE(done.code == 0 || done.code == 4) << done.err;
  const Json manifest = json_file(small.folder / "out" / "manifest.json");
  EXPECT_EQ(manifest["exit_code"], done.code);
  EXPECT_EQ(manifest["inputs"]["input"], core::sha256_file(small.image));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(small.folder / "out"))
    files += entry.is_regular_file();
  EXPECT_EQ(manifest["outputs"].size() + 1, files);
  for (const auto& [name, digest] : manifest["outputs"].items())
    EXPECT_EQ(core::sha256_file(small.folder / "out" / name), digest) << name;
  // A damaged folder is made anew, not believed.
  core::write_file(small.folder / "out" / "lumen.stl", "damaged");
  const Outcome again =
      ostia(std::vector<std::string>{"model", "heart.nrrd", "-o", "out", "--edge-ratio", "0.8"} +
                small.branch_arguments,
            {small.folder, ""});
  EXPECT_EQ(again.code, done.code);
  EXPECT_EQ(core::sha256_file(small.folder / "out" / "lumen.stl"), manifest["outputs"]["lumen.stl"]);
}

TEST(ModelCommand, InterruptedItStopsSoonAndLeavesNothing) {
  for (const double seconds : {0.1, 0.4, 1.2, 2.5}) {
    const auto folder = temporary_folder("interrupted");
    double to_end = 0.0;
    const Outcome done = interrupted({"model", "--builtin", "-o", "out"}, {folder, ""},
                                     seconds < 1.0 ? SIGINT : SIGTERM, seconds, to_end);
    if (done.code == 0) continue;  // a fast machine
    EXPECT_EQ(done.code, 128 + (seconds < 1.0 ? SIGINT : SIGTERM))
        << "after " << seconds << " s: " << done.err;
    EXPECT_LT(to_end, 10.0) << "after " << seconds << " s";  // one second is meant; machines may be busy
    EXPECT_THAT(done.out, IsEmpty());
    EXPECT_THAT(names_in(folder), IsEmpty()) << "after " << seconds << " s";
  }
}

TEST(ModelCommand, FullDiskIsFiveAndLeavesTheOldFolder) {
  const SmallCase small = small_case();
  std::filesystem::create_directory(small.folder / "o");
  const std::vector<std::string> command =
      std::vector<std::string>{"model", "heart.nrrd", "-o", "o/out", "--edge-ratio", "0.8"} +
      small.branch_arguments;
  const Outcome done = ostia(command, {small.folder, "ulimit -f 40;"});  // blocks of 512 bytes
  EXPECT_EQ(done.code, 5) << done.err;
  EXPECT_THAT(names_in(small.folder / "o"), IsEmpty());
}

}  // namespace
}  // namespace ostia::testing
