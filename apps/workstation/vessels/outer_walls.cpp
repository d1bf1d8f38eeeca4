#include "vessels/outer_walls.h"

#include "shell/desk.h"
#include "shell/quantities.h"
#include "views/picture_widget.h"

#include "ostia/session/plaque_sampling.h"

#include <any>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int pause_ms = 400;  // a hand that edits lets the wall alone that long before it is looked for
const char* const wall_job_kind = "outer_wall";

}  // namespace

QString plaque_text(const session::VesselWalls& walls) {
  const analysis::PlaqueVolumes all =
      analysis::plaque_between(walls.plaque, walls.plaque.from_mm, walls.plaque.to_mm);
  const auto mm3 = [&](analysis::PlaqueClass one) { return quantity::volume(all.of(one)); };
  using analysis::PlaqueClass;
  return OuterWalls::tr(
             "Plaque %1 mm³ (low attenuation %2, fibrofatty %3, fibrous %4, calcified %5), burden %6 %; the "
             "outer wall is seen on %7 % of it")
      .arg(quantity::volume(all.plaque_mm3()))
      .arg(mm3(PlaqueClass::low_attenuation), mm3(PlaqueClass::fibrofatty), mm3(PlaqueClass::fibrous),
           mm3(PlaqueClass::calcified))
      .arg(quantity::percent(all.burden_percent()))
      .arg(quantity::percent(100.0 * walls.outer.seen_share));
}

QStringList lesion_text(const session::VesselWalls* walls, const analysis::Stenosis& lesion) {
  QStringList lines{OuterWalls::tr("Stenosis %1 %").arg(quantity::stenosis(lesion.diameter_percent))};
  const auto found = walls ? session::plaque_of(*walls, lesion) : std::nullopt;
  if (!found) {
    lines << OuterWalls::tr("its plaque is known with the outer wall (View > Outer wall)");
    return lines;
  }
  using analysis::PlaqueClass;
  const analysis::PlaqueVolumes& all = found->volumes;
  const auto mm3 = [&](PlaqueClass one) { return quantity::volume(all.of(one)); };
  lines << OuterWalls::tr("plaque %1 mm³").arg(quantity::volume(all.plaque_mm3()));
  lines << OuterWalls::tr("low attenuation %1, fibrofatty %2, fibrous %3, calcified %4")
               .arg(mm3(PlaqueClass::low_attenuation), mm3(PlaqueClass::fibrofatty),
                    mm3(PlaqueClass::fibrous), mm3(PlaqueClass::calcified));
  lines << OuterWalls::tr("burden %1 %").arg(quantity::percent(all.burden_percent()));
  if (found->remodelling_index)
    lines << OuterWalls::tr("remodelling index %1").arg(quantity::ratio(*found->remodelling_index));
  return lines;
}

OuterWalls::OuterWalls(Desk& desk, const std::vector<PictureWidget*>& pictures, ProfileWidget* profile)
    : QObject(&desk.window), desk_(desk), board_(desk.bench), profile_(profile) {
  for (PictureWidget* picture : pictures) {
    plaque_.push_back(std::make_unique<view::PlaqueLayer>(picture->view(), board_));
    layers_.push_back(std::make_unique<view::OuterWallLayer>(picture->view(), board_));
  }
  profile->view().set_walls(&board_);
  profile->set_lesion_tip([this](const analysis::Stenosis& lesion) {
    return lesion_text(board_.of_selected(), lesion).join('\n');
  });
  soon_.setSingleShot(true);
  soon_.setInterval(pause_ms);
  connect(&soon_, &QTimer::timeout, this, &OuterWalls::look);
  session::Workbench& bench = desk.bench;
  const auto switched = [this](const bool&) {
    if (!wanted()) desk_.jobs.cancel(wall_job_kind);
    look_soon();
    tell();
  };
  own_.push_back(board_.shown.observe(switched));
  own_.push_back(board_.plaque_shown.observe(switched));
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) {
    look_soon();
    tell();
  }));
  own_.push_back(bench.cursor_mm.observe([this](const double&) { tell_lesion(); }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { look_soon(); }));
  own_.push_back(bench.image_changed.observe([this] { look_soon(); }));
  own_.push_back(bench.case_changed.observe([this] {
    desk_.jobs.cancel(wall_job_kind);
    look_soon();
  }));
}

OuterWalls::~OuterWalls() {
  if (!profile_) return;
  profile_->set_lesion_tip({});
  profile_->view().set_walls(nullptr);
}

void OuterWalls::look_soon() {
  if (wanted()) soon_.start();
}

void OuterWalls::look() {
  std::optional<session::OuterWallWork> work = board_.work();
  if (!wanted() || !work) return;
  const auto shared = std::make_shared<const session::OuterWallWork>(std::move(*work));
  desk_.jobs.run(
      wall_job_kind, tr("Outer wall"),
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
        desk_.messages.say(why);
      });
}

void OuterWalls::tell() {
  const session::VesselWalls* walls = wanted() ? board_.of_selected() : nullptr;
  if (walls) desk_.messages.say(plaque_text(*walls));
}

/// Once for every stenosis that the cursor comes to.
void OuterWalls::tell_lesion() {
  const session::VesselWalls* walls = wanted() ? board_.of_selected() : nullptr;
  const session::Workbench& bench = desk_.bench;
  const double s = bench.cursor_mm.get();
  std::optional<double> here;
  if (walls)
    for (const analysis::Stenosis& one : bench.known_stenoses(bench.vessel.get()))
      if (s >= one.from_mm && s <= one.to_mm) {
        here = one.throat_mm;
        if (told_mm_ != here) desk_.messages.say(lesion_text(walls, one).join(QStringLiteral("; ")));
      }
  told_mm_ = here;
}

QString OuterWalls::why_no_plaque() const {
  if (board_.of_selected()) return {};
  const session::Workbench& bench = desk_.bench;
  if (!bench.has_case() || !bench.image().volume) return tr("There is no case with its image.");
  if (board_.known().contains(bench.vessel.get())) return tr("No outer wall was found along this vessel.");
  return tr("No outer wall is known along this vessel: switch on Outer wall, and it is looked for.");
}

}  // namespace ostia::workstation
