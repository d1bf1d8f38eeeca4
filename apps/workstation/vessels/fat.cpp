#include "vessels/fat.h"

#include "commands/table.h"
#include "opening/technique.h"
#include "shell/desk.h"
#include "shell/docks.h"
#include "shell/library_texts.h"
#include "shell/list_rows.h"
#include "shell/quantities.h"
#include "views/overlay_colors.h"
#include "views/picture_widget.h"

#include "ostia/core/text.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMainWindow>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <any>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int fat_pause_ms = 400;  // a hand that edits is let alone that long
constexpr int fat_page_width = 380;
const char* const fat_job = "fat";
enum FatCells { fat_vessel, fat_stretch, fat_index, fat_usual, fat_clear, fat_volume, fat_cells };

}  // namespace

Fat::Fat(Desk& desk, const std::vector<PictureWidget*>& pictures)
    : QObject(&desk.window), desk_(desk), board_(desk.bench) {
  for (PictureWidget* picture : pictures)
    if (auto* curved = dynamic_cast<view::CurvedView*>(&picture->view()))
      layers_.push_back(std::make_unique<view::FatLayer>(*curved, board_));
  soon_.setSingleShot(true);
  soon_.setInterval(fat_pause_ms);
  connect(&soon_, &QTimer::timeout, this, &Fat::look);
  own_.push_back(board_.shown.observe([this](const bool& shown) {
    if (!shown) desk_.jobs.cancel(fat_job);
    look_soon();
  }));
  session::Workbench& bench = desk.bench;
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { look_soon(); }));
  own_.push_back(bench.image_changed.observe([this] { look_soon(); }));
  own_.push_back(bench.case_changed.observe([this] {
    desk_.jobs.cancel(fat_job);
    look_soon();
  }));
}

void Fat::look_soon() {
  if (board_.shown.get()) soon_.start();
}

void Fat::look() {
  std::optional<session::FatWork> work = board_.work();
  if (!board_.shown.get() || !work) return;
  problem_.clear();
  const auto shared = std::make_shared<session::FatWork>(std::move(*work));
  desk_.jobs.run(
      fat_job, tr("Fat about the arteries"),
      [shared, known = desk_.machine.find_image(desk_.bench.image().reference.sha256)](
          const core::TaskContext& task) -> std::any {
        shared->tube_kv = technique_of(known, task.sub(0.0, 0.05)).tube_kv;
        return std::make_shared<session::CaseFat>(shared->found(task.sub(0.05, 1.0)));
      },
      [this, shared](const std::any& made) {
        const auto& found = std::any_cast<const std::shared_ptr<session::CaseFat>&>(made);
        if (!board_.take(*shared, std::move(*found))) soon_.start();
      },
      [this](const QString& why) {
        problem_ = why;
        emit problem_changed();
      });
}

FatPage::FatPage(Desk& desk, Fat& fat)
    : QDockWidget(tr("Fat about the arteries"), &desk.window), desk_(desk), fat_(fat) {
  setObjectName("fat");
  auto* whole = new QWidget;
  auto* rows = new QVBoxLayout(whole);
  rows->setContentsMargins(6, 6, 6, 6);
  vessels_ = figures_table(
      "fat_vessels", tr("Fat about the arteries"),
      {tr("Artery"), tr("mm"), tr("Index HU"), tr("At 120 kV"), tr("Clear HU"), tr("mm\u00b3")});
  vessels_->setToolTip(tr(
      "Index: the mean of all that is -190 to -30 HU within one diameter of the outer wall. Clear: without "
      "what lies beside an edge and is partly something else. Return: the CPRs show this artery."));
  state_ = new QLabel;
  state_->setObjectName("fat_state");
  state_->setWordWrap(true);
  state_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  rows->addWidget(vessels_, 1);
  rows->addWidget(legend());
  rows->addWidget(state_, 1);
  setWidget(whole);
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool visible) {
    fat_.board().shown.set(!isHidden());
    if (!visible) return;
    size_at_first(*qobject_cast<QMainWindow*>(&desk_.window), *this, fat_page_width, Qt::Horizontal);
    fill();
  });
  const auto go_to = [this](const QTreeWidgetItem* item) {
    desk_.bench.vessel.set(item->data(0, Qt::UserRole).toInt());
  };
  connect(vessels_, &QTreeWidget::itemActivated, this, go_to);
  connect(vessels_, &QTreeWidget::itemClicked, this, go_to);
  connect(&fat, &Fat::problem_changed, this, &FatPage::fill);
  connect(&desk.jobs, &Jobs::changed, this, &FatPage::fill);
  own_.push_back(fat.board().changed.observe([this] { fill(); }));
  own_.push_back(desk.bench.case_changed.observe([this] { fill(); }));
  fill();
}

QWidget* FatPage::legend() {
  auto* whole = new QWidget;
  auto* line = new QHBoxLayout(whole);
  line->setContentsMargins(0, 0, 0, 0);
  const QString middle = tr("%1 to %2 HU");
  const QStringList texts{
      tr("below %1 HU").arg(quantity::hu(view::fat_colors[0].to_hu)),
      middle.arg(quantity::hu(view::fat_colors[0].to_hu), quantity::hu(view::fat_colors[1].to_hu)),
      tr("above %1 HU").arg(quantity::hu(view::fat_colors[1].to_hu))};
  for (std::size_t i = 0; i < view::fat_colors.size(); ++i) {
    auto* colour = new QLabel;
    colour->setPixmap(color_square(role_color(view::fat_colors[i].role, Ground::image)));
    line->addWidget(colour);
    line->addWidget(new QLabel(texts[static_cast<int>(i)]));
    line->addStretch(1);
  }
  return whole;
}

void FatPage::fill() {
  if (isHidden()) return;
  vessels_->clear();
  const session::CaseFat* fat = fat_.board().known();
  if (!fat) {
    state_->setText(!desk_.bench.has_case()       ? tr("No case is open.")
                    : !desk_.bench.image().volume ? tr("The image of the case is not open.")
                    : !fat_.problem().isEmpty()   ? fat_.problem()
                                                  : tr("The fat is being measured\u2026"));
    return;
  }
  for (const session::VesselFat& one : fat->vessels) {
    const analysis::FatAmount& amount = one.profile.fat;
    const quantity::Number index =
        amount.all_voxels > 0 ? quantity::Number(amount.all_mean_hu) : std::nullopt;
    const quantity::Number usual =
        index && fat->tube_kv ? analysis::fat_hu_at_120_kv(*index, *fat->tube_kv) : std::nullopt;
    auto* item = new QTreeWidgetItem(
        vessels_, {QString::fromStdString(one.name),
                   tr("%1 to %2")
                       .arg(quantity::length(one.profile.from_mm - one.origin_mm),
                            quantity::length(one.profile.to_mm - one.origin_mm)),
                   quantity::hu(index), quantity::hu(usual),
                   quantity::hu(amount.voxels > 0 ? quantity::Number(amount.mean_hu) : std::nullopt),
                   quantity::volume(amount.volume_mm3)});
    item->setData(0, Qt::UserRole, one.vessel);
    for (int column = fat_index; column < fat_cells; ++column) item->setTextAlignment(column, Qt::AlignRight);
  }
  vessels_->setColumnHidden(fat_usual, !fat->tube_kv);
  QStringList lines;
  if (fat->tube_kv)
    lines << tr("Tube voltage %1 kV.").arg(QString::fromStdString(core::shown_text(*fat->tube_kv, 0)));
  for (const std::string& warning : fat->warnings) lines << library_text(warning);
  state_->setText(lines.join('\n'));
}

void add_fat_commands(CommandTable& table, FatPage& page) {
  table.add({.id = "view.fat",
             .text = Command::tr("&Fat about the arteries"),
             .tip = Command::tr("Measures the fat about RCA, LAD and LCX and colours it on the CPRs."),
             .keys = {"Ctrl+Alt+F"},
             .action = page.toggleViewAction()});
}

}  // namespace ostia::workstation
