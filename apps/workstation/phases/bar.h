#pragma once
/// \file The phase of the heart that is shown: a slider over the cycle, playing, and the way back.

#include "ostia/geometry/cage_motion.h"
#include "ostia/session/phase_clock.h"

#include <QSlider>
#include <QWidget>
#include <vector>

class QLabel;
class QToolButton;

namespace ostia::workstation {

/// A slider over the cycle, 0 to 100 %, with a mark at each phase of the motion: filled where it was fitted,
/// hollow where it was bridged, larger where the case is. A click goes to its place.
class PhaseSlider final : public QSlider {
  Q_OBJECT
 public:
  static constexpr int steps_a_percent = 10;
  explicit PhaseSlider(QWidget* parent = nullptr);
  void set_phases(const geometry::CageMotion& motion);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 signals:
  void taken();  ///< by the mouse or a key

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  struct Mark {
    double percent = 0.0;
    geometry::PhaseOrigin origin = geometry::PhaseOrigin::fitted;
  };
  int place_of(double percent) const;  // x, px
  std::vector<Mark> marks_;
};

/// Bound to a clock; hidden until there is a motion.
class PhaseBar final : public QWidget {
  Q_OBJECT
 public:
  explicit PhaseBar(session::PhaseClock& clock, QWidget* parent = nullptr);
  void set_motion(const geometry::CageMotion& motion);
  /// Whether another phase than the case's is shown: there is a way back then.
  void set_away(bool away);
  /// Says that something could not be done at this phase.
  void offer_way_back();
  void set_images(std::size_t count);  ///< images of phases that are known
  QToolButton& profile_button() { return *profile_; }

 signals:
  void back_wanted();
  void close_wanted();
  void images_wanted();

 private:
  session::PhaseClock& clock_;
  PhaseSlider* slider_;
  QToolButton *play_, *back_, *images_, *profile_;
  QLabel* trouble_;
};

}  // namespace ostia::workstation
