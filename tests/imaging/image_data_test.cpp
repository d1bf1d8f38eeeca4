#include "image_data.h"

#include "image_files.h"
#include "shared_data.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {
using namespace testing;

std::string all_of(ByteStream& stream, std::size_t step) {
  std::string result, block(step, '\0');
  while (const std::size_t got = stream.read(block.data(), step)) result.append(block, 0, got);
  return result;
}

TEST(ByteStream, GivesPlainAndPackedBytesFromAnOffset) {
  const fs::path here = ostia::testing::temporary_folder("stream");
  const std::string bytes = bytes_of(counted<std::int32_t>(300000));
  write_bytes(here / "plain", "junk" + bytes);
  write_bytes(here / "gzip", "junk" + packed(bytes));
  write_bytes(here / "zlib", "junk" + packed(bytes, false));
  for (const std::size_t step : {std::size_t{999}, std::size_t{1} << 21}) {
    for (const char* name : {"plain", "gzip", "zlib"}) {
      ByteStream stream(here / name, 4, std::string(name) != "plain");
      EXPECT_EQ(all_of(stream, step), bytes) << name << " " << step;
    }
  }
}

TEST(ByteStream, GivesTheSameBytesInAnyStepHoweverTheyWerePacked) {
  const fs::path path = ostia::testing::temporary_folder("packings") / "a.gz";
  const std::string noise = bytes_of(
      testing::patterned<std::int16_t>(oblique_grid(70, 60, 50)).voxels);  // more than one block of input
  const std::string runs = std::string(400000, 'a') + noise.substr(0, 100001) + std::string(300000, 'b');
  for (const std::string* bytes : {&noise, &runs}) {
    for (const int level : {0, 1, 9}) {  // level 0: stored, not packed
      for (const bool gzip : {true, false}) {
        write_bytes(path, packed(*bytes, gzip, level));
        for (const std::size_t step :
             {std::size_t{37}, std::size_t{32768}, bytes->size() - 1, bytes->size()}) {
          ByteStream stream(path, 0, true);
          EXPECT_TRUE(all_of(stream, step) == *bytes) << level << " " << gzip << " " << step;
        }
      }
    }
  }
}

TEST(ByteStream, RefusesACutAtAnyPlace) {
  const fs::path path = ostia::testing::temporary_folder("cuts") / "a.gz";
  for (const bool gzip : {true, false}) {
    const std::string good =
        packed(std::string(1000, 'x') + "and an end that is none of its repetitions", gzip);
    for (std::size_t length = 0; length < good.size(); ++length) {
      write_bytes(path, good.substr(0, length));
      ByteStream stream(path, 0, true);
      EXPECT_NE(refusal([&] { all_of(stream, 64); }).find("cut short"), std::string::npos) << length;
    }
  }
}

TEST(ByteStream, JoinsGzipMembersAndLeavesWhatIsNone) {
  const fs::path path = ostia::testing::temporary_folder("members") / "a.gz";
  write_bytes(path, packed("first ") + packed("second") + std::string(7, '\0'));
  ByteStream stream(path, 0, true);
  EXPECT_EQ(all_of(stream, 5), "first second");
}

TEST(ByteStream, CutAndDamagedDataAreRefused) {
  const fs::path path = ostia::testing::temporary_folder("damage") / "a.gz";
  const std::string good =
      packed(bytes_of(testing::patterned<std::int16_t>(oblique_grid(20, 20, 20)).voxels));
  for (const std::size_t length : {std::size_t{12}, good.size() / 2, good.size() - 1}) {
    write_bytes(path, good.substr(0, length));
    ByteStream stream(path, 0, true);
    EXPECT_NE(refusal([&] { all_of(stream, 1000); }).find("cut short"), std::string::npos) << length;
  }
  std::string wrong = good;
  wrong[wrong.size() - 6] = static_cast<char>(wrong[wrong.size() - 6] ^ 1);  // the check sum
  write_bytes(path, wrong);
  ByteStream stream(path, 0, true);
  EXPECT_NE(refusal([&] { all_of(stream, 1000); }).find("wrong check sum"), std::string::npos);
}

TEST(FileHead, ToleratesPackedDataThatAreCutLater) {
  const fs::path path = ostia::testing::temporary_folder("head") / "a.gz";
  const std::string bytes = bytes_of(testing::patterned<std::int16_t>(oblique_grid(20, 20, 20)).voxels),
                    gz = packed(bytes);
  write_bytes(path, gz.substr(0, gz.size() / 2));
  bool compressed = false;
  const std::string head = file_head(path, 1000, compressed);
  EXPECT_TRUE(compressed);
  ASSERT_GE(head.size(), 540U);
  EXPECT_EQ(head, bytes.substr(0, head.size()));
}

}  // namespace
}  // namespace ostia::imaging
