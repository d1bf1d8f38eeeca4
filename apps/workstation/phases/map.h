#pragma once
/// \file The lumen along a vessel over the heart's cycle, as a picture in colours: the 4D profile.

#include "ostia/session/beating_profile.h"
#include "ostia/session/phase_clock.h"
#include "ostia/session/workbench.h"

#include <QImage>
#include <QWidget>
#include <optional>
#include <vector>

namespace ostia::workstation {

enum class PhaseMapValue { diameter, area, change };

/// The abscissa to the right, the phase downwards, 0 to 100 %. Cursor and phase are lines; a click or a drag
/// takes both along, as the arrow keys do.
class PhaseMap final : public QWidget {
  Q_OBJECT
 public:
  PhaseMap(session::Workbench& bench, session::PhaseClock& clock, QWidget* parent = nullptr);
  /// Nothing: what is being measured.
  void set_profile(std::optional<session::BeatingProfile> profile, double own_phase);
  const std::optional<session::BeatingProfile>& profile() const { return profile_; }
  void set_value(PhaseMapValue value);
  /// At a phase and an abscissa, the nearest of the sections; NaN where there is none.
  double value_at(double phase, double s_mm) const;
  QRect plot() const;
  QSize minimumSizeHint() const override;

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  double value(std::size_t phase, std::size_t section) const;
  void color();
  void paint_picture(QPainter& painter, const QRect& at) const;
  void paint_axes(QPainter& painter, const QRect& at) const;
  void paint_bar(QPainter& painter, const QRect& at) const;
  void go_to(const QPoint& place);
  QString value_text(double value) const;
  session::Workbench& bench_;
  session::PhaseClock& clock_;
  std::optional<session::BeatingProfile> profile_;
  std::size_t own_row_ = 0;  // of the case's phase
  double own_phase_ = 0.0;
  PhaseMapValue value_ = PhaseMapValue::diameter;
  double low_ = 0.0, high_ = 1.0;
  QImage picture_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
