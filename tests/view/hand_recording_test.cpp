#include "ostia/view/hand_recording.h"

#include "case_tools.h"
#include "schema_rules.h"

#include "ostia/core/error.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

namespace ostia::view {
namespace {

using session::Tool;
using ::testing::HasSubstr;
namespace tools = session::testing;

/// A workbench with two CPRs and a section, and a hand in each.
struct Table {
  explicit Table(const std::filesystem::path& file, int size = 500) {
    bench.set_session(session::Session::open(file));
    cpr.set_size(size, size + 100, 1.0);
    twin.set_size(size, size + 100, 1.0);
    section.set_size(size, size, 1.0);
  }
  template <class To>
  void with_all(To& to, void (To::*add)(const std::string&, PictureView&, Pointer&)) {
    (to.*add)("cpr1", cpr, on_cpr);
    (to.*add)("cpr2", twin, on_twin);
    (to.*add)("section", section, on_section);
  }
  std::string digest() const { return lumen::digest(*bench.model()); }
  session::Workbench bench;
  std::shared_ptr<CurvedFrame> frame = std::make_shared<CurvedFrame>();
  CurvedView cpr{bench, CurvedView::Which::first, frame}, twin{bench, CurvedView::Which::second, frame};
  SectionView section{bench, 0.0};
  Pointer on_cpr{cpr}, on_twin{twin}, on_section{section};
};

PointerEvent at(const Vec2& px, Button button = Button::none) {
  PointerEvent event;
  event.px = px;
  event.button = button;
  return event;
}

void sweep(Pointer& hand, const std::vector<Vec2>& way) {
  hand.move(at(way.front()));
  hand.press(at(way.front(), Button::left));
  for (const Vec2& px : way) hand.move(at(px));
  hand.release(at(way.back(), Button::left));
}

Vec2 shown(PictureView& view, const Vec3& place) {
  const auto found = view.project(place);
  return found ? found->px : Vec2::Zero();
}

/// Everything a session has: strokes in all views, a pull, a ball, undo, zoom, turning, a measurement, a new
/// name from a list, and a stroke that the program refuses.
void work(Table& t) {
  const auto axis = t.bench.axis();
  t.bench.cursor_mm.set(12.0);
  t.bench.tool.set(Tool::draw);
  std::vector<Vec2> stroke;
  for (double s = 8.0; s <= 16.0; s += 0.25)
    stroke.push_back(shown(t.cpr, axis->place(s, 0.0, 1.5 + 0.4 * std::sin((s - 8.0) / 8.0 * 3.14))));
  sweep(t.on_cpr, stroke);
  t.on_cpr.wheel(2.0, [&] {
    PointerEvent event = at({200.0, 300.0});
    event.control = true;
    return event;
  }());
  t.bench.theta_deg.set(37.5);
  stroke.clear();
  for (double s = 10.0; s <= 15.0; s += 0.2)
    stroke.push_back(shown(t.twin, axis->place(s, (37.5 + 90.0) * M_PI / 180.0, 1.2)));
  sweep(t.on_twin, stroke);
  t.bench.cursor_mm.set(20.0);
  std::vector<Vec2> ring;
  for (int i = 0; i <= 40; ++i) ring.push_back(shown(t.section, axis->place(20.0, 2 * M_PI * i / 40.0, 1.8)));
  sweep(t.on_section, ring);
  t.bench.undo();
  t.bench.tool.set(Tool::drag);
  const Vec2 wall = shown(t.cpr, axis->place(12.0, 37.5 * M_PI / 180.0 + M_PI, 1.5));
  if (const auto hit = t.cpr.wall_near(wall, 200.0))
    sweep(t.on_cpr, {hit->px, hit->px + Vec2(-5, 1), hit->px + Vec2(-12, 2), hit->px + Vec2(-15, 2)});
  t.bench.tool.set(Tool::brush);
  t.bench.brush_mm.set(0.8);
  t.bench.cursor_mm.set(17.0);
  sweep(t.on_section,
        {shown(t.section, axis->place(17.0, 1.0, 0.9)), shown(t.section, axis->place(17.0, 1.0, 1.2))});
  t.bench.tool.set(Tool::distance);
  sweep(t.on_section, {Vec2(100, 100), Vec2(150, 180), Vec2(200, 210)});
  t.bench.edit(tools::renamed("renamed from a list"));
  t.bench.tool.set(Tool::draw);  // across the axis: no wall runs there
  try {
    sweep(t.on_cpr, {shown(t.cpr, axis->place(9.0, 0, 0.02)), shown(t.cpr, axis->place(11.0, 0, -0.02)),
                     shown(t.cpr, axis->place(9.5, 0, 0.01))});
  } catch (const InvalidInput&) {
  }
}

class HandRecordingTest : public ::testing::Test {
 protected:
  HandRecordingTest() {
    session::CaseFile::create(folder_ / "a.ostia", tools::tube_model()).copy_to(folder_ / "b.ostia");
  }
  HandRecording record(std::string& digest) {
    Table table(folder_ / "a.ostia");
    HandRecorder recorder(table.bench, folder_ / "hand.jsonl");
    table.with_all(recorder, &HandRecorder::watch);
    work(table);
    EXPECT_GT(recorder.lines(), 100U);
    recorder.stop();
    EXPECT_FALSE(recorder.active());
    digest = table.digest();
    return read_hand_recording(folder_ / "hand.jsonl");
  }
  tools::TempFolder folder_;
};

TEST_F(HandRecordingTest, ReplayedItGivesTheSameModelToTheLastBit) {
  std::string digest;
  const HandRecording recording = record(digest);
  EXPECT_NE(recording.start_digest, digest);
  EXPECT_EQ(recording.end_digest, digest);
  Table table(folder_ / "b.ostia", 311);  // another window altogether
  HandReplay replay(table.bench, recording);
  table.with_all(replay, &HandReplay::drive);
  replay.begin();
  EXPECT_FALSE(replay.same().has_value());
  while (replay.step()) {
  }
  EXPECT_EQ(replay.done(), recording.lines.size());
  EXPECT_EQ(table.digest(), digest);
  EXPECT_EQ(replay.same(), true);
  EXPECT_EQ(replay.refused(), 1U);  // as it was then
  EXPECT_EQ(table.bench.session().file().annotations()->measurements.size(), 1U);
  EXPECT_EQ(table.bench.vessel_name(tools::tube_vessel), "renamed from a list");
  // The undone ring, and what came after, are steps of this case as they were of that.
  const auto ops = [](const std::filesystem::path& path) {
    std::vector<std::string> names;
    for (const auto& entry : session::CaseFile::open(path, session::OpenMode::read_only).journal())
      names.push_back(entry.op + " " + (entry.kind == session::StepKind::edit ? entry.parameters : ""));
    return names;
  };
  table.bench.close_case();
  EXPECT_EQ(ops(folder_ / "a.ostia"), ops(folder_ / "b.ostia"));
}

/// Measurements along the vessel: placed, moved on either CPR, taken away, and moved from elsewhere (the tree
/// in space, a list), where a drag is one step, too.
void measure(Table& t) {
  t.bench.cursor_mm.set(12.0);
  const auto row = [&](CurvedView& view, double s) { return Vec2(view.width() / 2.0, view.row_of(s)); };
  const auto end = [&](CurvedView& view, double s) { return Vec2(view.width() - 8.0, view.row_of(s)); };
  t.bench.tool.set(Tool::volume);
  sweep(t.on_cpr, {row(t.cpr, 8.0), row(t.cpr, 14.0), row(t.cpr, 20.0)});
  sweep(t.on_cpr, {end(t.cpr, 20.0), end(t.cpr, 17.3), end(t.cpr, 16.1)});
  sweep(t.on_twin, {end(t.twin, 8.0), end(t.twin, 6.0), end(t.twin, 6.7)});
  t.bench.tool.set(Tool::stenosis);
  sweep(t.on_twin, {row(t.twin, 9.0), row(t.twin, 15.0), row(t.twin, 19.0)});
  t.bench.tool.set(Tool::ring_hu);
  for (const double s : {7.5, 18.0}) sweep(t.on_cpr, {row(t.cpr, s)});
  sweep(t.on_cpr, {end(t.cpr, 18.0), end(t.cpr, 20.0), end(t.cpr, 22.0)});
  t.on_cpr.erase(at(end(t.cpr, 7.5)));
  sweep(t.on_twin, {end(t.twin, 19.0), end(t.twin, 24.0), end(t.twin, 12.5)});
  t.bench.undo();
  analysis::Measurement stenosis = t.bench.session().file().annotations()->measurements.at(1);
  for (const double s : {10.0, 10.5, 11.25}) {
    stenosis.from_mm = s;
    t.bench.annotate_merged(session::MeasureChange{stenosis}, 7001);
  }
  t.bench.tool.set(Tool::browse);
  sweep(t.on_cpr, {row(t.cpr, 12.0)});
}

TEST_F(HandRecordingTest, MovesOfMeasurementsAlongTheVesselAreReplayedToTheLastBit) {
  Table first(folder_ / "a.ostia");
  HandRecorder recorder(first.bench, folder_ / "hand.jsonl");
  first.with_all(recorder, &HandRecorder::watch);
  measure(first);
  recorder.stop();
  Table again(folder_ / "b.ostia", 311);
  HandReplay replay(again.bench, read_hand_recording(folder_ / "hand.jsonl"));
  again.with_all(replay, &HandReplay::drive);
  replay.begin();
  while (replay.step()) {
  }
  EXPECT_EQ(replay.refused(), 0U);
  const auto made = [](const Table& t) { return t.bench.session().file().annotations()->measurements; };
  ASSERT_EQ(made(first).size(), 3U);
  EXPECT_NEAR(made(first)[0].from_mm, 6.7, 1e-6);
  EXPECT_NEAR(made(first)[0].to_mm, 16.1, 1e-6);
  EXPECT_EQ(made(first)[1].from_mm, 11.25);
  EXPECT_NEAR(made(first)[1].to_mm, 19.0, 1e-6);
  EXPECT_NEAR(made(first)[2].from_mm, 22.0, 1e-6);
  // All of it, and each step back.
  do {
    ASSERT_EQ(made(again).size(), made(first).size());
    for (std::size_t i = 0; i < made(first).size(); ++i)
      EXPECT_TRUE(session::same(made(again)[i], made(first)[i])) << i;
    ASSERT_EQ(again.bench.undo(), first.bench.undo());
  } while (!made(first).empty());
  EXPECT_TRUE(made(again).empty());
}

TEST_F(HandRecordingTest, ASecondReplayOnAnotherModelIsRefused) {
  std::string digest;
  const HandRecording recording = record(digest);
  Table table(folder_ / "a.ostia");  // where it ended
  HandReplay replay(table.bench, recording);
  table.with_all(replay, &HandReplay::drive);
  EXPECT_THROW(replay.begin(), InvalidInput);
  Table other(folder_ / "b.ostia");
  HandReplay without(other.bench, recording);
  without.drive("cpr1", other.cpr, other.on_cpr);
  try {
    without.begin();
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("cpr2"));
  }
}

TEST_F(HandRecordingTest, EveryLineIsReadAsItWasWritten) {
  std::string digest;
  const HandRecording recording = record(digest);
  bool stateful = false, framed = false, commanded = false;
  for (const HandLine& line : recording.lines) {
    const std::string text = to_json(line);
    EXPECT_EQ(to_json(hand_line_of_json(text)), text);
    stateful = stateful || line.state;
    framed = framed || line.frame;
    commanded = commanded || !line.command.empty();
  }
  EXPECT_TRUE(stateful && framed && commanded);
  const std::string bytes = tools::bytes_of_file(folder_ / "hand.jsonl");
  EXPECT_EQ(bytes.find(folder_.path().string()), std::string::npos);
}

TEST_F(HandRecordingTest, ItsSchemaKnowsEveryLineAndEveryField) {
  std::string digest;
  (void)record(digest);
  const tools::Schema schema("hand-recording.schema.json");
  std::istringstream file(tools::bytes_of_file(folder_ / "hand.jsonl"));
  std::set<std::string> seen, kinds;
  for (std::string text; std::getline(file, text);) {
    const tools::Json line = tools::Json::parse(text);
    const std::string kind = line.contains("kind")         ? "begin"
                             : line.contains("end_digest") ? "end"
                             : line.contains("command")    ? "command"
                                                           : "act";
    kinds.insert(kind);
    EXPECT_TRUE(schema.is_valid(schema.definition(kind), line)) << text;
    if (kind == "act") seen.merge(tools::names_in(line));
    if (!line.contains("state")) continue;
    tools::Json broken = line;
    broken["state"].erase("tool");
    EXPECT_FALSE(schema.is_valid(schema.definition(kind), broken));
    EXPECT_THROW(hand_line_of_json(broken.dump()), InvalidInput);
  }
  EXPECT_EQ(kinds.size(), 4U);
  EXPECT_EQ(seen, tools::names_in(schema.definition("act")["properties"]));
}

TEST_F(HandRecordingTest, OneThatWasBrokenOffIsReadToItsLastWholeLine) {
  std::string digest;
  const HandRecording whole = record(digest);
  const std::string bytes = tools::bytes_of_file(folder_ / "hand.jsonl");
  const std::size_t last = bytes.rfind("\n{", bytes.size() - 2);
  tools::write_bytes(folder_ / "cut.jsonl", bytes.substr(0, last - 10));
  const HandRecording cut = read_hand_recording(folder_ / "cut.jsonl");
  EXPECT_TRUE(cut.end_digest.empty());
  EXPECT_EQ(cut.lines.size(), whole.lines.size() - 1);
}

TEST_F(HandRecordingTest, RefusesWhatIsNoRecording) {
  const auto why = [&](const std::string& text) {
    tools::write_bytes(folder_ / "bad.jsonl", text);
    try {
      read_hand_recording(folder_ / "bad.jsonl");
      return std::string("read");
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
  };
  const std::string head = R"({"v":1,"kind":"ostia.hand","start_digest":")" + std::string(64, 'a') + "\"}\n";
  EXPECT_EQ(why(head), "read");
  EXPECT_THAT(why(""), HasSubstr("empty"));
  EXPECT_THAT(why("{}\n"), HasSubstr("kind"));
  EXPECT_THAT(why(R"({"v":2,"kind":"ostia.hand"})"), HasSubstr("newer"));
  EXPECT_THAT(why(head + "nonsense\n"), HasSubstr("line 2"));
  EXPECT_THAT(why(head + R"({"t_ms":1,"view":"cpr1","act":"kick","px":[1,2]})" + "\n"), HasSubstr("act"));
  EXPECT_THAT(why(head + R"({"t_ms":1,"view":"cpr1","act":"press","px":[1]})" + "\n"), HasSubstr("px"));
  EXPECT_THAT(why(head + R"({"t_ms":-1,"view":"cpr1","act":"leave"})" + "\n"), HasSubstr("t_ms"));
  EXPECT_THAT(why(head + R"({"t_ms":5,"view":"c","act":"leave"})" + "\n" +
                  R"({"t_ms":4,"view":"c","act":"leave"})" + "\n"),
              HasSubstr("backwards"));
  EXPECT_THAT(why(head + R"({"t_ms":5,"command":7})" + "\n"), HasSubstr("command"));
  EXPECT_THROW(read_hand_recording(folder_ / "nowhere.jsonl"), IoError);
}

TEST_F(HandRecordingTest, WhatEscapeTookBackIsTakenBackOnceInAReplay) {
  Table table(folder_ / "a.ostia");
  HandRecorder recorder(table.bench, folder_ / "x.jsonl");
  table.with_all(recorder, &HandRecorder::watch);
  table.bench.cursor_mm.set(12.0);
  table.bench.tool.set(Tool::brush);
  table.bench.brush_mm.set(0.8);
  const auto place = [&](double away_mm) {
    return shown(table.section, table.bench.axis()->place(table.bench.cursor_mm.get(), 1.0, away_mm));
  };
  sweep(table.on_section, {place(0.9), place(1.2)});
  const std::string kept = table.digest();
  table.bench.cursor_mm.set(17.0);
  table.on_section.press(at(place(0.9), Button::left));
  table.on_section.move(at(place(1.2)));
  EXPECT_NE(table.digest(), kept);
  table.on_section.cancel();
  table.on_section.release(at(place(1.2), Button::left));
  EXPECT_EQ(table.digest(), kept);
  table.bench.edit(tools::renamed("renamed from a list"));
  recorder.stop();
  Table again(folder_ / "b.ostia");
  HandReplay replay(again.bench, read_hand_recording(folder_ / "x.jsonl"));
  again.with_all(replay, &HandReplay::drive);
  replay.begin();
  while (replay.step()) {
  }
  EXPECT_EQ(replay.refused(), 0U);
  EXPECT_EQ(replay.same(), true);
  EXPECT_EQ(again.bench.session().file().edits().size(), 2U);
}

TEST_F(HandRecordingTest, ARecorderNeedsACaseAFileAndNames) {
  session::Workbench empty;
  EXPECT_THROW(HandRecorder(empty, folder_ / "x.jsonl"), InvalidInput);
  Table table(folder_ / "a.ostia");
  EXPECT_THROW(HandRecorder(table.bench, folder_ / "no" / "folder.jsonl"), IoError);
  HandRecorder recorder(table.bench, folder_ / "x.jsonl");
  recorder.watch("cpr1", table.cpr, table.on_cpr);
  EXPECT_THROW(recorder.watch("cpr1", table.twin, table.on_twin), InvalidInput);
  table.bench.close_case();
  EXPECT_FALSE(recorder.active());
}

TEST_F(HandRecordingTest, AViewShowsTheSameAfterItsFramingIsSetBack) {
  Table table(folder_ / "a.ostia");
  table.cpr.zoom(1.7, {100, 200});
  table.cpr.pan({13, -4});
  const std::vector<double> framing = table.cpr.framing();
  const std::optional<Vec3> place = table.cpr.world({123.0, 321.0});
  table.cpr.fit();
  EXPECT_NE(table.cpr.world({123.0, 321.0}), place);
  table.cpr.set_framing(framing);
  EXPECT_EQ(table.cpr.world({123.0, 321.0}), place);
  table.section.zoom(2.0, {10, 20});
  const std::vector<double> flat = table.section.framing();
  const std::optional<Vec3> before = table.section.world({77.0, 66.0});
  table.section.fit();
  table.section.set_framing(flat);
  EXPECT_EQ(table.section.world({77.0, 66.0}), before);
  EXPECT_THROW(table.section.set_framing({1.0}), InvalidInput);
  EXPECT_THROW(table.section.set_framing({-1.0, 0.0, 0.0}), InvalidInput);
  EXPECT_THROW(table.cpr.set_framing({1.0, std::nan(""), 0.0, 0.0}), InvalidInput);
}

TEST_F(HandRecordingTest, APointerTellsOfEachCallOnce) {
  Table table(folder_ / "a.ostia");
  std::vector<HandAct::Kind> told;
  int after = 0;
  const session::Subscription a =
      table.on_cpr.acting.observe([&](const HandAct& act) { told.push_back(act.kind); });
  const session::Subscription b = table.on_cpr.acted.observe([&] { ++after; });
  table.on_cpr.press(at({100, 100}, Button::left));
  table.on_cpr.move(at({101, 120}));
  table.on_cpr.release(at({101, 120}, Button::left));
  table.bench.tool.set(Tool::draw);  // drops what is begun, and is no act of a hand
  table.on_cpr.cancel();
  using Kind = HandAct::Kind;
  EXPECT_THAT(told, ::testing::ElementsAre(Kind::press, Kind::move, Kind::release, Kind::cancel));
  EXPECT_EQ(after, 4);
}

}  // namespace
}  // namespace ostia::view
