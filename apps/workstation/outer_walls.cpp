#include "outer_walls.h"

#include "main_window.h"

#include <any>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int pause_ms = 400;  // a hand that edits lets the wall alone that long before it is looked for
const char* const kind = "outer_wall";

}  // namespace

QString plaque_text(const session::VesselWalls& walls) {
  const analysis::PlaqueVolumes all =
      analysis::plaque_between(walls.plaque, walls.plaque.from_mm, walls.plaque.to_mm);
  const auto mm3 = [&](analysis::PlaqueClass one) { return QString::number(all.of(one), 'f', 1); };
  using analysis::PlaqueClass;
  return OuterWalls::tr(
             "Plaque %1 mm³ (low attenuation %2, fibrofatty %3, fibrous %4, calcified %5), burden %6 %; the "
             "outer wall is seen on %7 % of it")
      .arg(all.plaque_mm3(), 0, 'f', 1)
      .arg(mm3(PlaqueClass::low_attenuation), mm3(PlaqueClass::fibrofatty), mm3(PlaqueClass::fibrous),
           mm3(PlaqueClass::calcified))
      .arg(all.burden_percent(), 0, 'f', 0)
      .arg(100.0 * walls.outer.seen_share, 0, 'f', 0);
}

OuterWalls::OuterWalls(MainWindow& window, const std::vector<PictureWidget*>& pictures)
    : QObject(&window), window_(window), board_(window.bench()) {
  for (PictureWidget* picture : pictures)
    layers_.push_back(std::make_unique<view::OuterWallLayer>(picture->view(), board_));
  soon_.setSingleShot(true);
  soon_.setInterval(pause_ms);
  connect(&soon_, &QTimer::timeout, this, &OuterWalls::look);
  const auto look_soon = [this] {
    if (board_.shown.get()) soon_.start();
  };
  session::Workbench& bench = window.bench();
  own_.push_back(board_.shown.observe([this, look_soon](const bool& on) {
    if (!on) window_.jobs().cancel(kind);
    look_soon();
    tell();
  }));
  own_.push_back(bench.vessel.observe([this, look_soon](const std::int32_t&) {
    look_soon();
    tell();
  }));
  own_.push_back(bench.model_changed.observe([look_soon](const session::ModelEvent&) { look_soon(); }));
  own_.push_back(bench.image_changed.observe(look_soon));
  own_.push_back(bench.case_changed.observe([this, look_soon] {
    window_.jobs().cancel(kind);
    look_soon();
  }));
}

void OuterWalls::look() {
  std::optional<session::OuterWallWork> work = board_.work();
  if (!board_.shown.get() || !work) return;
  const auto shared = std::make_shared<const session::OuterWallWork>(std::move(*work));
  window_.jobs().run(
      kind, tr("Outer wall"),
      [shared](const core::TaskContext& task) -> std::any {
        return std::make_shared<std::optional<session::VesselWalls>>(shared->found(task));
      },
      [this, shared](const std::any& made) {
        const auto& found = std::any_cast<const std::shared_ptr<std::optional<session::VesselWalls>>&>(made);
        if (board_.take(*shared, std::move(*found)))
          tell();
        else
          soon_.start();
      },
      [this, shared](const QString& why) {
        board_.take(*shared, std::nullopt);
        window_.say(why);
      });
}

void OuterWalls::tell() {
  const session::VesselWalls* walls = board_.shown.get() ? board_.of_selected() : nullptr;
  if (walls) window_.say(plaque_text(*walls));
}

}  // namespace ostia::workstation
