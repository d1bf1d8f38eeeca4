// The editing experiment (docs/experiments/editing.md) through the window's own mouse events: the simulated
// reader's hand moves over the CPR and the cross-section of the program's window, from whole pixel to whole
// pixel, and what it reaches is what it reaches without a window.

#include "window_hand.h"

#include "ostia/evaluation/lumen_scores.h"
#include "ostia/experiments/editing.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/phantom/case_folder.h"
#include "ostia/view/curved_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::TestWindow;
using view::CurvedView;
using view::Vec2;
using view::Vec3;

constexpr double wanted_pixel_mm = 0.05;

/// A case of the phantom with exact contours and its observers', made once.
struct Truth {
  Truth() {
    phantom::SuiteOptions options;
    options.truth_only = true;
    options.report = false;
    phantom::write_suite(folder / "suite", options, {});
    const fs::path dataset = folder / "suite" / "dataset00";
    tree = io::read_centerlines(dataset / "centerlines.vtp");
    contours = io::read_contours(dataset / "contours.json");
    for (const auto& one : contours.sections)
      if (one.observer == experiments::EditingOptions{}.observer && one.boundary == "lumen")
        names.push_back(one.section);
  }
  const geometry::ContourSection& of(const std::string& section, const std::string& observer) const {
    for (const auto& one : contours.sections)
      if (one.section == section && one.observer == observer && one.boundary == "lumen") return one;
    throw std::logic_error("no such section");
  }
  testing::Folder folder;
  geometry::VesselTree tree;
  geometry::ContourSet contours;
  std::vector<std::string> names;
};
const Truth& truth() {
  static const Truth made;
  return made;
}

/// Draws the simulated reader's strokes with the mouse.
class WindowReader {
 public:
  WindowReader(TestWindow& window, const experiments::ReaderOptions& reader) : window_(window) {
    session::Workbench& bench = window.bench();
    bench.tool.set(session::Tool::draw);
    bench.beta_deg.set(reader.beta_deg);
    bench.section_eps_mm.set(reader.eps_mm);
  }
  /// False where the program refused it.
  bool draw(const lumen::Edit& edit) {
    const auto before = window_.bench().session().file().next_undo();
    if (const auto* stroke = std::get_if<lumen::CprStroke>(&edit)) on_cpr(*stroke);
    if (const auto* contour = std::get_if<lumen::SectionContour>(&edit)) on_section(*contour);
    const auto after = window_.bench().session().file().next_undo();
    return after && (!before || after->number > before->number);
  }
  double largest_rounding_px = 0.0, largest_pixel_mm = 0.0;
  int strokes = 0;

 private:
  void on_cpr(const lumen::CprStroke& stroke) {
    session::Workbench& bench = window_.bench();
    auto& widget = window_.picture("cpr1");
    auto& view = dynamic_cast<CurvedView&>(widget.view());
    bench.theta_deg.set(stroke.theta_deg);
    double low = 1e9, high = -1e9;
    for (const Vec3& place : stroke.points) {
      const double s = bench.axis()->nearest_foot(place).s_mm;
      low = std::min(low, s);
      high = std::max(high, s);
    }
    bench.cursor_mm.set(0.5 * (low + high));
    const double pixel = std::max(wanted_pixel_mm, (high - low) / (0.94 * view.height()));
    view.zoom(view.pixel_mm() / pixel, Vec2(view.width() / 2.0, view.height() / 2.0));
    view.pan(Vec2(view.width() / 2.0 - view.axis_at(0.5 * (low + high)).x(),
                  view.height() / 2.0 - view.row_of(0.5 * (low + high))));
    sweep(widget, stroke.points);
  }
  void on_section(const lumen::SectionContour& contour) {
    window_.bench().cursor_mm.set(contour.s_mm);
    auto& widget = window_.picture("section");
    widget.view().fit();
    widget.view().zoom(widget.view().pixel_mm() / wanted_pixel_mm,
                       Vec2(widget.view().width() / 2.0, widget.view().height() / 2.0));
    std::vector<Vec3> around = contour.points;
    around.push_back(around.front());
    sweep(widget, around);
  }
  void sweep(PictureWidget& widget, const std::vector<Vec3>& places) {
    view::PictureView& view = widget.view();
    largest_pixel_mm = std::max(largest_pixel_mm, view.pixel_mm());
    std::vector<QPoint> way;
    for (const Vec3& place : places) {
      const auto at = view.project(place);
      ASSERT_TRUE(at.has_value());
      const QPoint whole(static_cast<int>(std::lround(at->px.x() / view.density())),
                         static_cast<int>(std::lround(at->px.y() / view.density())));
      ASSERT_TRUE(widget.rect().contains(whole)) << at->px.transpose();
      largest_rounding_px =
          std::max(largest_rounding_px, (Vec2(whole.x(), whole.y()) * view.density() - at->px).norm());
      way.push_back(whole);
    }
    testing::sweep(widget, way);
    ++strokes;
  }
  TestWindow& window_;
};

experiments::Distances scored(const lumen::LumenModel& model, const geometry::ContourSection& overlay) {
  const evaluation::SectionScore score = evaluation::LumenResult(lumen::surface_of(model)).score(overlay);
  return {score.msd_mm, score.max_sd_mm, score.dice};
}

struct Outcome {
  double without = 0.0, reader = 0.0, again = 0.0;  // MSD, mm
};

class ExperimentThroughWindow : public ::testing::Test {
 protected:
  /// The case that the run without a window started from, in a window.
  std::unique_ptr<TestWindow> opened(const experiments::SectionRun& run, const std::string& name) {
    const fs::path path = folder_ / (name + ".ostia");
    session::CaseFile::create(path, run.start);
    auto window = std::make_unique<TestWindow>(folder_ / (name + "-state"));
    window->open(path);
    return window;
  }
  testing::Folder folder_;
};

TEST_F(ExperimentThroughWindow, IsAsAccurateAsWithoutAWindow) {
  const experiments::EditingOptions options;
  ASSERT_GE(truth().names.size(), 2U);
  std::vector<Outcome> outcomes;
  double length = 0.0;
  Outcome mean;
  for (const std::string& section : truth().names) {
    SCOPED_TRACE(section);
    const geometry::ContourSection& overlay = truth().of(section, options.observer);
    const experiments::SectionRun run =
        experiments::edit_section(truth().tree, truth().contours, section, options);
    Outcome out;
    out.without = run.last().to_observer.msd_mm;

    // The same reader sees what the window shows and draws on it.
    const auto window = opened(run, section);
    session::Workbench& bench = window->bench();
    const std::int32_t vessel = bench.vessel.get();
    WindowReader hand(*window, options.reader);
    experiments::SimulatedReader reader(overlay, bench.axis(), vessel, options.reader);
    EXPECT_NEAR(scored(*bench.model(), overlay).msd_mm, run.first().to_observer.msd_mm, 0.002);
    int refused = 0;
    while (const auto stroke = reader.next(*bench.session().live().surface(vessel))) {
      if (!hand.draw(stroke->edit)) {
        reader.refused();
        ++refused;
      }
      if (::testing::Test::HasFatalFailure()) return;
    }
    out.reader = scored(*bench.model(), overlay).msd_mm;

    // The very strokes of the run without a window, by the mouse: whole pixels are all that differs.
    const auto second = opened(run, section + "-again");
    WindowReader copy(*second, options.reader);
    for (const lumen::Edit& edit : run.edits) EXPECT_TRUE(copy.draw(edit));
    out.again = scored(*second->bench().model(), overlay).msd_mm;

    std::printf(
        "%s %s %.1f mm: MSD start %.3f, without a window %.4f (%zu strokes), reader in the window %.4f (%d "
        "strokes, %d refused), the same strokes by mouse %.4f; pixels up to %.3f mm, rounding up to %.2f "
        "px\n",
        section.c_str(), overlay.health == geometry::Health::diseased ? "diseased" : "healthy", run.length_mm,
        run.first().to_observer.msd_mm, out.without, run.edits.size(), out.reader, hand.strokes, refused,
        out.again, std::max(hand.largest_pixel_mm, copy.largest_pixel_mm),
        std::max(hand.largest_rounding_px, copy.largest_rounding_px));
    std::fflush(stdout);
    EXPECT_LE(std::max(hand.largest_rounding_px, copy.largest_rounding_px), std::sqrt(0.5) + 1e-6);
    EXPECT_LT(out.reader, 0.12);
    EXPECT_NEAR(out.reader, out.without, 0.025);
    EXPECT_NEAR(out.again, out.without, 0.01);
    mean.without += run.length_mm * out.without;
    mean.reader += run.length_mm * out.reader;
    mean.again += run.length_mm * out.again;
    length += run.length_mm;
  }
  std::printf(
      "all %zu sections, %.0f mm: without a window %.4f, in the window %.4f, the same strokes %.4f mm\n",
      truth().names.size(), length, mean.without / length, mean.reader / length, mean.again / length);
  EXPECT_NEAR(mean.reader / length, mean.without / length, 0.01);
  EXPECT_NEAR(mean.again / length, mean.without / length, 0.004);
}

}  // namespace
}  // namespace ostia::workstation
