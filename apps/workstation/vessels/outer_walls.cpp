#include "vessels/outer_walls.h"

#include "commands/texts.h"
#include "shell/bind.h"
#include "shell/main_window.h"

#include "ostia/session/plaque_sampling.h"

#include <QAction>
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

QStringList lesion_text(const session::VesselWalls* walls, const analysis::Stenosis& lesion) {
  QStringList lines{OuterWalls::tr("Stenosis %1 %").arg(lesion.diameter_percent, 0, 'f', 0)};
  const auto found = walls ? session::plaque_of(*walls, lesion) : std::nullopt;
  if (!found) {
    lines << OuterWalls::tr("its plaque is known with the outer wall (View > Outer wall)");
    return lines;
  }
  using analysis::PlaqueClass;
  const analysis::PlaqueVolumes& all = found->volumes;
  const auto mm3 = [&](PlaqueClass one) { return QString::number(all.of(one), 'f', 1); };
  lines << OuterWalls::tr("plaque %1 mm³").arg(all.plaque_mm3(), 0, 'f', 1);
  lines << OuterWalls::tr("low attenuation %1, fibrofatty %2, fibrous %3, calcified %4")
               .arg(mm3(PlaqueClass::low_attenuation), mm3(PlaqueClass::fibrofatty),
                    mm3(PlaqueClass::fibrous), mm3(PlaqueClass::calcified));
  lines << OuterWalls::tr("burden %1 %").arg(all.burden_percent(), 0, 'f', 0);
  if (found->remodelling_index)
    lines << OuterWalls::tr("remodelling index %1").arg(*found->remodelling_index, 0, 'f', 2);
  return lines;
}

OuterWalls::OuterWalls(MainWindow& window, const std::vector<PictureWidget*>& pictures,
                       ProfileWidget* profile)
    : QObject(&window), window_(window), board_(window.bench()), profile_(profile) {
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
  session::Workbench& bench = window.bench();
  const auto switched = [this](const bool&) {
    if (!wanted()) window_.jobs().cancel(wall_job_kind);
    look_soon();
    tell();
  };
  own_.push_back(board_.shown.observe(switched));
  own_.push_back(board_.plaque_shown.observe(switched));
  own_.push_back(board_.changed.observe([this] { refresh_command(); }));
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) {
    look_soon();
    tell();
    refresh_command();
  }));
  own_.push_back(bench.cursor_mm.observe([this](const double&) { tell_lesion(); }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { look_soon(); }));
  own_.push_back(bench.image_changed.observe([this] {
    look_soon();
    refresh_command();
  }));
  own_.push_back(bench.case_changed.observe([this] {
    window_.jobs().cancel(wall_job_kind);
    look_soon();
    refresh_command();
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
  window_.jobs().run(
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
        window_.say(why);
      });
}

void OuterWalls::tell() {
  const session::VesselWalls* walls = wanted() ? board_.of_selected() : nullptr;
  if (walls) window_.say(plaque_text(*walls));
}

/// Once for every stenosis that the cursor comes to.
void OuterWalls::tell_lesion() {
  const session::VesselWalls* walls = wanted() ? board_.of_selected() : nullptr;
  const session::Workbench& bench = window_.bench();
  const double s = bench.cursor_mm.get();
  std::optional<double> here;
  if (walls)
    for (const analysis::Stenosis& one : bench.known_stenoses(bench.vessel.get()))
      if (s >= one.from_mm && s <= one.to_mm) {
        here = one.throat_mm;
        if (told_mm_ != here) window_.say(lesion_text(walls, one).join(QStringLiteral("; ")));
      }
  told_mm_ = here;
}

void OuterWalls::set_plaque_command(QAction* command) {
  command_ = command;
  bind_checked(command, board_.plaque_shown);
  refresh_command();
}

QString OuterWalls::why_no_plaque() const {
  const session::Workbench& bench = window_.bench();
  if (!bench.has_case() || !bench.image().volume) return tr("There is no case with its image.");
  if (board_.known().contains(bench.vessel.get())) return tr("No outer wall was found along this vessel.");
  return tr("No outer wall is known along this vessel: switch on Outer wall, and it is looked for.");
}

void OuterWalls::refresh_command() {
  if (!command_) return;
  const bool known = board_.of_selected() != nullptr;
  const QString tip = known ? command_tip(command_->objectName()) : why_no_plaque();
  command_->setEnabled(known);
  command_->setProperty("tip", tip);
  command_->setStatusTip(tip);
  command_->setToolTip(plain_text(command_->text()) + '\n' + tip);
}

}  // namespace ostia::workstation
