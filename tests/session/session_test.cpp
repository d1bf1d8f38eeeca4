#include "ostia/session/session.h"

#include "case_tools.h"

#include "ostia/analysis/lumen_profile.h"
#include "ostia/core/error.h"
#include "ostia/session/replay.h"

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

/// A volume on each side of a seam and one across it, a place, and a diameter.
std::vector<std::int32_t> annotate_tube(Session& session) {
  using analysis::MeasureKind;
  const auto add = [&](MeasureKind kind, double from_mm, double to_mm) {
    MeasureAdd one = added(kind);
    one.measurement.from_mm = from_mm;
    one.measurement.to_mm = to_mm;
    if (kind == MeasureKind::diameter) one.measurement.points = {{1.5, 0.0, from_mm}, {-1.5, 0.0, from_mm}};
    session.annotate(one);
  };
  add(MeasureKind::volume, 2.0, 10.0);
  add(MeasureKind::stenosis, 10.0, 20.0);
  add(MeasureKind::volume, 18.0, 28.0);
  add(MeasureKind::ring_hu, 5.0, 5.0);
  add(MeasureKind::ring_hu, 25.0, 25.0);
  add(MeasureKind::diameter, 22.0, 22.0);
  session.annotate(added(MeasureKind::distance));
  session.annotate(marked("done"));
  return {tube_vessel, -1, -1, tube_vessel, -1, -1, 0};
}

TEST(Session, MeasurementsGoWithThePartOfASplitVesselThatTheyLieOn) {
  const TempFolder folder;
  Session session(CaseFile::create(folder / "a.ostia", tube_model()));
  std::vector<std::int32_t> where = annotate_tube(session);
  const std::string before = text_of(*session.file().annotations());
  const std::string model = lumen::digest(*session.file().model());
  const auto done = session.apply(lumen::BranchSplit{tube_vessel, 15.0, ""});
  EXPECT_EQ(done.annotations.measurements, (std::vector<std::int32_t>{2, 3, 5, 6}));
  EXPECT_TRUE(done.annotations.marks.empty());
  const std::int32_t made = session.file().model()->tree.vessels[1].id;
  const auto annotations = session.file().annotations();
  for (std::size_t i = 0; i < where.size(); ++i)
    EXPECT_EQ(annotations->measurements[i].vessel, where[i] < 0 ? made : where[i]) << i;
  EXPECT_TRUE(find_orphans(*annotations, *session.file().model()).measurements.empty());
  EXPECT_NE(find_mark(*annotations, tube_vessel), nullptr);
  EXPECT_EQ(find_mark(*annotations, made), nullptr);
  // What lies across the seam measures what it did.
  const auto context = [&] {
    analysis::MeasureContext all;
    all.model = &session.live().model();
    all.surface_of = [&](std::int32_t id) { return session.live().surface(id); };
    return all;
  };
  analysis::LumenProfile profile = analysis::lumen_profile(
      session.live().model(), [&](std::int32_t id) { return session.live().surface(id); }, made);
  analysis::MeasureContext here = context();
  here.profile_of = [&](std::int32_t) -> const analysis::LumenProfile& { return profile; };
  analysis::Measurement across = annotations->measurements[2];
  across.from_mm = 10.0;
  across.to_mm = 20.0;
  EXPECT_NEAR(analysis::measured(across, here).front().value, 10.0 * std::numbers::pi * 1.5 * 1.5, 1.5);

  const auto undone = session.undo();
  ASSERT_TRUE(undone);
  EXPECT_EQ(undone->annotations.measurements.size(), 4U);
  EXPECT_EQ(text_of(*session.file().annotations()), before);
  EXPECT_EQ(lumen::digest(*session.file().model()), model);
  ASSERT_TRUE(session.redo());
  const auto merged = session.apply(lumen::BranchMerge{made});
  EXPECT_EQ(merged.annotations.measurements.size(), 4U);
  EXPECT_EQ(text_of(*session.file().annotations()), before);
  ASSERT_TRUE(session.undo());
  ASSERT_TRUE(session.undo());
  EXPECT_EQ(text_of(*session.file().annotations()), before);
  EXPECT_EQ(lumen::digest(*session.file().model()), model);
  EXPECT_EQ(lumen::digest(session.live().model()), model);
}

TEST(Session, MeasurementsStayAtTheirPlacesOfAVesselThatIsCutAndConnected) {
  const TempFolder folder;
  Session session(CaseFile::create(folder / "a.ostia", tube_model()));
  annotate_tube(session);
  const std::string before = text_of(*session.file().annotations());
  const auto was = session.file().annotations()->measurements;
  session.apply(lumen::BranchCut{tube_vessel, 15.0, ""});
  const std::int32_t made = session.file().model()->tree.vessels[1].id;
  const double cut = lumen::vessel(*session.file().model(), tube_vessel).axis->length();
  const auto parts = session.file().annotations()->measurements;
  std::size_t gone = 0;
  for (std::size_t i = 0; i < was.size(); ++i) {
    if (parts[i].vessel != made) {
      EXPECT_EQ(parts[i].vessel, was[i].vessel) << i;
      EXPECT_EQ(parts[i].from_mm, was[i].from_mm) << i;
      continue;
    }
    ++gone;
    EXPECT_NEAR(parts[i].to_mm, std::max(0.0, was[i].to_mm - cut), 0.01) << i;
    EXPECT_NEAR(parts[i].from_mm, std::max(0.0, was[i].from_mm - cut), 0.01) << i;
  }
  EXPECT_EQ(gone, 4U);
  session.apply(lumen::BranchConnect{made, tube_vessel,
                                     lumen::vessel(*session.file().model(), tube_vessel).axis->point(10.0)});
  const auto joined = session.file().annotations()->measurements;
  for (std::size_t i = 0; i < was.size(); ++i)
    if (parts[i].vessel == made && parts[i].from_mm > 0.0) {
      EXPECT_NEAR(joined[i].from_mm, was[i].from_mm, 0.3) << i;  // the new piece is as long as the old one
    }
  ASSERT_TRUE(session.undo());
  ASSERT_TRUE(session.undo());
  EXPECT_EQ(text_of(*session.file().annotations()), before);
}

TEST(Session, ASplitVesselIsReadAgainAsItWas) {
  const TempFolder folder;
  std::string model, annotations;
  {
    Session session(CaseFile::create(folder / "a.ostia", y_model()));
    const std::int32_t first = session.file().model()->tree.vessels[0].id;
    session.apply(lumen::BranchSplit{first, 8.0, ""});
    session.apply(lumen::BranchSplit{session.file().model()->tree.vessels[1].id, 21.0, "end"});
    session.apply(lumen::BranchMerge{session.file().model()->tree.vessels[1].id});
    session.undo();
    model = lumen::digest(*session.file().model());
    EXPECT_EQ(lumen::digest(session.live().model()), model);
  }
  Session again = Session::open(folder / "a.ostia");
  EXPECT_EQ(lumen::digest(*again.file().model()), model);
  EXPECT_TRUE(replay(again.file()).same());
  while (again.undo()) {
  }
  EXPECT_EQ(lumen::digest(*again.file().model()), lumen::digest(y_model()));
}

}  // namespace
}  // namespace ostia::session
