#include "ostia/io/wfdb_file.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class WfdbFile : public ::testing::Test {
 protected:
  std::filesystem::path folder = ostia::testing::temporary_folder("wfdb"), file = folder / "made.hea";

  void refused(const std::string& header, const std::string& why) {
    core::write_file(file, header);
    try {
      read_wfdb(file);
      ADD_FAILURE() << "taken: " << header;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  }
  /// The first lead's values, in steps.
  std::vector<double> read(const std::string& line, const std::string& bytes) {
    core::write_file(folder / "made.dat", bytes);
    core::write_file(file, "made 1 250\n" + line + "\n");
    return read_wfdb(file).record.leads.at(0).values;
  }
};

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

geometry::EcgRecord wave(std::size_t samples) {
  geometry::EcgRecord record;
  record.samples_per_second = 360.0;
  for (const char* name : {"MLII", "V 5"}) {
    geometry::EcgLead lead{name, "mV", {}};
    for (std::size_t i = 0; i < samples; ++i)
      lead.values.push_back(std::sin(0.01 * static_cast<double>(i)) + (name[0] == 'V' ? 0.5 : 0.0));
    record.leads.push_back(lead);
  }
  return record;
}

TEST_F(WfdbFile, GivesBackWhatWasWritten) {
  geometry::EcgRecord record = wave(5000);
  record.leads[1].values[17] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<geometry::EcgBeat> beats = {{3, 'N'}, {3000, 'V'}, {3000 + 1023, 'A'}, {3'000'000, 'f'}};
  write_wfdb(file, record, beats);
  const WfdbRecord back = read_wfdb(file);
  EXPECT_THAT(back.warnings, IsEmpty());
  EXPECT_EQ(back.record.samples_per_second, 360.0);
  ASSERT_EQ(back.record.leads.size(), 2U);
  EXPECT_EQ(back.record.leads[1].name, "V 5");
  EXPECT_EQ(back.record.leads[1].unit, "mV");
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t i = 0; i < 5000; ++i) {
      if (s == 1 && i == 17) continue;
      ASSERT_NEAR(back.record.leads[s].values[i], record.leads[s].values[i], 5.01e-4);
    }
  EXPECT_TRUE(std::isnan(back.record.leads[1].values[17]));
  const auto read = read_wfdb_beats(folder / "made.atr");
  ASSERT_EQ(read.size(), beats.size());
  for (std::size_t i = 0; i < beats.size(); ++i) {
    EXPECT_EQ(read[i].sample, beats[i].sample);
    EXPECT_EQ(read[i].kind, beats[i].kind);
  }
}

TEST_F(WfdbFile, LongNamesKeepTheirLinesWhole) {
  geometry::EcgRecord record = wave(10);
  record.leads[0].name = std::string(300, 'n');
  record.leads[0].unit = std::string(250, 'u');
  const auto longest = folder / (std::string(100, 'r') + ".hea");
  write_wfdb(longest, record);
  const WfdbRecord back = read_wfdb(longest);
  ASSERT_EQ(back.record.leads.size(), 2U);
  EXPECT_EQ(back.record.leads[0].name, record.leads[0].name);
  EXPECT_EQ(back.record.leads[0].unit, record.leads[0].unit);
  EXPECT_EQ(back.record.leads[1].name, "V 5");
  EXPECT_EQ(back.record.samples_per_second, 360.0);
  EXPECT_THROW(write_wfdb(folder / (std::string(101, 'r') + ".hea"), wave(10)), InvalidInput);
}

TEST_F(WfdbFile, RefusesTextsThatWouldBreakItsLines) {
  const auto refuses = [&](const std::string& name, const std::string& unit) {
    geometry::EcgRecord record = wave(10);
    record.leads[1].name = name;
    record.leads[1].unit = unit;
    EXPECT_THROW(write_wfdb(file, record), InvalidInput) << name << ", " << unit;
    EXPECT_FALSE(std::filesystem::exists(file));
  };
  refuses("V\n5", "mV");
  refuses("V5", "m V");
  refuses("V5", "mV\n");
  refuses("V5", "\t");
}

TEST_F(WfdbFile, LeavesNoBeatsOfAnEarlierRecord) {
  write_wfdb(file, wave(100), {{3, 'N'}});
  ASSERT_TRUE(std::filesystem::exists(folder / "made.atr"));
  write_wfdb(file, wave(100));
  EXPECT_FALSE(std::filesystem::exists(folder / "made.atr"));
  EXPECT_NO_THROW(read_wfdb(file));
}

// The bytes are made by hand from the formats' descriptions.
TEST_F(WfdbFile, UnpacksEachFormat) {
  EXPECT_THAT(read("made.dat 16 1", bytes({1, 0, 0xFF, 0xFF, 0, 2})), ElementsAre(1, -1, 512));
  EXPECT_THAT(read("made.dat 61 1", bytes({0, 1, 0xFF, 0xFE})), ElementsAre(1, -2));
  EXPECT_THAT(read("made.dat 24 1", bytes({0, 0, 1, 0xFE, 0xFF, 0xFF})), ElementsAre(65536, -2));
  EXPECT_THAT(read("made.dat 32 1", bytes({0, 0, 0, 1, 0xFF, 0xFF, 0xFF, 0xFF})), ElementsAre(16777216, -1));
  EXPECT_THAT(read("made.dat 80 1", bytes({128, 129, 1})), ElementsAre(0, 1, -127));
  EXPECT_THAT(read("made.dat 160 1", bytes({0, 0x80, 1, 0x80})), ElementsAre(0, 1));
  // 0x123 and -2 (0xFFE): low byte, high nibbles of both (second in the upper half), low byte
  EXPECT_THAT(read("made.dat 212 1", bytes({0x23, 0xF1, 0xFE, 0x05, 0x00})), ElementsAre(0x123, -2, 5));
  // 5, -3 and 1: bits 0-9, 10-19, 20-29
  EXPECT_THAT(read("made.dat 311 1", bytes({0x05, 0xF4, 0x1F, 0x00})), ElementsAre(5, -3, 1));
  // 5 and -3 in the eleven lowest bits with the lowest left out; 33 = 1 + 32: upper five bits 1 and 1
  EXPECT_THAT(read("made.dat 310 1", bytes({0x0A, 0x08, 0xFA, 0x0F})), ElementsAre(5, -3, 33));
}

TEST_F(WfdbFile, KeepsMissingSamplesGainBaselineSkewAndOffset) {
  const auto values =
      read("made.dat 16x2:1+2 2(10)/uV", bytes({9, 9, 10, 0, 14, 0, 20, 0, 0, 0x80, 30, 0, 30, 0}));
  ASSERT_EQ(values.size(), 3U);                      // frames of two samples
  EXPECT_DOUBLE_EQ(values[0], (20.0 - 10.0) / 2.0);  // the second frame, its missing half left out
  EXPECT_DOUBLE_EQ(values[1], (30.0 - 10.0) / 2.0);
  EXPECT_TRUE(std::isnan(values[2]));  // beyond the end, as the skew is one frame
  EXPECT_TRUE(std::isnan(read("made.dat 212 1", bytes({0x00, 0x08}))[0]));
}

TEST_F(WfdbFile, TellsOfRecordsThatEndEarlyOrWereChanged) {
  write_wfdb(file, wave(1000));
  std::string data = core::read_file(folder / "made.dat");
  core::write_file(folder / "made.dat", data.substr(0, 2000));
  WfdbRecord cut = read_wfdb(file);
  EXPECT_EQ(cut.record.samples(), 500U);
  ASSERT_EQ(cut.warnings.size(), 1U);
  EXPECT_THAT(cut.warnings[0], HasSubstr("ends early, after 500 of 1000"));
  data[100] = static_cast<char>(data[100] + 1);
  core::write_file(folder / "made.dat", data);
  const WfdbRecord changed = read_wfdb(file);
  ASSERT_EQ(changed.warnings.size(), 1U);
  EXPECT_THAT(changed.warnings[0], HasSubstr("the sum of lead MLII"));
}

TEST_F(WfdbFile, RefusesWhatItCannotRead) {
  core::write_file(folder / "made.dat", "1234");
  refused("", "line 0");
  refused("made", "no name and number");
  refused("made x 250\n", "number of signals");
  refused("made/3 1 250\n", "several segments");
  refused("made 1 -250\n", "sampling rate");
  refused("made 2 250\nmade.dat 16\n", "ends after 1 of its signals");
  refused("made 1 250\nmade.dat sixteen\n", "line 2");
  refused("made 1 250\nmade.dat 16q\n", "format that cannot be read");
  refused("made 1 250\nmade.dat 16 x\n", "no gain");
  refused("made 1 250\nmade.dat 16 1(\n", "baseline");
  refused("made 1 250\n../made.dat 16\n", "put the file beside");
  refused("made 1 250\nmade.dat 8\n", "format 8");
  refused("made 1 250\nmade.dat 16x9\n", "no samples");
  core::write_file(file, "made 1 250\nelsewhere.dat 16\n");
  EXPECT_THROW(read_wfdb(file), IoError);
  EXPECT_THROW(read_wfdb(folder / "none.hea"), IoError);

  core::write_file(folder / "made.atr", bytes({1, 4, 1, 4}));
  EXPECT_THROW(read_wfdb_beats(folder / "made.atr"), InvalidInput);  // no end
  core::write_file(folder / "made.atr", bytes({1, 4, 0, 59 * 4, 0xFF, 0xFF, 0, 0, 1, 4, 0, 0}));
  EXPECT_THROW(read_wfdb_beats(folder / "made.atr"), InvalidInput);  // goes back by 65536
  EXPECT_THROW(write_wfdb(folder / "a b.hea", wave(10)), InvalidInput);
  EXPECT_THROW(write_wfdb(file, {}), InvalidInput);
  EXPECT_THROW(write_wfdb(file, wave(10), {{5, 'N'}, {4, 'N'}}), InvalidInput);
  EXPECT_THROW(write_wfdb(file, wave(10), {{5, '$'}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::io
