#include "views/scene_widget.h"

#include "views/frame_log.h"
#include "views/paint_queue.h"

#include "ostia/core/error.h"
#include "ostia/figure/color.h"
#include "ostia/figure/picture.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/reformat/plane_image.h"
#include "ostia/session/beating.h"
#include "ostia/view/scene_measurements.h"
#include "ostia/view/vessel_colors.h"

#include <QVTKOpenGLWindow.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include <QGuiApplication>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int flight_ms = 250;
constexpr int section_px = 128;
constexpr double section_mm = 16.0;
constexpr int least_with_bar_px = 150;  // of a picture with a bar of colours and a ruler

}  // namespace

SceneWidget::SceneWidget(session::Workbench& bench, Guard guard, QWidget* parent)
    : QWidget(parent),
      bench_(bench),
      window_(new QVTKOpenGLWindow),
      scene_(std::make_unique<view::TreeScene>()),
      pointer_(std::make_unique<view::ScenePointer>(*scene_, bench)),
      guard_(std::move(guard)) {
  setObjectName("tree");
  setAccessibleName(tr("Coronary tree"));
  vtkNew<vtkGenericOpenGLRenderWindow> render_window;
  render_window->SetMultiSamples(0);
  scene_->attach(*render_window);
  scene_->show_front(false);
  scene_->set_angles_shown(true);
  window_->setRenderWindow(render_window);
  window_->installEventFilter(this);
  window_->create();  // the driver is loaded before there is a window that would have to wait
  container_ = QWidget::createWindowContainer(window_, this);
  container_->hide();
  container_->setFocusPolicy(Qt::StrongFocus);
  container_->installEventFilter(this);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(container_);
  flight_.setInterval(16);
  connect(&flight_, &QTimer::timeout, this, [this] {
    const double t = std::min(1.0, static_cast<double>(flight_clock_.elapsed()) / flight_ms);
    scene_->set_pose(view::blended(from_, to_, t));
    if (t >= 1.0) flight_.stop();
    request_render();
  });
  refining_.setSingleShot(true);
  refining_.setInterval(150);
  connect(&refining_, &QTimer::timeout, this, [this] {
    const bool settled = QGuiApplication::mouseButtons() == Qt::NoButton && scene_->settle();
    if (!scene_->refine() && !settled) return;
    window_->renderWindow()->Render();
    refining_.start();
  });
  const auto stale = [this](bool SceneWidget::*what) {
    return [this, what](const auto&...) {
      this->*what = true;
      request_render();
    };
  };
  own_.push_back(bench.case_changed.observe([this] {
    wall_stale_ = styles_stale_ = cursor_stale_ = marks_stale_ = fit_wanted_ = true;
    request_render();
  }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent& event) {
    wall_stale_ = marks_stale_ = true;
    if (event.tree_changed) styles_stale_ = true;
    cursor_stale_ = true;
    request_render();
  }));
  own_.push_back(bench.phase_changed.observe([this] {
    phase_stale_ = cursor_stale_ = marks_stale_ = true;
    request_render();
  }));
  own_.push_back(bench.other_image_changed.observe(stale(&SceneWidget::cursor_stale_)));
  own_.push_back(bench.annotations_changed.observe([this] {
    styles_stale_ = marks_stale_ = true;
    request_render();
  }));
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) {
    styles_stale_ = cursor_stale_ = true;  // the plane, too: the cursor may stay at the same abscissa
    request_render();
  }));
  own_.push_back(bench.cursor_mm.observe(stale(&SceneWidget::cursor_stale_)));
  own_.push_back(bench.theta_deg.observe(stale(&SceneWidget::cursor_stale_)));
  own_.push_back(bench.selected_measurement.observe(stale(&SceneWidget::marks_stale_)));
  own_.push_back(bench.marks_shown.observe(stale(&SceneWidget::marks_stale_)));
  own_.push_back(pointer_->stale.observe([this] { request_render(); }));
  own_.push_back(bench.image_changed.observe([this] {
    cursor_stale_ = marks_stale_ = true;
    scene_->set_volume(nullptr);  // another heart
    if (volume_mode_ != view::VolumeMode::off) emit volume_wanted();
    request_render();
  }));
  own_.push_back(bench.grey.observe([this](const session::GreyWindow& window) {
    scene_->set_volume_window(window.level_hu, window.width_hu);
    cursor_stale_ = true;
    request_render();
  }));
}

SceneWidget::~SceneWidget() {
  window_->removeEventFilter(this);
  // The renderer goes with the scene, the window with the container.
  scene_->detach();
}

void SceneWidget::paintEvent(QPaintEvent*) {
  // OpenGL takes its time to start: in a turn of its own, when all else has been painted once.
  if (container_->isHidden()) QTimer::singleShot(0, container_, &QWidget::show);
}

void SceneWidget::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  scene_->set_pixel_ratio(devicePixelRatioF());
  refresh_identity();
  request_render();
}

/// What changed while it was hidden, behind a tab or beside a panel that was alone, has not been drawn.
void SceneWidget::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  request_render();
}

void SceneWidget::request_render() {
  if (isVisible()) PaintQueue::instance().add_last(this, [this] { refresh(); });
}

void SceneWidget::refresh() {
  QElapsedTimer clock;
  clock.start();
  if (phase_stale_ && !bench_.other_phase()) {
    phase_stale_ = false;
    wall_stale_ = true;  // back where it was
  }
  // The window is to answer between making a wall, taking it into the scene and drawing it. One that has been
  // made is drawn, though the next edit be there already, unless the vessels are others.
  if (wall_stale_ && (!wall_unseen_ || styles_stale_)) {
    make_wall();
    return request_render();
  }
  if (made_wall_) {
    take_wall();
    return request_render();
  }
  if (phase_stale_) refresh_phase();
  if (styles_stale_) refresh_styles();
  if (cursor_stale_) refresh_cursor();
  if (marks_stale_) refresh_measurements();
  if (fit_wanted_ && bench_.has_case()) scene_->set_pose(scene_->pose_from_side(view::ViewFrom::anterior));
  fit_wanted_ = false;
  window_->renderWindow()->SetDPI(72);  // the scene scales its texts itself; Qt's adapter would do it again
  window_->renderWindow()->Render();
  wall_unseen_ = false;
  if (wall_stale_) request_render();
  if (!scene_->front_shown()) {
    scene_->show_front(true);
    request_render();
  }
  // The CT is drawn finer and finer while nothing else is to be done.
  if (buttons_ == Qt::NoButton) refining_.start();
  FrameLog::instance().painted(objectName(), static_cast<double>(clock.nsecsElapsed()) / 1e6);
}

void SceneWidget::make_wall() {
  wall_stale_ = false;
  wall_unseen_ = true;
  made_wall_.reset(), made_of_.reset();
  if (bench_.has_case()) {
    made_of_ = bench_.session().file().model();
    made_wall_ = std::make_shared<const geometry::TriMesh>(bench_.session().live().wall(screen_cell_mm));
  } else {
    wall_.reset();
    scene_->clear_wall();
    if (fit_wanted_) scene_->show_front(false);
  }
}

void SceneWidget::take_wall() {
  wall_ = std::exchange(made_wall_, nullptr);
  scene_->set_wall(wall_, *std::exchange(made_of_, nullptr));
  paint_wall();
  if (!fit_wanted_) return;
  scene_->show_front(false);  // another case: much is new
  refresh_styles();
}

QColor SceneWidget::color_of(std::int32_t vessel) const {
  if (!bench_.axis(vessel)) return QColor(Qt::gray);
  const figure::Color color = view::vessel_color(bench_, vessel);
  return QColor::fromRgbF(color.r, color.g, color.b);
}

void SceneWidget::set_wall_painter(std::function<void(const geometry::TriMesh&)> painter) {
  wall_painter_ = std::move(painter);
}

void SceneWidget::set_top_painter(std::function<void(const geometry::TriMesh&)> painter) {
  top_painter_ = std::move(painter);
}

void SceneWidget::paint_wall() {
  if (wall_painter_) wall_painter_(*wall_);
  if (top_painter_) top_painter_(*wall_);
}

void SceneWidget::repaint_wall() {
  if (!wall_ || wall_stale_ || !(wall_painter_ || top_painter_)) return;
  paint_wall();
  request_render();
}

void SceneWidget::refresh_phase() {
  if (wall_stale_) return;  // the wall that is there is not yet the one that moves
  phase_stale_ = false;
  const session::ShownPhase* phase = bench_.other_phase();
  if (!phase || !wall_ || wall_->points.size() != phase->wall()->points.size()) return;
  std::vector<std::shared_ptr<const geometry::AxisCurve>> axes;
  for (const auto& vessel : bench_.model()->vessels) axes.push_back(phase->axis(vessel->vessel).curve());
  scene_->move_wall(phase->wall(), axes);
}

void SceneWidget::refresh_styles() {
  styles_stale_ = false;
  if (!bench_.has_case()) return;
  const auto annotations = bench_.session().file().annotations();
  for (const auto& vessel : bench_.model()->vessels) {
    view::VesselStyle style = scene_->vessel_style(vessel->vessel);
    const session::VesselMark* mark = session::find_mark(*annotations, vessel->vessel);
    style.visible = !mark || mark->visible;
    style.color = view::vessel_color(bench_, vessel->vessel);
    scene_->set_vessel_style(vessel->vessel, style);
  }
  const std::int32_t selected = bench_.vessel.get();
  scene_->select_vessel(selected == session::Workbench::no_vessel ? std::nullopt : std::optional(selected));
  emit styles_changed();
}

void SceneWidget::refresh_cursor() {
  cursor_stale_ = false;
  const auto axis = bench_.axis();
  if (!axis) {
    scene_->set_cursor(std::nullopt);
    scene_->set_plane(view::ScenePlane::cross_section, std::nullopt);
    return;
  }
  const double s = bench_.cursor_mm.get();
  view::SceneCursor cursor;
  cursor.place = axis->point(s);
  cursor.frame = axis->frame(s);
  cursor.radius_mm = std::max(2.0, 1.6 * axis->radius(s));
  cursor.theta = bench_.theta_deg.get() * M_PI / 180.0;
  cursor.plane_traces = true;
  scene_->set_cursor(cursor);
  refresh_section();
}

void SceneWidget::refresh_section() {
  const auto axis = bench_.axis();
  if (!axis || !bench_.shown_volume()) {
    scene_->set_plane(view::ScenePlane::cross_section, std::nullopt);
    return;
  }
  view::ScenePlanePicture picture;
  picture.plane =
      reformat::cross_section_plane(*axis, bench_.cursor_mm.get(), section_mm, section_mm / section_px);
  const reformat::PlaneImage image = reformat::slice(*bench_.shown_volume(), picture.plane);
  const session::GreyWindow window = bench_.grey.get();
  picture.gray.reserve(image.values.size());
  for (const float value : image.values)
    picture.gray.push_back(figure::grey_level(static_cast<double>(value), window.level_hu, window.width_hu));
  scene_->set_plane(view::ScenePlane::cross_section, std::move(picture));
}

void SceneWidget::refresh_measurements() {
  marks_stale_ = false;
  scene_->set_measurements(view::scene_measurements(bench_));
}

void SceneWidget::show_guest(std::shared_ptr<view::SceneGuest> guest) {
  const view::SceneGuest* shown = guest.get();
  scene_->set_guest(std::move(guest));
  if (shown) go_to(scene_->pose_fitted());
  request_render();
  emit guest_changed(shown);
}

void SceneWidget::show_other_wall(std::shared_ptr<const geometry::TriMesh> wall) {
  scene_->set_other_wall(std::move(wall));
  request_render();
}

void SceneWidget::save_picture(const std::filesystem::path& png, double scale) {
  const double ratio = scene_->pixel_ratio();
  const auto pixels = [&](int size) { return static_cast<int>(std::lround(size * ratio * scale)); };
  scene_->set_pixel_ratio(ratio * scale);
  try {
    const figure::Raster picture =
        scene_->snapshot(pixels(container_->width()), pixels(container_->height()));
    scene_->set_pixel_ratio(ratio);
    figure::picture_of(picture).write_png(png);
  } catch (...) {
    scene_->set_pixel_ratio(ratio);
    throw;
  }
}

QSize SceneWidget::picture_size() const {
  return container_->size() * devicePixelRatioF();
}

void SceneWidget::add_below(QWidget* controls) {
  auto* column = static_cast<QVBoxLayout*>(layout());
  column->setStretch(0, 1);  // the picture takes the room
  column->addWidget(controls);
}

QSize SceneWidget::minimumSizeHint() const {
  QSize least(120, 100);
  for (int i = 1; i < layout()->count(); ++i) {  // below the picture
    const QLayoutItem* below = layout()->itemAt(i);
    if (below->isEmpty()) continue;
    least.setWidth(std::max(least.width(), below->minimumSize().width()));
    least.setHeight(least_with_bar_px + below->minimumSize().height());
  }
  return least;
}

void SceneWidget::go_to(const view::CameraPose& pose) {
  from_ = scene_->pose();
  to_ = pose;
  flight_clock_.start();
  flight_.start();
}

void SceneWidget::set_volume_mode(view::VolumeMode mode) {
  volume_mode_ = mode;
  scene_->set_volume_mode(mode);
  if (mode != view::VolumeMode::off) emit volume_wanted();
  request_render();
  emit volume_mode_changed(mode);
}

void SceneWidget::set_grip(SceneGrip* grip) {
  grip_ = grip;
  gripped_ = false;
}

void SceneWidget::set_dark(bool dark) {
  dark_ = dark;
  refresh_identity();
  scene_->set_look(dark ? figure::Look::dark : figure::Look::light);
  request_render();
}

}  // namespace ostia::workstation
