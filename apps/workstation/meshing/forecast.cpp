#include "meshing/forecast.h"

#include "shell/desk.h"
#include "shell/panel.h"
#include "views/scene_widget.h"

#include "ostia/core/error.h"

#include <QCoreApplication>
#include <QPointer>
#include <algorithm>
#include <cmath>
#include <new>

namespace ostia::workstation {
namespace {

constexpr figure::Color fails_color{0.835, 0.369, 0.0, 1.0};  // vermilion and yellow: told apart by all
constexpr figure::Color poor_color{0.941, 0.894, 0.259, 1.0};
constexpr double least_half_height_mm = 3.0, most_half_height_mm = 8.0;
const QString kind = QStringLiteral("mesh_check");

[[maybe_unused]] const char* const texts_of_job[] = {QT_TRANSLATE_NOOP("stages", "mesh forecast")};

}  // namespace

std::string too_little_memory() {
  return QCoreApplication::translate(
             "jobs", "There is not enough memory for this: choose longer edges, or fewer vessels.")
      .toStdString();
}

MeshingForecast::MeshingForecast(Desk& desk, SceneWidget& scene, MeshingDialog& dialog)
    : QObject(&dialog), desk_(desk), scene_(scene), dialog_(dialog) {
  MeshingCheck* page = dialog.check_page();
  connect(page, &MeshingCheck::wanted, this, &MeshingForecast::start);
  connect(page, &MeshingCheck::given_up, this, &MeshingForecast::give_up);
  connect(page, &MeshingCheck::chosen, this, &MeshingForecast::fly_to);
  connect(&scene, &SceneWidget::guest_changed, this, [this](const view::SceneGuest* shown) {
    if (shown != guest_.get()) guest_.reset();  // another has taken its place
  });
  // The cross of the job's line gives it up without a word.
  connect(&desk.jobs, &Jobs::changed, this, [this] {
    if (dialog_.check_page()->running() && !desk_.jobs.running(kind)) give_up();
  });
}

MeshingForecast::~MeshingForecast() {
  desk_.jobs.cancel(kind);
  take_away();
}

void MeshingForecast::take_away() {
  if (guest_) scene_.show_guest(nullptr);
  guest_.reset();
}

void MeshingForecast::start() {
  const auto model = dialog_.subject().model;
  const auto options = dialog_.mesh_options();
  dialog_.check_page()->show_running();
  const QPointer<MeshingForecast> self(this);
  desk_.jobs.run(
      kind, tr("Will it mesh?"),
      [model, options](const core::TaskContext& task) {
        try {
          return std::any(std::make_shared<const pipeline::VesselForecast>(
              pipeline::forecast_mesh(*model, options, task)));
        } catch (const std::bad_alloc&) {
          throw ResourceError(too_little_memory());
        }
      },
      [self](const std::any& made) {
        if (self) self->show(*std::any_cast<const std::shared_ptr<const pipeline::VesselForecast>&>(made));
      },
      [self](const QString& message) {
        if (!self) return;
        self->take_away();
        self->dialog_.check_page()->show_failure(tr("It would fail: %1").arg(message));
      });
}

void MeshingForecast::give_up() {
  desk_.jobs.cancel(kind);
  forecast_ = {};
  take_away();
  dialog_.check_page()->show_nothing();
}

void MeshingForecast::show(const pipeline::VesselForecast& made) {
  forecast_ = made.forecast;
  dialog_.check_page()->show_forecast(forecast_);
  std::vector<view::SurfacePlace> places;
  for (const meshing::ForecastPlace& place : forecast_.places)
    places.push_back({place.point, place.extent_mm, place.triangles, place.fails ? fails_color : poor_color});
  guest_ = std::make_shared<view::ForecastScene>(made.surface, std::move(places));
  reveal(scene_);
  scene_.show_guest(guest_);
}

void MeshingForecast::fly_to(int row) {
  if (!guest_ || row < 0 || static_cast<std::size_t>(row) >= forecast_.places.size()) return;
  const meshing::ForecastPlace& place = forecast_.places[static_cast<std::size_t>(row)];
  guest_->choose(static_cast<std::size_t>(row));
  view::CameraPose pose = scene_.scene().pose();
  pose.target = place.point;
  pose.half_height_mm = std::clamp(3.0 * place.extent_mm, least_half_height_mm, most_half_height_mm);
  scene_.go_to(pose);
  scene_.request_render();
}

}  // namespace ostia::workstation
