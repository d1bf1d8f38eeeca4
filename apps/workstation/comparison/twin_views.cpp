#include "comparison/twin_views.h"

#include "shell/desk.h"

#include "ostia/view/curved_view.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr double same_row_px = 0.25;

/// The same scale, and both cursors in one row.
void align_curved(view::CurvedView& lead, view::CurvedView& other) {
  const double pixel_mm = lead.pixel_mm(), shift_px = lead.framing().back();
  std::vector<double> framing = other.framing();
  if (std::abs(other.pixel_mm() - pixel_mm) > 1e-9 || framing.back() != shift_px)
    other.set_framing({pixel_mm, other.abscissa_at(0.0), 0.0, shift_px});
  const double off_px =
      other.row_of(other.bench().cursor_mm.get()) - lead.row_of(lead.bench().cursor_mm.get());
  if (std::abs(off_px) > same_row_px) other.pan({0.0, -off_px});
}

QWidget* side_of(QLabel* title, QWidget* picture) {
  auto* side = new QWidget;
  auto* rows = new QVBoxLayout(side);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  rows->addWidget(title);
  rows->addWidget(picture, 1);
  QSizePolicy stays = picture->sizePolicy();
  stays.setRetainSizeWhenHidden(true);
  picture->setSizePolicy(stays);
  return side;
}

}  // namespace

TwinViews::TwinViews(Desk& desk, const QString& title, const QString& name,
                     std::unique_ptr<view::PictureView> now, std::unique_ptr<view::PictureView> before)
    : desk_(desk), title_(title) {
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  controls_ = new QHBoxLayout;
  controls_->setContentsMargins(6, 0, 6, 0);
  rows->addLayout(controls_);
  auto* sides = new QHBoxLayout;
  sides->setContentsMargins(0, 0, 0, 0);
  sides->setSpacing(2);
  rows->addLayout(sides, 1);
  now_ = lead_ = picture(tr("%1, now").arg(title), name + "_now", std::move(now));
  before_ = picture(tr("%1, before").arg(title), name + "_before", std::move(before));
  for (QLabel** label : {&now_title_, &before_title_}) {
    *label = new QLabel;
    (*label)->setContentsMargins(6, 2, 6, 2);
    (*label)->setMinimumWidth(40);
  }
  now_title_->setObjectName(name + "_now_title");
  before_title_->setObjectName(name + "_before_title");
  sides->addWidget(now_side_ = side_of(now_title_, now_), 1);
  sides->addWidget(before_side_ = side_of(before_title_, before_), 1);
  soon_.setSingleShot(true);
  soon_.setInterval(0);
  connect(&soon_, &QTimer::timeout, this, &TwinViews::align);
  refresh();
}

PictureWidget* TwinViews::picture(const QString& title, const QString& name,
                                  std::unique_ptr<view::PictureView> shown) {
  const Guard guard = [this](const std::function<void()>& act) { desk_.messages.guarded(act); };
  auto* made = new PictureWidget(std::move(shown), name, guard);
  made->setAccessibleName(title);
  made->installEventFilter(this);
  connect(made, &PictureWidget::hovered, this, &TwinViews::hovered);
  own_.push_back(made->view().stale.observe([this] { soon_.start(); }));
  return made;
}

bool TwinViews::eventFilter(QObject* object, QEvent* event) {
  auto* picture = qobject_cast<PictureWidget*>(object);
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::Wheel:
    case QEvent::FocusIn:
      if (picture) lead_ = picture;
      break;
    case QEvent::Resize:
      soon_.start();
      break;
    default:
      break;
  }
  return QWidget::eventFilter(object, event);
}

void TwinViews::align() {
  if (!isVisible()) return;
  PictureWidget* other = lead_ == now_ ? before_ : now_;
  view::PictureView &from = lead_->view(), &to = other->view();
  if (!from.ready() || !to.ready()) return;
  desk_.messages.guarded([&] {
    auto* curved = dynamic_cast<view::CurvedView*>(&from);
    if (curved)
      align_curved(*curved, dynamic_cast<view::CurvedView&>(to));
    else
      to.set_framing(from.framing());
  });
}

void TwinViews::show_twins(TwinsShown shown) {
  shown_ = shown;
  refresh();
}

void TwinViews::set_reached(bool now, bool before) {
  now_reached_ = now;
  before_reached_ = before;
  refresh();
}

void TwinViews::refresh() {
  now_title_->setText(now_reached_ ? tr("%1, now").arg(title_) : tr("%1, now: not reached").arg(title_));
  before_title_->setText(before_reached_ ? tr("%1, before").arg(title_)
                                         : tr("%1, before: not reached").arg(title_));
  now_->setVisible(now_reached_);
  before_->setVisible(before_reached_);
  now_side_->setVisible(shown_ != TwinsShown::before);
  before_side_->setVisible(shown_ != TwinsShown::now);
}

void TwinViews::add_control(QWidget* control) {
  controls_->addWidget(control);
}

void TwinViews::begin() {
  lead_ = now_;
  auto* curved = dynamic_cast<view::CurvedView*>(&now_->view());
  if (!curved || !curved->ready()) return;
  desk_.messages.guarded([&] {
    now_->take_size();
    curved->set_framing({0.0, 0.0, 0.0, 0.0});
    const double row = curved->row_of(curved->bench().cursor_mm.get());
    if (row < 0.0 || row > curved->height()) curved->pan({0.0, 0.5 * curved->height() - row});
  });
  soon_.start();
}

void TwinViews::fit() {
  now_->view().fit();
  before_->view().fit();
}

}  // namespace ostia::workstation
