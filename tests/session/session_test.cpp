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

TEST(Session, AnnotationsAndEditsAreUndoneInOneOrder) {
  const TempFolder folder;
  Session session(CaseFile::create(folder / "a.ostia", tube_model()));
  const auto noted = session.annotate(added(analysis::MeasureKind::distance));
  EXPECT_FALSE(noted.edited);
  EXPECT_EQ(noted.annotations.measurements, std::vector<std::int32_t>{1});
  EXPECT_TRUE(noted.change.box.isEmpty());
  EXPECT_TRUE(session.apply(ring(10.0, 1.9)).edited);
  session.annotate_merged(moved(session.file(), 1, 2.0), 1);
  session.annotate_merged(moved(session.file(), 1, 3.0), 1);
  auto undone = session.undo();
  ASSERT_TRUE(undone);
  EXPECT_FALSE(undone->edited);
  EXPECT_TRUE(undone->change.box.isEmpty());
  EXPECT_EQ(undone->annotations.measurements, std::vector<std::int32_t>{1});
  undone = session.undo();
  EXPECT_TRUE(undone->edited);
  EXPECT_FALSE(undone->change.box.isEmpty());
  EXPECT_TRUE(undone->annotations.empty());
  EXPECT_TRUE(session.undo());
  EXPECT_FALSE(session.undo());
  EXPECT_EQ(lumen::digest(session.live().model()), lumen::digest(tube_model()));
}

TEST(Session, AJumpIsSolvedOnce) {
  const TempFolder folder;
  Session session(CaseFile::create(folder / "a.ostia", tube_model()));
  session.apply(ring(10.0, 1.9));
  session.annotate(marked("seen"));
  session.apply(ring(20.0, 1.2));
  session.apply(lumen::AxisTrim{tube_vessel, 27.0});
  const std::string last = lumen::digest(session.live().model());
  const auto back = session.go_to_step(1);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->edited);
  EXPECT_EQ(back->annotations.marks, std::vector<std::int32_t>{tube_vessel});
  EXPECT_EQ(back->outcome.changes.size(), 1U);
  EXPECT_EQ(lumen::digest(session.live().model()), lumen::digest(tube_model()));
  const lumen::LiveModel fresh(session.file().model());
  for (const double z : {9.0, 15.0, 20.0, 29.0})
    EXPECT_NEAR(session.live().field()->value({1.4, 0.2, z}), fresh.field()->value({1.4, 0.2, z}), 1e-6);
  ASSERT_TRUE(session.go_to_step(5));
  EXPECT_EQ(lumen::digest(session.live().model()), last);
  EXPECT_FALSE(session.go_to_step(5));
  EXPECT_THROW(session.go_to_step(7), InvalidInput);
}

}  // namespace
}  // namespace ostia::session
