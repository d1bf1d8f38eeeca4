#include "pressure/live.h"

#include "shell/desk.h"
#include "views/picture_widget.h"
#include "views/scene_widget.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/along.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int rest_pressures_ms =
    1500;                            // a hand that edits is let alone that long before all is measured anew
constexpr int color_after_ms = 120;  // the tree's colours follow a moment later than the numbers
constexpr double map_low = 0.60, map_high = 1.00;  // the threshold in the middle

double on_curve(const std::vector<session::FfrPoint>& along, double s_mm) {
  return geometry::value_along(along, s_mm, &session::FfrPoint::s_mm, &session::FfrPoint::ffr);
}

}  // namespace

Pressures::Pressures(Desk& desk, const std::vector<PictureWidget*>& pictures, ProfileWidget& profile,
                     SceneWidget& scene)
    : QObject(&desk.window), desk_(desk), board_(desk.bench), profile_(&profile), scene_(&scene) {
  for (PictureWidget* picture : pictures)
    if (auto* curved = dynamic_cast<view::CurvedView*>(&picture->view()))
      layers_.push_back(std::make_unique<view::PressureLayer>(*curved, board_));
  profile.view().set_pressure(&board_);
  quick_.setMaxThreadCount(1);
  slow_.setMaxThreadCount(1);
  const auto once = [this](QTimer& timer, int ms, auto act) {
    timer.setSingleShot(true);
    timer.setInterval(ms);
    connect(&timer, &QTimer::timeout, this, act);
  };
  once(rest_, rest_pressures_ms, [this] { board_.rested(); });
  once(map_soon_, color_after_ms, [this] { show_map(); });
  once(look_soon_, 0, [this] { look(); });
  own_.push_back(desk.bench.model_changed.observe([this](const session::ModelEvent&) {
    if (!edited_) since_edit_.start();
    edited_ = true;
    if (board_.shown.get()) rest_.start();
  }));
  own_.push_back(board_.wanted.observe([this] { look_soon_.start(); }));
  own_.push_back(board_.changed.observe([this] {
    if (!map_soon_.isActive()) map_soon_.start();
  }));
  own_.push_back(board_.shown.observe([this](const bool&) { show_map(); }));
  own_.push_back(map.observe([this](const bool&) { show_map(); }));
}

Pressures::~Pressures() {
  ending_ = true;
  task_.cancel();
  quick_.waitForDone();
  slow_.waitForDone();
  if (profile_) profile_->view().set_pressure(nullptr);
  if (scene_) scene_->set_top_painter({});
}

bool Pressures::idle() const {
  return !board_.shown.get() || !desk_.bench.has_case() ||
         (!board_.behind() && !board_.band_to_come() && !rest_.isActive() && !look_soon_.isActive() &&
          !map_soon_.isActive()) ||
         (!board_.problem().empty() && !board_.in_flight());
}

void Pressures::look() {
  if (ending_) return;
  if (board_.in_flight()) {
    if (long_ && board_.small_waits()) task_.cancel();  // what follows the hand goes first
    return;
  }
  if (const std::optional<session::PressureWork> work = board_.begin()) start(*work);
}

void Pressures::start(const session::PressureWork& work) {
  long_ = work.whole() || work.band;
  task_ = core::TaskContext();
  const bool in_background = long_ && board_.now();
  (in_background ? slow_ : quick_).start([this, work, in_background, task = task_] {
    if (in_background) core::lower_thread_priority();
    std::shared_ptr<const session::PressureReport> found;
    std::string why;
    try {
      found = work.found(task);
    } catch (const Cancelled&) {
    } catch (const std::exception& error) {
      why = error.what();
    }
    QMetaObject::invokeMethod(
        this, [this, work, found, why] { done(work, found, why); }, Qt::QueuedConnection);
  });
}

void Pressures::done(const session::PressureWork& work, std::shared_ptr<const session::PressureReport> found,
                     const std::string& why) {
  if (ending_) return;
  board_.take(work, std::move(found), why);
  look();
  if (edited_ && (!board_.in_flight() || long_) && !board_.small_waits()) {
    edited_ = false;
    behind_ms_ = 1e-6 * static_cast<double>(since_edit_.nsecsElapsed());
  }
}

void Pressures::show_map() {
  if (!scene_) return;
  if (map.get() && board_.shown.get() && board_.now()) {
    scene_->set_top_painter([this](const geometry::TriMesh&) { color_wall(); });
  } else {
    scene_->scene().clear_wall_values();
    scene_->set_top_painter({});
  }
  scene_->repaint_wall();
  scene_->request_render();
}

void Pressures::color_wall() {
  if (!board_.now()) return;
  const std::span<const view::WallPlace> places = scene_->scene().wall_places();
  if (places.empty()) return;
  std::map<std::int32_t, std::vector<session::FfrPoint>> curves;
  std::vector<double> values;
  values.reserve(places.size());
  std::int32_t last = -1;
  const std::vector<session::FfrPoint>* curve = nullptr;
  for (const view::WallPlace& place : places) {
    if (!curve || place.vessel != last) {
      const auto found = curves.find(place.vessel);
      curve =
          found != curves.end()
              ? &found->second
              : &curves.emplace(place.vessel, session::ffr_along(*board_.now(), place.vessel)).first->second;
      last = place.vessel;
    }
    values.push_back(curve->empty() ? std::numeric_limits<double>::quiet_NaN()
                                    : on_curve(*curve, place.s_mm));
  }
  scene_->scene().set_wall_values(std::move(values),
                                  {view::words().ffr, map_low, map_high, view::ColorScale::falling});
}

void Pressures::open_at_cursor() {
  session::WhatIf stretch = board_.stretch_at_cursor();
  stretch.percent = left_percent.get();
  board_.add_what_if(stretch);
}

void Pressures::narrow_at_cursor() {
  session::WhatIf stretch = board_.stretch_at_cursor();
  stretch.kind = session::WhatIfKind::narrow;
  stretch.percent = narrow_percent.get();
  board_.add_what_if(stretch);
}

}  // namespace ostia::workstation
