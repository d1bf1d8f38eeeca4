// Nothing of a patient in what is written.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Privacy, NoNameOfAFolderOrFileIsWrittenAnywhere) {
  const SmallCase small = small_case("DOE^JANE_image.nrrd");
  const auto patient = small.folder / "DOE^JANE";
  std::filesystem::create_directory(patient);
  std::filesystem::rename(small.image, patient / "DOE^JANE_image.nrrd");
  const std::vector<std::string> command =
      std::vector<std::string>{
          "model", (patient / "DOE^JANE_image.nrrd").string(), "-o", "out", "--edge-ratio", "0.8", "--log",
          "json"} +
      small.branch_arguments;
  const Outcome done = ostia(command, {small.folder, ""});
  ASSERT_TRUE(done.code == 0 || done.code == 4) << done.err;
  EXPECT_THAT(done.out + done.err, Not(HasSubstr("DOE^JANE")));
  for (const std::string& name : names_in(small.folder / "out")) {
    EXPECT_THAT(name, Not(HasSubstr("DOE^JANE")));
    if (std::filesystem::is_directory(small.folder / "out" / name)) continue;
    EXPECT_EQ(core::read_file(small.folder / "out" / name).find("DOE^JANE"), std::string::npos) << name;
  }
}

TEST(Privacy, NorInALogOfRefusals) {
  const auto folder = temporary_folder("DOE^JANE");
  core::write_file(folder / "DOE^JANE.nrrd", "NRRD0004\ntype: short\ndimension: 3\n\n");
  core::write_file(folder / "DOE^JANE.stl", "hello");
  const std::string image = (folder / "DOE^JANE.nrrd").string(), surface = (folder / "DOE^JANE.stl").string();
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"info", image},
        {"info", surface},
        {"info", image + "x"},
        {"import", image, "-o", (folder / "DOE^JANE.mha").string()},
        {"convert", surface, (folder / "DOE^JANE.nrrd" / "DOE^JANE.vtp").string()},
        {"mesh", "--check", surface},
        {"centerline", surface, "-o", "a.vtp"},
        {"model", "--builtin", "-o", (folder / "DOE^JANE.nrrd" / "DOE^JANE").string()}}) {
    const Outcome done = ostia(command + std::vector<std::string>{"--log", "json"});
    EXPECT_EQ(done.code, 3) << command.front();
    EXPECT_THAT(done.out + done.err, Not(HasSubstr("DOE^JANE"))) << command.front();
  }
}

TEST(Privacy, NorInALogOfRefusalsOfWhatAnImageHolds) {
  const auto folder = temporary_folder("DOE^JANE");
  imaging::ImageVolume image;
  image.geometry.size = {20, 20, 20};
  for (int v = 0; v < 8000; ++v) image.voxels.push_back(static_cast<std::int16_t>(v % 500 - 100));
  imaging::write_image(folder / "DOE^JANE_ct.nrrd", image);
  imaging::MaskVolume mask{image.geometry, std::vector<std::uint8_t>(8000, 0)};
  imaging::write_image(folder / "DOE^JANE_mask.nrrd", mask);
  const std::string ct = (folder / "DOE^JANE_ct.nrrd").string(),
                    empty = (folder / "DOE^JANE_mask.nrrd").string();
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"extract", ct, "-o", (folder / "a.ostia").string()},
        {"segment", ct, "-o", (folder / "a.nrrd").string(), "--aorta"},
        {"segment", ct, "-o", (folder / "a.vtp").string(), "--branch", "1,1,1:900,0,0"},
        {"segment", empty, "-o", (folder / "a.vtp").string()},
        {"skeleton", empty, "-o", (folder / "a.vtp").string()}}) {
    const Outcome plain = ostia(command), logged = ostia(command + std::vector<std::string>{"--log", "json"});
    EXPECT_EQ(plain.code, 3) << command.front();
    EXPECT_EQ(logged.code, 3) << command.front();
    // A person is told which file; a log that is kept is not.
    EXPECT_THAT(plain.err, HasSubstr("DOE^JANE")) << command.front();
    EXPECT_THAT(logged.out + logged.err, Not(HasSubstr("DOE^JANE"))) << command.front();
    EXPECT_THAT(logged.err, HasSubstr("INPUT")) << command.front();
  }
}

}  // namespace
}  // namespace ostia::testing
