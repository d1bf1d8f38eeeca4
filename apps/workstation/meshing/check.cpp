#include "meshing/check.h"

#include "meshing/fields.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace ostia::workstation {
namespace {

using meshing::ForecastPlace;
using meshing::OfferedRepair;
using meshing::TroubleKind;

constexpr int check_rows_shown = 3;

QString repair_text(const ForecastPlace& place) {
  switch (place.repair) {
    case OfferedRepair::smaller_edges:
      return MeshingCheck::tr("Edges %1 times as long").arg(place.factor, 0, 'g', 2);
    case OfferedRepair::thinner_layers:
      return MeshingCheck::tr("Layers %1 times as thick").arg(place.factor, 0, 'g', 2);
    case OfferedRepair::drop_layers:
      return MeshingCheck::tr("No layers");
    default:
      return MeshingCheck::tr("Change the settings");
  }
}

}  // namespace

QString heading_of(TroubleKind kind) {
  switch (kind) {
    case TroubleKind::units:
      return MeshingCheck::tr("The unit looks wrong");
    case TroubleKind::not_finite:
      return MeshingCheck::tr("Points without a place");
    case TroubleKind::open_edges:
      return MeshingCheck::tr("A hole in the wall");
    case TroubleKind::non_manifold:
      return MeshingCheck::tr("Edges of more than two triangles");
    case TroubleKind::turned_triangles:
      return MeshingCheck::tr("Triangles that look the wrong way");
    case TroubleKind::inward:
      return MeshingCheck::tr("The wall is inside out");
    case TroubleKind::self_intersections:
      return MeshingCheck::tr("The wall crosses itself");
    case TroubleKind::touching_walls:
      return MeshingCheck::tr("Two walls nearly touch");
    case TroubleKind::narrow_lumen:
      return MeshingCheck::tr("Few edges across the lumen");
    case TroubleKind::edge_size:
      return MeshingCheck::tr("An edge length that cannot be");
    case TroubleKind::small_end:
      return MeshingCheck::tr("An end smaller than its elements");
    case TroubleKind::sharp_fold:
      return MeshingCheck::tr("A fold in which layers cannot grow");
    case TroubleKind::no_room_for_layers:
      return MeshingCheck::tr("Little room for layers");
  }
  return {};
}

bool is_of_settings(OfferedRepair repair) {
  return repair == OfferedRepair::smaller_edges || repair == OfferedRepair::thinner_layers ||
         repair == OfferedRepair::drop_layers;
}

MeshingCheck::MeshingCheck(QWidget* parent) : QWidget(parent) {
  check_ = new QPushButton;
  check_->setObjectName("check");
  check_->setAutoDefault(false);
  check_->setToolTip(
      tr("Looks for what would fail or come out poor, without meshing; the places are shown in 3D."));
  summary_ = new QLabel;
  summary_->setObjectName("check_summary");
  summary_->setWordWrap(true);
  list_ = new QListWidget;
  list_->setObjectName("check_places");
  list_->setAccessibleName(tr("Places that would fail or come out poor"));
  detail_ = new QLabel;
  detail_->setObjectName("check_detail");
  detail_->setWordWrap(true);
  detail_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  detail_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  repair_ = new QPushButton;
  repair_->setObjectName("check_repair");
  repair_->setAutoDefault(false);
  repair_->setToolTip(tr("Changes the fields of this dialog; check again afterwards."));
  auto* top = new QHBoxLayout;
  top->addWidget(check_);
  top->addWidget(summary_, 1);
  auto* bottom = new QHBoxLayout;
  bottom->addWidget(detail_, 1);
  bottom->addWidget(repair_, 0, Qt::AlignTop);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(top);
  layout->addWidget(list_, 1);
  layout->addLayout(bottom);
  list_->setMinimumHeight(check_rows_shown * list_->fontMetrics().height() + 8);
  detail_->setMinimumHeight(3 * detail_->fontMetrics().lineSpacing());
  connect(check_, &QPushButton::clicked, this, [this] {
    if (running_)
      emit given_up();
    else
      emit wanted();
  });
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    show_place(row);
    if (row >= 0) emit chosen(row);
  });
  const auto again = [this](const QListWidgetItem* item) { emit chosen(list_->row(item)); };
  list_->installEventFilter(this);
  connect(list_, &QListWidget::itemClicked, this, again);
  connect(repair_, &QPushButton::clicked, this, [this] {
    const int row = list_->currentRow();
    if (row < 0) return;
    const ForecastPlace place =
        forecast_.places[static_cast<std::size_t>(row)];  // fields that change empty it
    emit repair_wanted(place);
  });
  show_nothing();
}

/// Return flies to the place; the dialog would take it for its button.
bool MeshingCheck::eventFilter(QObject* object, QEvent* event) {
  if (object != list_ || event->type() != QEvent::KeyPress) return QWidget::eventFilter(object, event);
  const int key = static_cast<QKeyEvent*>(event)->key();
  if (key != Qt::Key_Return && key != Qt::Key_Enter) return false;
  if (list_->currentRow() >= 0) emit chosen(list_->currentRow());
  return true;
}

void MeshingCheck::show_running() {
  running_ = true;
  stale_ = changed_ = false;
  state_ = tr("Looking\u2026");
  refresh();
}

void MeshingCheck::show_forecast(const meshing::MeshForecast& forecast) {
  running_ = false;
  answered_ = true;
  stale_ = std::exchange(changed_, false);
  forecast_ = forecast;
  const auto failing = std::ranges::count_if(forecast.places, [](const auto& place) { return place.fails; });
  const auto poor = static_cast<std::ptrdiff_t>(forecast.places.size()) - failing;
  state_ = forecast.places.empty() ? tr("Nothing was found that would fail.")
                                   : tr("Would fail: %1. Would come out poor: %2.").arg(failing).arg(poor);
  const QSignalBlocker quiet(list_);
  list_->clear();
  for (const ForecastPlace& place : forecast.places) {
    auto* item = new QListWidgetItem(
        (place.fails ? tr("fails: %1") : tr("poor: %1")).arg(heading_of(place.kind)), list_);
    if (place.fails) item->setForeground(trouble_color());
    item->setToolTip(QString::fromStdString(place.sentence));
  }
  refresh();
}

void MeshingCheck::show_failure(const QString& message) {
  running_ = false;
  answered_ = true;
  stale_ = std::exchange(changed_, false);
  forecast_ = {};
  list_->clear();
  state_ = message;
  refresh();
}

void MeshingCheck::show_nothing() {
  changed_ = false;
  show_failure(tr("Shows what would fail before anything is meshed."));
  answered_ = false;
}

void MeshingCheck::set_stale() {
  if (running_) {
    changed_ = true;
    return;
  }
  if (!answered_) return;
  stale_ = true;
  refresh();
}

void MeshingCheck::set_possible(bool possible) {
  possible_ = possible;
  refresh();
}

void MeshingCheck::refresh() {
  check_->setText(running_ ? tr("&Stop") : tr("Chec&k"));
  check_->setEnabled(running_ || possible_);
  summary_->setText(stale_ ? tr("The settings have changed: check again.") : state_);
  list_->setEnabled(!running_);
  show_place(list_->currentRow());
}

void MeshingCheck::show_place(int row) {
  const bool any = row >= 0 && static_cast<std::size_t>(row) < forecast_.places.size();
  repair_->setVisible(false);
  detail_->setText({});
  if (!any) return;
  const ForecastPlace& place = forecast_.places[static_cast<std::size_t>(row)];
  const QString sentence = QString::fromStdString(place.sentence),
                out = QString::fromStdString(place.repair_sentence);
  detail_->setText(out.isEmpty() ? sentence : tr("%1. Way out: %2.").arg(sentence, out));
  repair_->setText(repair_text(place));
  repair_->setVisible(is_of_settings(place.repair));
  repair_->setEnabled(!running_ && !stale_);
}

}  // namespace ostia::workstation
