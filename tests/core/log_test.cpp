#include "ostia/core/log.h"

#include <gtest/gtest.h>

namespace ostia::core {
namespace {

class Log : public ::testing::Test {
 protected:
  ~Log() override { set_log(LogFormat::text, LogLevel::info); }
};

TEST_F(Log, RedactsWhatIdentifiesThePatient) {
  redact_in_logs("DOE^JANE", "patient-1");
  redact_in_logs("/data/DOE^JANE/series", "image-1");
  EXPECT_EQ(redacted("reading /data/DOE^JANE/series/IM1 of DOE^JANE"), "reading image-1/IM1 of patient-1");
  ::testing::internal::CaptureStderr();
  log_warning("DOE^JANE has a missing slice");
  const std::string written = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(written.find("DOE"), std::string::npos);
  EXPECT_NE(written.find("patient-1 has a missing slice"), std::string::npos);
}

TEST_F(Log, TheLastAliasOfASecretCounts) {
  redact_in_logs("/data/roe/heart.nrrd", "image");
  EXPECT_EQ(redacted("reading /data/roe/heart.nrrd"), "reading image");
  redact_in_logs("/data/roe/heart.nrrd", "image-0a1b");
  EXPECT_EQ(redacted("reading /data/roe/heart.nrrd"), "reading image-0a1b");
}

TEST_F(Log, IgnoresSecretsTooShortToMatter) {
  redact_in_logs("a", "X");
  EXPECT_EQ(redacted("a cat"), "a cat");
}

TEST_F(Log, LeavesWordsAloneThatOnlyHoldAShortSecret) {
  redact_in_logs("jane", "patient-2");
  EXPECT_EQ(redacted("jane/1.dcm lies outside of janeway, not /jane."),
            "patient-2/1.dcm lies outside of janeway, not /patient-2.");
}

TEST_F(Log, WritesJsonLines) {
  set_log(LogFormat::json, LogLevel::info);
  ::testing::internal::CaptureStderr();
  log_info("a \"quoted\" word\nand a line");
  const std::string line = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(line.find(R"("level":"info")"), std::string::npos);
  EXPECT_NE(line.find(R"(a \"quoted\" word\u000aand a line)"), std::string::npos);
}

TEST_F(Log, KeepsQuietBelowItsLevel) {
  set_log(LogFormat::text, LogLevel::error);
  ::testing::internal::CaptureStderr();
  log_info("nobody asked");
  log_error("this matters");
  const std::string written = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(written.find("nobody"), std::string::npos);
  EXPECT_NE(written.find("this matters"), std::string::npos);
}

TEST_F(Log, LeavesOrdinaryWordsAlone) {
  never_redact({"out", "surface"});
  redact_in_logs("out", "OUTPUT");
  redact_in_results("surface", "INPUT");
  redact_in_logs("/data/out", "FOLDER");
  EXPECT_EQ(redacted("left out; the surface of /data/out/a"), "left out; the surface of FOLDER/a");
}

TEST_F(Log, ResultsHaveAliasesWhereTheLogHasPaths) {
  redact_in_results("/home/roe/heart.nrrd", "INPUT");
  EXPECT_EQ(redacted("/home/roe/heart.nrrd: coarse"), "INPUT: coarse");
  EXPECT_EQ(redacted_for_log("/home/roe/heart.nrrd: coarse"), "/home/roe/heart.nrrd: coarse");
}

TEST_F(Log, WarningsAreHeardOnceByAllThatListenEvenIfNotShown) {
  set_log(LogFormat::text, LogLevel::error);
  EXPECT_TRUE(heard_warnings().empty()) << "nobody listens";
  log_warning("before");
  const HeardWarnings outer;
  log_warning("first");
  {
    const HeardWarnings inner;
    log_warning("second");
    log_warning("second");
    log_info("no warning");
    EXPECT_EQ(heard_warnings(), std::vector<std::string>{"second"});
  }
  EXPECT_EQ(heard_warnings(), (std::vector<std::string>{"first", "second"}));
}

}  // namespace
}  // namespace ostia::core
