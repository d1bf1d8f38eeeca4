#include "ostia/view/evaluability_layer.h"

#include "bench_case.h"

#include <gtest/gtest.h>

namespace ostia::view {
namespace {

using analysis::Evaluability;

class EvaluabilityLayerTest : public ::testing::Test {
 protected:
  session::Workbench& bench() { return tube_.bench; }
  /// From 10 to 20 mm limited, then not evaluable to 25 mm, as if it had been found.
  void find() {
    const auto work = board_.work();
    ASSERT_TRUE(work);
    session::EvaluabilityWork::Found found;
    found.vessel.vessel = work->vessel;
    found.vessel.stretches = {
        {0.0, 10.0, Evaluability::evaluable, {}, false},
        {10.0, 20.0, Evaluability::limited, {analysis::EvaluabilityReason::blurred}, false},
        {20.0, 25.0, Evaluability::not_evaluable, {analysis::EvaluabilityReason::no_clear_edge}, false}};
    ASSERT_TRUE(board_.take(*work, found));
  }
  static std::vector<OverlayBand> bands(const Overlay& overlay) {
    std::vector<OverlayBand> out;
    for (const OverlayBand& band : overlay.bands)
      if (band.role == Role::limited || band.role == Role::not_evaluable) out.push_back(band);
    return out;
  }
  testing::TubeCase tube_;
  session::EvaluabilityBoard board_{tube_.bench};
};

TEST_F(EvaluabilityLayerTest, MarksWhatIsLessThanEvaluableAndSaysWhy) {
  CurvedView view(bench(), CurvedView::Which::first, std::make_shared<CurvedFrame>());
  view.set_size(300, 800, 1.0);
  const EvaluabilityLayer layer(view, board_);
  EXPECT_TRUE(bands(view.overlay()).empty());
  find();
  const auto shown = bands(view.overlay());
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[0].role, Role::limited);
  EXPECT_NEAR(view.abscissa_at(shown[0].low.y()), 10.0, 0.1);
  EXPECT_NEAR(view.abscissa_at(shown[0].high.y()), 20.0, 0.1);
  EXPECT_EQ(shown[1].role, Role::not_evaluable);
  std::string texts;
  for (const OverlayText& text : view.overlay().texts) texts += text.text + "\n";
  EXPECT_NE(texts.find("limited\nthe edge is blurred\n"), std::string::npos);
  EXPECT_NE(texts.find("not evaluable\nno clear edge\n"), std::string::npos);
  board_.shown.set(false);
  EXPECT_TRUE(bands(view.overlay()).empty());
}

TEST_F(EvaluabilityLayerTest, TheProfileHasItToo) {
  ProfileView view(bench());
  view.set_size(600, 200, 1.0);
  view.set_evaluability(&board_);
  find();
  EXPECT_EQ(bands(view.overlay()).size(), 4U);  // a shade and a strip each
  view.set_evaluability(nullptr);
  EXPECT_TRUE(bands(view.overlay()).empty());
}

TEST_F(EvaluabilityLayerTest, TheReadersWordIsOverIt) {
  CurvedView view(bench(), CurvedView::Which::first, std::make_shared<CurvedFrame>());
  view.set_size(300, 800, 1.0);
  const EvaluabilityLayer layer(view, board_);
  find();
  const std::int32_t vessel = bench().vessel.get();
  board_.judge(vessel, 0.0, 25.0, Evaluability::evaluable);
  EXPECT_TRUE(bands(view.overlay()).empty());
  board_.judge(vessel, 0.0, 25.0, std::nullopt);
  EXPECT_EQ(bands(view.overlay()).size(), 2U);
  EXPECT_EQ(text_of({0.0, 1.0, Evaluability::not_evaluable, {}, true}), "not evaluable (reader)");
}

TEST_F(EvaluabilityLayerTest, WhatWasFoundOfAnotherModelIsNotTaken) {
  const auto work = board_.work();
  ASSERT_TRUE(work);
  bench().edit(lumen::VesselRename{bench().vessel.get(), "another"});
  EXPECT_FALSE(board_.take(*work, session::EvaluabilityWork::Found{}));
  EXPECT_TRUE(board_.work());
}

}  // namespace
}  // namespace ostia::view
