#include "case_tools.h"

#include "ostia/session/image_digest.h"
#include "ostia/session/sample_case.h"
#include "ostia/session/session.h"

#include <gtest/gtest.h>

namespace ostia::session {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;

TEST(SampleCase, IsMadeOnceAndOpens) {
  const TempFolder folder;
  const SampleCase made = sample_case(folder / "sample", phantom::Preset::small);
  const Session session = Session::open(made.case_file);
  EXPECT_GE(session.live().model().vessels.size(), 2U);
  EXPECT_EQ(session.file().image()->sha256, image_reference(made.image).sha256);
  const auto written = fs::last_write_time(made.image);
  sample_case(folder / "sample", phantom::Preset::small);
  EXPECT_EQ(fs::last_write_time(made.image), written);
}

}  // namespace
}  // namespace ostia::session
