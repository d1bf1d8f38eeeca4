#include "vessels/evaluability.h"

#include "shell/desk.h"
#include "shell/quantities.h"
#include "views/overlay_colors.h"
#include "views/picture_widget.h"
#include "views/scene_widget.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int pause_ms = 500;  // a hand that edits is let alone that long

struct Stretch {
  std::int32_t vessel = 0;
  double from_mm = 0.0, to_mm = 0.0;
};

/// Of the chosen measurement, on the selected vessel.
std::optional<Stretch> measured_stretch(const session::Workbench& bench) {
  const analysis::Measurement* chosen =
      session::find_measurement(*bench.session().file().annotations(), bench.selected_measurement.get());
  if (!chosen || !session::needs_vessel(*chosen) || chosen->vessel != bench.vessel.get()) return std::nullopt;
  const Stretch out{chosen->vessel, std::min(chosen->from_mm, chosen->to_mm),
                    std::max(chosen->from_mm, chosen->to_mm)};
  return out.from_mm < out.to_mm ? std::optional(out) : std::nullopt;
}

/// That the cursor is in, on the vessel that owns the place; all of its own part where nothing is known.
Stretch stretch_at_cursor(const session::Workbench& bench, const session::EvaluabilityBoard& board) {
  const geometry::VesselTree& tree = bench.model()->tree;
  const double s = bench.own_mm(bench.cursor_mm.get());
  const std::int32_t owner = lumen::owner_at(tree, bench.vessel.get(), s);
  for (const analysis::EvaluableStretch& one : board.stretches(owner))
    if (s >= one.from_mm && s <= one.to_mm) return {owner, one.from_mm, one.to_mm};
  return {owner, lumen::own_from_mm(tree, owner), bench.axis(owner)->length()};
}

}  // namespace

Evaluability::Evaluability(Desk& desk, const std::vector<PictureWidget*>& pictures, ProfileWidget& profile,
                           SceneWidget& scene)
    : QObject(&desk.window),
      desk_(desk),
      board_(desk.bench),
      profile_(&profile),
      scene_(&scene),
      work_(desk.bench, board_, pause_ms) {
  for (PictureWidget* picture : pictures)
    if (auto* curved = dynamic_cast<view::CurvedView*>(&picture->view()))
      layers_.push_back(std::make_unique<view::EvaluabilityLayer>(*curved, board_));
  profile.view().set_evaluability(&board_);
  own_.push_back(board_.changed.observe([this] { color_tree(); }));
  own_.push_back(board_.shown.observe([this](const bool&) { color_tree(); }));
}

Evaluability::~Evaluability() {
  if (profile_) profile_->view().set_evaluability(nullptr);
}

void Evaluability::color_tree() {
  if (!scene_) return;
  std::vector<view::ColoredStretch> stretches;
  const session::Workbench& bench = desk_.bench;
  if (board_.shown.get() && bench.has_case())
    for (const geometry::Vessel& vessel : bench.model()->tree.vessels)
      for (const analysis::EvaluableStretch& one : board_.stretches(vessel.id)) {
        if (one.grade == analysis::Evaluability::evaluable) continue;
        const QColor color = role_color(view::role_of(one.grade), Ground::image);
        stretches.push_back(
            {vessel.id, one.from_mm, one.to_mm, {color.redF(), color.greenF(), color.blueF()}});
      }
  scene_->scene().set_colored_stretches(std::move(stretches));
  scene_->request_render();
}

QString Evaluability::why_not() const {
  const session::Workbench& bench = desk_.bench;
  if (!bench.has_case()) return tr("No case is open.");
  return bench.axis() ? QString() : tr("No vessel is selected.");
}

void Evaluability::judge(std::optional<analysis::Evaluability> grade) {
  session::Workbench& bench = desk_.bench;
  const std::optional<Stretch> measured = measured_stretch(bench);
  const Stretch on = measured ? *measured : stretch_at_cursor(bench, board_);
  board_.judge(on.vessel, on.from_mm, on.to_mm, grade);
  const QString name = QString::fromStdString(bench.vessel_name(on.vessel));
  const QString said = grade ? QString::fromStdString(view::text_of({on.from_mm, on.to_mm, *grade, {}, true}))
                             : tr("as the program finds it");
  desk_.messages.say(tr("%1 from %2 to %3 mm: %4")
                         .arg(name, quantity::length(on.from_mm), quantity::length(on.to_mm), said));
}

}  // namespace ostia::workstation
