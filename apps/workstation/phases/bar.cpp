#include "phases/bar.h"

#include "shell/bind.h"

#include "ostia/session/beating.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QToolButton>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr int mark_px = 3;         // half of a mark's width
constexpr int marks_room_px = 10;  // below the groove
constexpr int least_slider_px = 120;

QToolButton* button(const QString& name, const QString& tip) {
  auto* made = new QToolButton;
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setAccessibleName(tip);
  made->setAutoRaise(true);
  made->setFocusPolicy(Qt::StrongFocus);
  return made;
}

QDoubleSpinBox* number(const QString& name, const QString& accessible, const QString& suffix, int decimals,
                       session::Property<double>& property) {
  auto* made = new QDoubleSpinBox;
  made->setObjectName(name);
  made->setAccessibleName(accessible);
  made->setToolTip(accessible);
  made->setDecimals(decimals);
  made->setSuffix(suffix);
  made->setFocusPolicy(Qt::ClickFocus);
  made->setKeyboardTracking(false);  // when it is typed to its end
  bind(made, property);
  return made;
}

}  // namespace

PhaseSlider::PhaseSlider(QWidget* parent) : QSlider(Qt::Horizontal, parent) {
  setObjectName("phase");
  setAccessibleName(tr("Phase of the heart"));
  setToolTip(tr("Phase of the heart, % of the time between two R peaks"));
  setRange(0, 100 * steps_a_percent);
  setSingleStep(steps_a_percent);
  setPageStep(5 * steps_a_percent);
  setFocusPolicy(Qt::StrongFocus);
}

void PhaseSlider::set_phases(const geometry::CageMotion& motion) {
  marks_.clear();
  for (const geometry::CagePhase& one : motion.phases) {
    const bool own = session::phase_distance(one.phase, motion.template_phase) < 1e-6;
    marks_.push_back({100.0 * one.phase, own ? geometry::PhaseOrigin::at_rest : one.origin});
  }
  update();
}

QSize PhaseSlider::sizeHint() const {
  return QSlider::sizeHint() + QSize(0, marks_room_px);
}
QSize PhaseSlider::minimumSizeHint() const {
  return {least_slider_px, QSlider::minimumSizeHint().height() + marks_room_px};
}

int PhaseSlider::place_of(double percent) const {
  const int handle = style()->pixelMetric(QStyle::PM_SliderLength, nullptr, this);
  return handle / 2 + static_cast<int>(std::lround(percent / 100.0 * (width() - handle)));
}

void PhaseSlider::paintEvent(QPaintEvent* event) {
  QSlider::paintEvent(event);
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor color = palette().color(QPalette::WindowText);
  const double y = height() - mark_px - 2.0;
  for (const Mark& mark : marks_) {
    const bool bridged = mark.origin == geometry::PhaseOrigin::bridged;
    const bool own = mark.origin == geometry::PhaseOrigin::at_rest;
    painter.setPen(QPen(own ? palette().color(QPalette::Highlight) : color, 1.2));
    painter.setBrush(bridged ? QBrush(Qt::NoBrush) : QBrush(painter.pen().color()));
    const double radius = own ? mark_px + 1.5 : mark_px - 0.5;
    painter.drawEllipse(QPointF(place_of(mark.percent), y), radius, radius);
  }
}

void PhaseSlider::mousePressEvent(QMouseEvent* event) {
  emit taken();
  if (event->button() == Qt::LeftButton) {
    const int handle = style()->pixelMetric(QStyle::PM_SliderLength, nullptr, this);
    setSliderPosition(QStyle::sliderValueFromPosition(minimum(), maximum(), event->x() - handle / 2,
                                                      std::max(1, width() - handle)));
  }
  QSlider::mousePressEvent(event);  // the handle is below the mouse now
}

void PhaseSlider::keyPressEvent(QKeyEvent* event) {
  emit taken();
  QSlider::keyPressEvent(event);
}

PhaseBar::PhaseBar(session::PhaseClock& clock, QWidget* parent)
    : QWidget(parent),
      clock_(clock),
      slider_(new PhaseSlider),
      play_(button("phase_play", tr("Play"))),
      back_(button("phase_back", tr("Back to the phase that the case is of"))),
      images_(button("phase_images", tr("Chooses the folder with the images of the phases"))),
      profile_(button("phase_profile_button", tr("Shows the selected vessel's lumen over the cycle"))),
      trouble_(new QLabel) {
  setObjectName("phase_bar");
  trouble_->setObjectName("phase_trouble");
  trouble_->hide();
  back_->setToolButtonStyle(Qt::ToolButtonTextOnly);
  auto* loop = new QCheckBox(tr("Loop"));
  loop->setObjectName("phase_loop");
  bind_checked(loop, clock_.loop);
  auto* close = button("phase_close", tr("Close the motion"));
  close->setText(QStringLiteral("\u2715"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(4, 0, 4, 0);
  row->addWidget(play_);
  row->addWidget(slider_, 1);
  row->addWidget(number("phase_percent", tr("Phase, % of RR"), tr(" %"), 1, clock_.percent));
  row->addWidget(trouble_);
  row->addWidget(back_);
  row->addWidget(number("phase_speed", tr("Beats a minute"), tr(" /min"), 0, clock_.beats_a_minute));
  row->addWidget(loop);
  profile_->setText(tr("4D profile"));
  profile_->setCheckable(true);
  row->addWidget(images_);
  row->addWidget(profile_);
  row->addWidget(close);
  connect(slider_, &PhaseSlider::taken, this, [this] { clock_.playing.set(false); });
  connect(slider_, &QSlider::valueChanged, this, [this](int value) {
    clock_.percent.set(static_cast<double>(value) / PhaseSlider::steps_a_percent);
  });
  connect(play_, &QToolButton::clicked, this, [this] { clock_.toggle(); });
  connect(images_, &QToolButton::clicked, this, &PhaseBar::images_wanted);
  connect(back_, &QToolButton::clicked, this, &PhaseBar::back_wanted);
  connect(close, &QToolButton::clicked, this, &PhaseBar::close_wanted);
  keep_with(this, clock_.percent.observe([this](const double& percent) {
    const QSignalBlocker quiet(slider_);
    slider_->setValue(static_cast<int>(std::lround(percent * PhaseSlider::steps_a_percent)));
  }));
  const auto show_playing = [this](const bool& playing) {
    play_->setText(playing ? QStringLiteral("\u275a\u275a") : QStringLiteral("\u25b6"));
    play_->setToolTip(playing ? tr("Pause") : tr("Play"));
    play_->setAccessibleName(play_->toolTip());
  };
  show_playing(false);
  keep_with(this, clock_.playing.observe(show_playing));
}

void PhaseBar::set_motion(const geometry::CageMotion& motion) {
  slider_->set_phases(motion);
  const QString own = QString::fromStdString(session::percent_of_cycle(motion.template_phase));
  back_->setText(tr("Back to %1").arg(own));
  trouble_->setText(tr("Edited at %1 only:").arg(own));
  set_away(false);
  set_images(0);
}

void PhaseBar::set_away(bool away) {
  back_->setEnabled(away);
  if (!away) trouble_->hide();
}

void PhaseBar::set_images(std::size_t count) {
  images_->setText(count == 0 ? tr("Images\u2026") : tr("Images: %1").arg(count));
}

void PhaseBar::offer_way_back() {
  trouble_->show();
  back_->setFocus();
}

}  // namespace ostia::workstation
