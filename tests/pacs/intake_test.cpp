// What is taken of what comes, and what a fetch makes of it.

#include "intake.h"

#include "shared_data.h"
#include "small_series.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>

namespace ostia::pacs {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::replaced;
using testing::small_series;
using testing::SmallSeries;
using Steps = std::vector<std::function<void(Intake&)>>;

void give(Intake& intake, const std::string& bytes) {
  const std::filesystem::path part = intake.next_part();
  core::write_file(part, bytes);
  intake.take(part);
}

/// An archive that lists a series and, with each request, does the next of its steps. `said`: how many images
/// it says that the series has; -1: nothing.
class ScriptedArchive : public Archive {
 public:
  ScriptedArchive(const SmallSeries& series, Steps steps, long said = -1, int attempts = 2)
      : Archive(description(attempts)), series_(series), steps_(std::move(steps)), said_(said) {}
  std::vector<std::vector<std::string>> asked;
  int lists = 0;

  void echo(const core::TaskContext&) override {}
  FindResult find(const Query& query, const core::TaskContext&) override {
    FindResult result;
    if (query.level == Level::study) {
      result.found.emplace_back().patient_id = "PID-1";
      return result;
    }
    if (query.level == Level::series) {
      result.found.emplace_back().series_uid = series_.series_uid;
      result.found.back().images = said_;
      return result;
    }
    ++lists;
    for (const std::string& uid : series_.sop_uids) result.found.emplace_back().sop_uid = uid;
    return result;
  }

 protected:
  void retrieve(const SeriesWanted&, const std::vector<std::string>& missing, Intake& intake,
                const core::TaskContext&) override {
    asked.push_back(missing);
    if (asked.size() <= steps_.size()) steps_[asked.size() - 1](intake);
  }
  void store(const std::vector<std::filesystem::path>&, std::vector<SendResult>&,
             const core::TaskContext&) override {}

 private:
  static ServerDescription description(int attempts) {
    ServerDescription server;
    server.name = "scripted";
    server.attempts = attempts;
    return server;
  }
  const SmallSeries& series_;
  Steps steps_;
  long said_;
};

struct Fetching : ::testing::Test {
  SmallSeries series = small_series("intake");
  std::filesystem::path folder = testing::temporary_folder("fetched"), target = folder / "CT";
  SeriesWanted wanted{series.study_uid, series.series_uid};

  Fetched fetch(Steps steps) { return ScriptedArchive(series, std::move(steps)).fetch(wanted, target); }
  std::string refusal(Steps steps) {
    try {
      fetch(std::move(steps));
    } catch (const Error& error) {
      EXPECT_TRUE(std::filesystem::is_empty(folder)) << "something was left behind";
      return error.what();
    }
    return "no refusal";
  }
};

TEST_F(Fetching, OutOfOrderAndTwiceIsOneOfEach) {
  const Fetched fetched = fetch({[&](Intake& intake) {
    for (const int n : {3, 1, 4, 1, 0, 2, 3}) give(intake, series.bytes[static_cast<std::size_t>(n)]);
  }});
  EXPECT_EQ(fetched.files.size(), 5u);
  EXPECT_EQ(fetched.announced, 5u);
  EXPECT_EQ(fetched.duplicates, 2u);
  EXPECT_THAT(fetched.warnings, ::testing::ElementsAre(HasSubstr("twice")));
  for (const auto& file : fetched.files) EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(std::filesystem::status(target).permissions(), std::filesystem::perms::owner_all);
}

TEST_F(Fetching, WhatABrokenConnectionLeftOutIsAskedForAgain) {
  ScriptedArchive archive(series, {[&](Intake& intake) {
                                     give(intake, series.bytes[0]);
                                     give(intake, series.bytes[2]);
                                     throw NetworkError("broken");
                                   },
                                   [&](Intake& intake) {
                                     for (const int n : {1, 3, 4})
                                       give(intake, series.bytes[static_cast<std::size_t>(n)]);
                                   }});
  EXPECT_EQ(archive.fetch(wanted, target).files.size(), 5u);
  ASSERT_EQ(archive.asked.size(), 2u);
  EXPECT_THAT(archive.asked[0], IsEmpty());
  EXPECT_THAT(archive.asked[1],
              ::testing::UnorderedElementsAre(series.sop_uids[1], series.sop_uids[3], series.sop_uids[4]));
}

/// Gives these images.
Steps::value_type giving(const SmallSeries& series, std::vector<std::size_t> which) {
  return [&series, which = std::move(which)](Intake& intake) {
    for (const std::size_t n : which) give(intake, series.bytes[n]);
  };
}

TEST_F(Fetching, AsManyAsItSaysNeedNoList) {
  ScriptedArchive archive(series, {giving(series, {0, 1, 2, 3, 4})}, 5);
  EXPECT_EQ(archive.fetch(wanted, target).announced, 5u);
  EXPECT_EQ(archive.lists, 0);
  EXPECT_EQ(archive.asked.size(), 1u);
}

TEST_F(Fetching, WhatIsNotAsManyIsListedAndTheRestAskedForInOneAttempt) {
  ScriptedArchive archive(series, {giving(series, {0, 3, 0}), giving(series, {1, 2, 4})}, 5, 1);
  EXPECT_EQ(archive.fetch(wanted, target).files.size(), 5u);
  EXPECT_EQ(archive.lists, 1);
  ASSERT_EQ(archive.asked.size(), 2u);
  EXPECT_THAT(archive.asked[1],
              ::testing::UnorderedElementsAre(series.sop_uids[1], series.sop_uids[2], series.sop_uids[4]));
}

TEST_F(Fetching, ANumberThatIsWrongIsNotBelievedOverTheList) {
  for (const long said : {3L, 9L}) {
    ScriptedArchive archive(series, {giving(series, {0, 1, 2, 3, 4})}, said, 1);
    const auto folder = testing::temporary_folder("wrong") / "CT";
    const Fetched fetched = archive.fetch(wanted, folder);
    EXPECT_EQ(fetched.files.size(), 5u);
    EXPECT_EQ(fetched.announced, 5u);
    EXPECT_TRUE(fetched.warnings.empty());
    EXPECT_EQ(archive.asked.size(), 1u);
  }
}

TEST_F(Fetching, AnIncompleteSeriesIsNotHandedOver) {
  EXPECT_THAT(refusal({[&](Intake& intake) { give(intake, series.bytes[0]); }}),
              HasSubstr("lists 5 images of this series and sent 1"));
}

TEST_F(Fetching, AnotherPatientsImageIsRefusedAndNobodyIsNamed) {
  const std::string said = refusal({[&](Intake& intake) {
    for (std::size_t n = 0; n < 4; ++n) give(intake, series.bytes[n]);
    give(intake, replaced(series.bytes[4], "PID-1", "PID-2"));
  }});
  EXPECT_THAT(said, HasSubstr("'scripted' sent an object of another patient"));
  EXPECT_THAT(said, ::testing::Not(HasSubstr("PID")));
}

TEST_F(Fetching, AnotherSeriesOrGarbageIsRefused) {
  EXPECT_THAT(refusal({[&](Intake& intake) { give(intake, small_series("another").bytes[0]); }}),
              HasSubstr("another study"));
  EXPECT_THAT(refusal({[&](Intake& intake) { give(intake, "<html>please log in</html>"); }}),
              HasSubstr("no DICOM object"));
  EXPECT_THAT(refusal({[&](Intake& intake) { give(intake, ""); }}), HasSubstr("no DICOM object"));
}

TEST_F(Fetching, ACancelLeavesNothing) {
  core::TaskContext task;
  ScriptedArchive archive(series, {[&](Intake& intake) {
                            give(intake, series.bytes[0]);
                            task.cancel();
                          }});
  EXPECT_THROW(archive.fetch(wanted, target, task), Cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(Fetching, AFolderThatIsThereIsNotTouched) {
  std::filesystem::create_directory(target);
  EXPECT_THROW(fetch({}), InvalidInput);
  EXPECT_TRUE(std::filesystem::is_empty(target));
}

}  // namespace
}  // namespace ostia::pacs
