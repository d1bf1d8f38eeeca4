#include "phases/series_strip.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPushButton>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int cell_edge_px = 8, least_cell_px = 150, lines_of_text = 2, least_strip_slider_px = 90;
constexpr double usual_speed = 8.0, fastest = 30.0;

QPushButton* strip_button(const QString& name, const QString& text, const QString& tip) {
  auto* made = new QPushButton(text);
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setFocusPolicy(Qt::StrongFocus);
  made->setAutoDefault(false);
  return made;
}

}  // namespace

SeriesStrip::SeriesStrip(QWidget* parent)
    : QDockWidget(tr("Series of the study"), parent),
      list_(new QListWidget),
      play_(new QToolButton),
      slider_(new QSlider(Qt::Horizontal)),
      speed_(new QDoubleSpinBox),
      best_(strip_button("series_best", tr("Find the sharpest"), {})),
      open_(strip_button(
          "series_open", tr("Work on this one"),
          tr("Opens it in the place of the image on the table: vessels are then found in it, and the "
             "case that is open, which is of the other image, is closed"))),
      back_(strip_button("series_back", tr("Back"), tr("Shows the image on the table again"))) {
  setObjectName("series_strip");
  list_->setObjectName("series_list");
  list_->setAccessibleName(tr("Series and phases"));
  list_->setViewMode(QListView::IconMode);
  list_->setFlow(QListView::LeftToRight);
  list_->setWrapping(false);
  list_->setMovement(QListView::Static);
  list_->setIconSize({picture_px, picture_px});
  const int line = list_->fontMetrics().height();
  const int wide = std::max(least_cell_px, list_->fontMetrics().averageCharWidth() * 28);
  list_->setGridSize({wide, picture_px + lines_of_text * line + cell_edge_px});
  list_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  list_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setTextElideMode(Qt::ElideRight);
  list_->installEventFilter(this);
  auto* inside = new QWidget;
  auto* column = new QVBoxLayout(inside);
  column->setContentsMargins(2, 2, 2, 2);
  column->setSpacing(2);
  column->addWidget(controls());
  column->addWidget(list_, 1);
  setWidget(inside);
  set_playing(false);
  set_away(false);
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    if (row >= 0) emit chosen(row);
  });
  connect(list_, &QListWidget::itemPressed, this,
          [this](QListWidgetItem* item) { emit pressed(list_->row(item)); });
  connect(list_, &QListWidget::itemDoubleClicked, this,
          [this](QListWidgetItem* item) { emit open_wanted(list_->row(item)); });
}

QWidget* SeriesStrip::controls() {
  play_->setObjectName("series_play");
  play_->setAutoRaise(true);
  play_->setFocusPolicy(Qt::StrongFocus);
  slider_->setObjectName("series_slider");
  slider_->setAccessibleName(tr("Phase that is shown"));
  slider_->setToolTip(tr("Phases of the study, one after the other"));
  slider_->setMinimumWidth(least_strip_slider_px);
  slider_->setPageStep(1);
  slider_->setFocusPolicy(Qt::StrongFocus);
  speed_->setObjectName("series_speed");
  speed_->setAccessibleName(tr("Pictures a second"));
  speed_->setToolTip(speed_->accessibleName());
  speed_->setDecimals(0);
  speed_->setRange(1.0, fastest);
  speed_->setValue(usual_speed);
  speed_->setSuffix(tr(" /s"));
  speed_->setFocusPolicy(Qt::ClickFocus);
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(play_);
  row->addWidget(slider_, 1);
  row->addWidget(speed_);
  row->addWidget(best_);
  row->addWidget(open_);
  row->addWidget(back_);
  connect(play_, &QToolButton::clicked, this, &SeriesStrip::play_wanted);
  connect(best_, &QPushButton::clicked, this, &SeriesStrip::best_wanted);
  connect(back_, &QPushButton::clicked, this, &SeriesStrip::back_wanted);
  connect(open_, &QPushButton::clicked, this, [this] { emit open_wanted(list_->currentRow()); });
  connect(slider_, &QSlider::valueChanged, this, [this](int at) {
    if (at >= 0 && at < static_cast<int>(cine_.size())) emit chosen(cine_[static_cast<std::size_t>(at)]);
  });
  return bar;
}

bool SeriesStrip::eventFilter(QObject* object, QEvent* event) {
  if (object == list_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if ((key == Qt::Key_Return || key == Qt::Key_Enter) && list_->currentRow() >= 0) {
      emit open_wanted(list_->currentRow());
      return true;
    }
  }
  return QDockWidget::eventFilter(object, event);
}

void SeriesStrip::set_rows(const std::vector<StripRow>& rows) {
  const QSignalBlocker quiet(list_);
  list_->clear();
  for (std::size_t n = 0; n < rows.size(); ++n) {
    auto* item = new QListWidgetItem(list_);
    item->setSizeHint(list_->gridSize());  // whatever its texts are: they change
    QPixmap none(picture_px, picture_px);
    none.fill(Qt::black);
    item->setIcon(none);
    set_row(static_cast<int>(n), rows[n]);
  }
}

void SeriesStrip::set_row(int row, const StripRow& shown) {
  QListWidgetItem* item = list_->item(row);
  if (!item) return;
  const QFontMetrics metrics(list_->font());
  const int room = list_->gridSize().width() - cell_edge_px;
  item->setText(metrics.elidedText(shown.title, Qt::ElideRight, room) + QLatin1Char('\n') +
                metrics.elidedText(shown.note, Qt::ElideRight, room));
  item->setToolTip(shown.tip);
  item->setData(Qt::AccessibleTextRole, shown.title + QStringLiteral(", ") + shown.note);
  item->setFlags(shown.whole ? Qt::ItemIsEnabled | Qt::ItemIsSelectable : Qt::NoItemFlags);
  list_->viewport()->update();  // all of it: a longer text may have stood there
}

void SeriesStrip::set_picture(int row, const QImage& picture) {
  if (QListWidgetItem* item = list_->item(row)) item->setIcon(QPixmap::fromImage(picture));
}

void SeriesStrip::set_cine(const std::vector<int>& rows) {
  cine_ = rows;
  const bool any = rows.size() > 1;
  const QSignalBlocker quiet(slider_);
  slider_->setRange(0, std::max(0, static_cast<int>(rows.size()) - 1));
  for (QWidget* one : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(play_),
                       static_cast<QWidget*>(speed_), static_cast<QWidget*>(best_)})
    one->setEnabled(any);
}

void SeriesStrip::set_current(int row) {
  const QSignalBlocker quiet(list_), quiet_slider(slider_);
  list_->setCurrentRow(row);
  if (QListWidgetItem* item = list_->item(row)) list_->scrollToItem(item);
  const auto at = std::find(cine_.begin(), cine_.end(), row);
  if (at != cine_.end()) slider_->setValue(static_cast<int>(at - cine_.begin()));
}

void SeriesStrip::set_playing(bool playing) {
  play_->setText(playing ? QStringLiteral("\u275a\u275a") : QStringLiteral("\u25b6"));
  play_->setToolTip(playing ? tr("Pause") : tr("Play the phases"));
  play_->setAccessibleName(play_->toolTip());
}

void SeriesStrip::set_best(const QString& text, const QString& tip, bool can) {
  best_->setText(text);
  best_->setToolTip(tip);
  best_->setEnabled(can && cine_.size() > 1);
}

void SeriesStrip::set_away(bool away) {
  back_->setEnabled(away);
  open_->setEnabled(away);
}

void SeriesStrip::offer_way_back() {
  back_->setFocus();
}

double SeriesStrip::pictures_a_second() const {
  return speed_->value();
}

int SeriesStrip::wanted_height() const {
  return list_->gridSize().height() + list_->horizontalScrollBar()->sizeHint().height() +
         best_->sizeHint().height() + 3 * cell_edge_px + fontMetrics().height();
}

}  // namespace ostia::workstation
