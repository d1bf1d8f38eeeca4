#include "ostia/view/picture_view.h"

#include "pointer/measure_marks.h"

#include "ostia/core/parallel.h"
#include "ostia/core/quantity_text.h"
#include "ostia/reformat/plane.h"
#include "ostia/session/beating.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

constexpr double fading_s = 0.8;
constexpr double least_with_phase_units = 110.0;  // of a view's width: narrower ones have a label beside them
constexpr double same_phase = 0.005;              // of the cycle
// Points lie on the wall in any case; chords between them may leave it by a tenth of a pixel.
constexpr lumen::ContourLineOptions screen_lines{.step_px = 3.0, .largest_mm = 0.4, .bend_px = 0.1};

}  // namespace

PictureView::PictureView(session::Workbench& bench) : bench_(bench) {
  keep(bench.image_changed.observe([this] { image_stale(); }));
  keep(bench.case_changed.observe([this] {
    fading_.clear();
    contours_stale();
  }));
  keep(bench.model_changed.observe([this](const session::ModelEvent& event) { on_model_changed(event); }));
  keep(bench.phase_changed.observe([this] {
    cut_.clear();
    size_changed();  // the axis is another, whatever was laid out along it
    image_stale();
  }));
  keep(bench.other_image_changed.observe([this] { image_stale(); }));
  keep(bench.annotations_changed.observe([this] { overlay_stale(); }));
  keep(bench.slab.observe([this](const reformat::Slab&) { image_stale(); }));
  keep(bench.slab_mm.observe([this](const double&) {
    if (bench_.slab.get() != reformat::Slab::none) image_stale();
  }));
  keep(bench.contours_shown.observe([this](const bool&) { overlay_stale(); }));
  keep(bench.marks_shown.observe([this](const bool&) { overlay_stale(); }));
  keep(bench.selected_measurement.observe([this](const std::int32_t&) { overlay_stale(); }));
  keep(bench.tool.observe([this](const session::Tool&) { overlay_stale(); }));
}
PictureView::~PictureView() = default;

void PictureView::set_size(int width, int height, double density) {
  if (width == width_ && height == height_ && density == density_) return;
  width_ = std::clamp(width, 0, 16000);
  height_ = std::clamp(height, 0, 16000);
  density_ = density > 0.0 ? density : 1.0;
  size_changed();
  image_stale();
}

const GreyImage& PictureView::image() {
  if (image_fresh_) return image_;
  draft_ = false;
  image_ = ready() && width_ > 0 && height_ > 0 && bench_.shown_volume() ? make_image() : GreyImage{};
  image_fresh_ = true;
  ++image_revision_;
  return image_;
}

void PictureView::refine() {
  if (!draft_ || !image_fresh_) return;
  refining_ = true;
  image_fresh_ = false;
  stale.tell();
}

void PictureView::prepare() {
  image();
  if (bench_.contours_shown.get()) bring_contours();
}

lumen::ContourLineOptions PictureView::line_options() const {
  return screen_lines;
}

const Overlay& PictureView::overlay() {
  const auto now = std::chrono::steady_clock::now();
  const std::size_t before = fading_.size();
  std::erase_if(fading_, [&](const Fading& one) {
    return std::chrono::duration<double>(now - one.since).count() > fading_s;
  });
  if (overlay_fresh_ && fading_.empty() && before == 0) return overlay_;
  overlay_ = {};
  if (ready() && width_ > 0 && height_ > 0) {
    if (bench_.contours_shown.get()) add_contours(overlay_);
    for (const Layer& layer : layers_)  // of the case's own phase
      if (layer && !bench_.other_phase()) layer(overlay_);
    add_to_overlay(overlay_);
    add_phase(overlay_);
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(overlay_.bands, tool_overlay_.bands);
    append(overlay_.lines, tool_overlay_.lines);
    append(overlay_.marks, tool_overlay_.marks);
    append(overlay_.texts, tool_overlay_.texts);
  }
  overlay_fresh_ = true;
  return overlay_;
}

void PictureView::add_contours(Overlay& overlay) {
  for (const lumen::ContourLine& line : contour_lines()) {
    OverlayLine shown;
    shown.px.reserve(line.picture_px.size());
    const auto end_piece = [&] {
      if (shown.px.size() > 1) overlay.lines.push_back(std::move(shown));
      shown = {};
    };
    for (const Vec2& p : line.picture_px) {
      if (is_torn(p))
        end_piece();
      else
        shown.px.push_back(p - contour_offset());
    }
    end_piece();
  }
}

std::optional<double> PictureView::value_at(const Vec2& px) {
  const GreyImage& shown = image();
  const int x = static_cast<int>(std::floor(px.x())), y = static_cast<int>(std::floor(px.y()));
  if (x < 0 || y < 0 || x >= shown.width || y >= shown.height) return std::nullopt;
  const float value = shown.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(shown.width) +
                                   static_cast<std::size_t>(x)];
  if (!std::isfinite(value)) return std::nullopt;
  return static_cast<double>(value);
}

void PictureView::image_stale() {
  image_fresh_ = false;
  refining_ = false;
  ++placement_revision_;
  lines_state_ = Lines::anew;
  overlay_stale();
}
void PictureView::contours_stale() {
  lines_state_ = Lines::anew;
  overlay_stale();
}
void PictureView::overlay_stale() {
  overlay_fresh_ = false;
  stale.tell();
}

void PictureView::on_model_changed(const session::ModelEvent& event) {
  const auto now = std::chrono::steady_clock::now();
  for (const Vec3& place : event.dismissed) fading_.push_back({place, now});
  if (lines_state_ == Lines::fresh) {
    lines_state_ = Lines::moved;
    lines_changed_ = event.change.box;
  } else if (lines_state_ == Lines::moved) {
    lines_changed_.extend(event.change.box);
  }
  overlay_stale();
}

void PictureView::bring_contours() {
  if (lines_state_ == Lines::fresh) return;
  const bool shown = bench_.has_case() && ready();
  const session::ShownPhase* phase = bench_.other_phase();
  cut_.clear();
  if (!shown || phase) {
    contours_.reset();
    if (shown) cut_ = cut(*phase);
  } else if (lines_state_ == Lines::moved && contours_) {
    contours_->update(*bench_.session().live().field(), lines_changed_);
  } else {
    contours_.reset();
    const std::optional<lumen::ViewSurface> surface = contour_surface();
    std::vector<Vec2> seeds = surface ? contour_seeds() : std::vector<Vec2>{};
    std::erase_if(seeds, [&](const Vec2& p) {
      return !(p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= surface->width && p.y() <= surface->height);
    });
    if (!seeds.empty()) {
      contours_ = std::make_unique<lumen::ViewContours>(*surface, std::move(seeds), line_options());
      contours_->update(*bench_.session().live().field());
    }
  }
  lines_state_ = Lines::fresh;
}

const std::vector<lumen::ContourLine>& PictureView::contour_lines() {
  static const std::vector<lumen::ContourLine> none;
  bring_contours();
  if (!cut_.empty()) return cut_;
  return contours_ ? contours_->lines() : none;
}

std::optional<PictureView::WallHit> PictureView::wall_near(const Vec2& px, double reach_px) {
  WallHit best;
  best.distance_px = reach_px;
  bool found = false;
  const Vec2 at = px + contour_offset();
  for (const lumen::ContourLine& line : contour_lines())
    for (std::size_t i = 0; i + 1 < line.picture_px.size(); ++i) {
      const SegmentFoot foot = foot_on_segment(at, line.picture_px[i], line.picture_px[i + 1]);
      if (foot.distance > best.distance_px || is_torn(line.picture_px[i])) continue;
      best = {(1.0 - foot.t) * line.world[i] + foot.t * line.world[i + 1], foot.place - contour_offset(),
              foot.distance};
      found = true;
    }
  if (!found) return std::nullopt;
  return best;
}

void PictureView::set_layer(Layer layer, LayerPlace place) {
  layers_[static_cast<std::size_t>(place)] = std::move(layer);
  overlay_stale();
}

void PictureView::set_tool_overlay(Overlay overlay) {
  tool_overlay_ = std::move(overlay);
  overlay_stale();
}

std::optional<HandleHit> PictureView::handle_near(const Vec2& px, double reach_px) {
  if (!bench_.has_case() || !bench_.marks_shown.get() || bench_.other_phase()) return std::nullopt;
  std::optional<HandleHit> best;
  double nearest = reach_px;
  for (const analysis::Measurement& one : bench_.session().file().annotations()->measurements)
    for (std::size_t i = 0; i < one.points.size(); ++i) {
      const std::optional<ViewPlace> shown = project(one.points[i]);
      if (!shown || std::abs(shown->out_mm) > mark_reach_mm) continue;
      const double distance = (shown->px - px).norm();
      if (distance > nearest) continue;
      nearest = distance;
      best = HandleHit{one.id, i, false, distance};
    }
  return best;
}

void PictureView::add_measurements(Overlay& overlay, double reach_mm) {
  if (!bench_.has_case() || !bench_.marks_shown.get() || bench_.other_phase()) return;
  for (const analysis::Measurement& one : bench_.session().file().annotations()->measurements)
    if (!one.points.empty()) add_measurement_marks(overlay, *this, one, reach_mm);
}

void PictureView::add_fading(Overlay& overlay, double reach_mm) {
  const auto now = std::chrono::steady_clock::now();
  for (const Fading& one : fading_) {
    const std::optional<ViewPlace> shown = project(one.place);
    if (!shown || std::abs(shown->out_mm) > reach_mm) continue;
    const double age = std::chrono::duration<double>(now - one.since).count();
    overlay.marks.push_back({shown->px, Role::dismissed, 2.5, std::max(0.0, 1.0 - age / fading_s)});
  }
}

void PictureView::add_scale_bar(Overlay& overlay) {
  const ScaleBar bar = scale_bar(pixel_mm(), width());
  if (bar.text.empty() || bar.length_px > 0.9 * width()) return;
  const double x = width() - units(10.0), y = height() - units(10.0), tick = units(4.0);
  overlay.lines.push_back(
      {{Vec2(x - bar.length_px, y - tick), Vec2(x - bar.length_px, y), Vec2(x, y), Vec2(x, y - tick)},
       Role::information});
  overlay.texts.push_back({Vec2(x, y - units(6.0)), bar.text, Role::information, Anchor::bottom_right});
}

void PictureView::add_slab(Overlay& overlay) {
  const reformat::Slab slab = bench_.slab.get();
  if (slab == reformat::Slab::none || width() < units(least_with_phase_units)) return;
  const std::string& name = slab == reformat::Slab::mean      ? words().slab_mean
                            : slab == reformat::Slab::maximum ? words().slab_maximum
                                                              : words().slab_minimum;
  const std::string text = name + " " + core::length_text(bench_.slab_mm.get()) + " mm";
  // Below the line that a window keeps for its grey levels.
  overlay.texts.push_back(
      {Vec2(width() - units(6.0), units(22.0)), text, Role::information, Anchor::top_right});
}

void PictureView::add_phase(Overlay& overlay) {
  const session::ShownPhase* phase = bench_.other_phase();
  if (width() < units(least_with_phase_units)) return;
  const session::OtherImage* other = bench_.other_image();
  if (!phase && other)
    overlay.texts.push_back({Vec2(units(6.0), height() - units(6.0)), other->caption,
                             other->warns ? Role::warning : Role::information, Anchor::bottom_left});
  if (!phase) return;
  const double image = bench_.image_phase();
  std::string text = session::percent_of_cycle(phase->phase());
  const bool same = session::phase_distance(image, phase->phase()) < same_phase || !bench_.shown_volume();
  if (!same) text = words().image + " " + session::percent_of_cycle(image) + ", " + words().tree + " " + text;
  overlay.texts.push_back({Vec2(units(6.0), height() - units(6.0)), text,
                           same ? Role::information : Role::warning, Anchor::bottom_left});
}

void PictureView::add_letters(Overlay& overlay, const Vec3& right, const Vec3& down) {
  const double edge = units(4.0), w = width(), h = height();
  const auto add = [&](const Vec2& px, const Vec3& direction, Anchor anchor) {
    overlay.texts.push_back({px, reformat::patient_letters(direction), Role::information, anchor});
  };
  add(Vec2(edge, h / 2), -right, Anchor::left);
  add(Vec2(w - edge, h / 2), right, Anchor::right);
  add(Vec2(w / 2, edge), -down, Anchor::top);
  add(Vec2(w / 2, h - edge), down, Anchor::bottom);
}

void prepare(const std::vector<PictureView*>& views) {
  core::parallel_for(views.size(), 1, [&](std::size_t i) { views[i]->prepare(); });
}

}  // namespace ostia::view
