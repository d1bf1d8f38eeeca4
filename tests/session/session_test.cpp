#include "ostia/session/session.h"

#include "case_tools.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;

TEST(Session, WhatIsShownIsWhatIsStored) {
  const TempFolder folder;
  Session session(CaseFile::create(folder / "a.ostia", tube_model()));
  const geometry::Vec3 place(1.65, 0.0, 10.0);
  const double at_first = session.live().field()->value(place);
  const auto done = session.apply(ring(10.0, 1.9));
  EXPECT_FALSE(done.change.box.isEmpty());
  EXPECT_LT(session.live().field()->value(place), at_first);  // the wall went out past the place
  EXPECT_EQ(lumen::digest(session.live().model()), lumen::digest(*session.file().model()));
  ASSERT_TRUE(session.undo());
  EXPECT_NEAR(session.live().field()->value(place), at_first, 1e-6);
  ASSERT_TRUE(session.redo());
  EXPECT_FALSE(session.redo());
  for (const double by : {0.1, 0.2}) session.apply_merged(drag(20.0, by));
  EXPECT_EQ(session.file().edits().size(), 2U);
  const lumen::LiveModel fresh(session.file().model());
  for (const double z : {9.0, 10.0, 19.5, 20.0})
    EXPECT_NEAR(session.live().field()->value({1.6, 0.1, z}), fresh.field()->value({1.6, 0.1, z}), 1e-6);
}

TEST(Session, WhatCannotBeCommittedIsNotShown) {
  const TempFolder folder;
  { CaseFile::create(folder / "a.ostia", tube_model()); }
  Session session = Session::open(folder / "a.ostia", OpenMode::read_only);
  const std::string before = lumen::digest(session.live().model());
  EXPECT_THROW(session.apply(ring(10.0, 1.9)), IoError);
  EXPECT_EQ(lumen::digest(session.live().model()), before);
}

}  // namespace
}  // namespace ostia::session
