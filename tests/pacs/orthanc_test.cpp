// The whole way with an archive that is not ours.

#include "local_orthanc.h"
#include "shared_data.h"
#include "small_series.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/dicom.h"
#include "ostia/pacs/archive.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace ostia::pacs {
namespace {

using ::testing::HasSubstr;
using testing::LocalOrthanc;
using testing::small_series;
using testing::SmallSeries;

/// One server for all tests of this program, with one series of a patient and one of another.
struct Orthanc : ::testing::Test {
  static void SetUpTestSuite() {
    if (!LocalOrthanc::is_installed()) return;
    server = std::make_unique<LocalOrthanc>();
    first = small_series("first", 6);
    second = small_series("second", 3, "PID-2", "ROE^RICHARD");
    ASSERT_TRUE(server->running()) << server->log();
    for (const SmallSeries* series : {&first, &second})
      for (const SendResult& result : archive(server->by_get())->send(series->files))
        EXPECT_EQ(result.state, SendState::sent) << result.reason;
  }
  static void TearDownTestSuite() { server.reset(); }
  void SetUp() override { OSTIA_REQUIRE_ORTHANC(); }

  static std::unique_ptr<Archive> archive(const ServerDescription& description) {
    return open_archive(description, server->secrets());
  }
  static std::vector<ServerDescription> ways() {
    return {server->by_get(), server->by_move(), server->by_web()};
  }
  static inline std::unique_ptr<LocalOrthanc> server;
  static inline SmallSeries first, second;
};

TEST_F(Orthanc, AnswersAnEcho) {
  for (const ServerDescription& way : ways()) EXPECT_NO_THROW(archive(way)->echo());
}

TEST_F(Orthanc, FindsByPatientAndDownToTheImages) {
  for (const ServerDescription& way : ways()) {
    Query query;
    query.patient_name = "DOE*";
    const FindResult studies = archive(way)->find(query);
    ASSERT_EQ(studies.found.size(), 1u);
    EXPECT_EQ(studies.found[0].study_uid, first.study_uid);
    EXPECT_EQ(studies.found[0].patient_name, "DOE^JANE");
    EXPECT_EQ(studies.found[0].patient_id, "PID-1");
    EXPECT_EQ(studies.found[0].modality, "CT");
    query = {};
    query.level = Level::series;
    query.study_uid = first.study_uid;
    const FindResult series = archive(way)->find(query);
    ASSERT_EQ(series.found.size(), 1u);
    EXPECT_EQ(series.found[0].series_uid, first.series_uid);
    EXPECT_EQ(series.found[0].images, 6);
    query.level = Level::image;
    query.series_uid = first.series_uid;
    std::vector<std::string> images;
    for (const Found& one : archive(way)->find(query).found) images.push_back(one.sop_uid);
    EXPECT_THAT(images, ::testing::UnorderedElementsAreArray(first.sop_uids));
    query = {};
    query.patient_id = "nobody";
    EXPECT_TRUE(archive(way)->find(query).found.empty());
  }
}

TEST_F(Orthanc, CutsOffWhatIsMoreThanAskedFor) {
  for (const ServerDescription& way : ways()) {
    Query query;
    query.most = 1;
    const FindResult result = archive(way)->find(query);
    EXPECT_EQ(result.found.size(), 1u);
    EXPECT_TRUE(result.cut_off);
  }
}

TEST_F(Orthanc, ASeriesComesWholeAndReads) {
  for (const ServerDescription& way : ways()) {
    const auto folder = testing::temporary_folder("fetched") / "CT";
    const Fetched fetched = archive(way)->fetch({first.study_uid, first.series_uid}, folder);
    EXPECT_EQ(fetched.files.size(), 6u);
    EXPECT_TRUE(fetched.warnings.empty());
    const auto read = imaging::read_dicom(folder), sent = imaging::read_dicom(first.folder);
    EXPECT_EQ(read.volume.voxels, sent.volume.voxels);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 6);
  }
}

TEST_F(Orthanc, OneImageOutOfTheMiddleComesAlone) {
  std::vector<std::string> counted = first.sop_uids;  // as a scanner counts: by length, then by digits
  std::sort(counted.begin(), counted.end(), [](const std::string& a, const std::string& b) {
    return std::pair(a.size(), a) < std::pair(b.size(), b);
  });
  for (const ServerDescription& way : ways()) {
    const auto folder = testing::temporary_folder("middle") / "image";
    const auto file = archive(way)->fetch_middle({first.study_uid, first.series_uid}, folder);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
    ASSERT_EQ(counted.size(), 6u);
    EXPECT_EQ(file.stem().string(), counted[3]);
    EXPECT_THROW(archive(way)->fetch_middle({first.study_uid, "1.2.3.4.5"}, folder / "no"), InvalidInput);
  }
}

TEST_F(Orthanc, ASeriesThatItDoesNotHaveIsRefused) {
  for (const ServerDescription& way : ways()) {
    const auto folder = testing::temporary_folder("none");
    EXPECT_THROW(archive(way)->fetch({first.study_uid, "1.2.3.4.5"}, folder / "CT"), InvalidInput);
    EXPECT_TRUE(std::filesystem::is_empty(folder));
  }
}

TEST_F(Orthanc, SentTwiceItIsThereOnce) {
  const SmallSeries third = small_series("third", 2);
  for (const ServerDescription& way : ways()) {
    for (const SendResult& result : archive(way)->send(third.files))
      EXPECT_EQ(result.state, SendState::sent) << result.reason;
    Query query;
    query.level = Level::image;
    query.study_uid = third.study_uid;
    query.series_uid = third.series_uid;
    EXPECT_EQ(archive(way)->find(query).found.size(), 2u);
  }
}

TEST_F(Orthanc, WhatIsNoObjectIsRefusedAloneAndTheRestIsSent) {
  const auto folder = testing::temporary_folder("mixed");
  core::write_file(folder / "note.txt", "hello");
  const SmallSeries fourth = small_series("fourth", 2);
  core::write_file(folder / "cut.dcm", fourth.bytes[0].substr(0, fourth.bytes[0].size() - 100));
  for (const ServerDescription& way : {server->by_get(), server->by_web()}) {
    const auto results = archive(way)->send(
        {fourth.files[0], folder / "note.txt", folder / "missing.dcm", folder / "cut.dcm", fourth.files[1]});
    ASSERT_EQ(results.size(), 5u);
    EXPECT_EQ(results[0].state, SendState::sent) << results[0].reason;
    EXPECT_EQ(results[1].state, SendState::refused);
    EXPECT_EQ(results[2].state, SendState::refused);
    EXPECT_NE(results[3].state, SendState::unreachable) << results[3].reason;
    EXPECT_EQ(results[4].state, SendState::sent) << results[4].reason;
  }
}

/// The series' first file with another name in another character set, put behind each other in its data set.
std::string named(const SmallSeries& series, const std::string& set, const std::string& name) {
  const auto element = [](const char* tag, const char* kind, std::string value, char pad) {
    if (value.size() % 2 != 0) value += pad;
    return std::string(tag, 4) + kind + std::string{static_cast<char>(value.size()), '\0'} + value;
  };
  std::string bytes = series.bytes[0];
  const std::string old_name = element("\x10\0\x10\0", "PN", "PLACE^HOLDER", ' ');
  bytes.replace(bytes.find(old_name), old_name.size(), element("\x10\0\x10\0", "PN", name, ' '));
  const std::size_t old_set = bytes.find(std::string("\x08\0\x05\0", 4) + "CS");
  if (old_set != std::string::npos) bytes.erase(old_set, 8 + static_cast<unsigned char>(bytes[old_set + 6]));
  // Behind the file's meta information, whose length stands in its first element.
  const std::size_t first =
      144 + static_cast<unsigned char>(bytes[140]) + 256 * static_cast<unsigned char>(bytes[141]);
  bytes.insert(first, element("\x08\0\x05\0", "CS", set, ' '));
  return bytes;
}

TEST_F(Orthanc, NamesComeInTheirOwnLetters) {
  const std::string umlauts = "M\xC3\xBCller^J\xC3\xBCrg", cyrillic = "\xD0\x9B\xD1\x8E";
  const std::string cases[][4] = {{"latin", "ISO_IR 100", "M\xFCller^J\xFCrg", umlauts},
                                  {"utf8", "ISO_IR 192", umlauts, umlauts},
                                  {"iso2022", "\\ISO 2022 IR 144", "\x1B\x2D\x4C\xBB\xEE", cyrillic}};
  const auto folder = testing::temporary_folder("named");
  for (const auto& [seed, set, raw, expected] : cases) {
    const SmallSeries series = small_series(seed, 1, "PID-" + seed, "PLACE^HOLDER");
    core::write_file(folder / seed, named(series, set, raw));
    const auto sent = archive(server->by_get())->send({folder / seed});
    ASSERT_EQ(sent[0].state, SendState::sent) << sent[0].reason;
    for (const ServerDescription& way : {server->by_get(), server->by_web()}) {
      Query query;
      query.patient_id = "PID-" + seed;
      const FindResult result = archive(way)->find(query);
      ASSERT_EQ(result.found.size(), 1u) << seed;
      EXPECT_EQ(result.found[0].patient_name, expected) << seed;
    }
  }
}

TEST_F(Orthanc, AWrongTitleOrPasswordIsSaid) {
  ServerDescription wrong = server->by_get();
  wrong.title = "OTHER";
  try {
    archive(wrong)->echo();
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("is not called 'OTHER'"));
  }
  EXPECT_THROW(open_archive(server->by_web(), {"wrong", {}})->echo(), InvalidInput);
}

TEST_F(Orthanc, AMoveToATitleItDoesNotKnowIsSaid) {
  ServerDescription stranger = server->by_move();
  stranger.own_title = "STRANGER";
  try {
    archive(stranger)->fetch({first.study_uid, first.series_uid}, testing::temporary_folder("moved") / "CT");
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(),
                ::testing::AnyOf(HasSubstr("does not know where 'STRANGER' is"), HasSubstr("C-MOVE")));
  }
}

TEST_F(Orthanc, ATakenPortIsSaid) {
  ServerDescription taken = server->by_move();
  taken.receive_port = taken.port;
  EXPECT_THROW(
      archive(taken)->fetch({first.study_uid, first.series_uid}, testing::temporary_folder("taken") / "CT"),
      IoError);
}

struct SecureOrthanc : ::testing::Test {
  static void SetUpTestSuite() {
    if (LocalOrthanc::is_installed())
      server = std::make_unique<LocalOrthanc>(testing::OrthancSetting{true, {}});
  }
  static void TearDownTestSuite() { server.reset(); }
  void SetUp() override {
    OSTIA_REQUIRE_ORTHANC();
    ASSERT_TRUE(server->running()) << server->log();
  }
  static inline std::unique_ptr<LocalOrthanc> server;
};

TEST_F(SecureOrthanc, SendsFindsAndFetches) {
  const SmallSeries series = small_series("secure", 3);
  const auto archive = open_archive(server->by_get());
  archive->echo();
  for (const SendResult& result : archive->send(series.files))
    EXPECT_EQ(result.state, SendState::sent) << result.reason;
  const auto folder = testing::temporary_folder("secure") / "CT";
  EXPECT_EQ(archive->fetch({series.study_uid, series.series_uid}, folder).files.size(), 3u);
}

TEST_F(SecureOrthanc, ACertificateOfSomebodyElseIsRefused) {
  ServerDescription way = server->by_get();
  way.authorities.clear();  // the system's, which did not sign it
  EXPECT_THROW(open_archive(way)->echo(), InvalidInput);
}

TEST_F(SecureOrthanc, ACertificateForAnotherHostIsRefused) {
  ServerDescription way = server->by_get();
  way.host = "127.0.0.1";  // it is for localhost
  EXPECT_THROW(open_archive(way)->echo(), InvalidInput);
}

TEST_F(SecureOrthanc, PlainTalkIsRefused) {
  ServerDescription way = server->by_get();
  way.tls = false;
  EXPECT_THROW(open_archive(way)->echo(), Error);
}

}  // namespace
}  // namespace ostia::pacs
