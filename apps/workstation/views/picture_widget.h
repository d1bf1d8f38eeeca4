#pragma once
/// \file A 2D view on the screen.

#include "views/overlay_painter.h"

#include "ostia/view/pointer.h"
#include "ostia/view/profile_pointer.h"

#include <QImage>
#include <QMouseEvent>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <memory>

namespace ostia::workstation {

class Identity;

/// Runs what a hand did; what is refused is shown by the window and ends there.
using Guard = std::function<void(const std::function<void()>&)>;

/// Notices that a button went up without a word: a dialog that opened meanwhile took its release.
class HeldButton {
 public:
  void pressed(const QMouseEvent& event) { by_mouse_ = event.spontaneous(); }
  /// To be asked with each move and press while a gesture goes on that needs its button. What the mouse
  /// does says nothing of a button that the keyboard holds down.
  bool lost(const QMouseEvent& event) const {
    return event.spontaneous() == by_mouse_ &&
           (event.buttons() & ~Qt::MouseButtons(event.button())) == Qt::NoButton;
  }

 private:
  bool by_mouse_ = true;
};

/// Paints a PictureView and gives it the mouse. The view is owned.
class PictureWidget final : public QWidget {
  Q_OBJECT
 public:
  PictureWidget(std::unique_ptr<view::PictureView> view, const QString& name, Guard guard,
                QWidget* parent = nullptr);
  ~PictureWidget() override;
  view::PictureView& view() { return *view_; }
  view::Pointer& pointer() { return *pointer_; }
  /// One hand moves both: they are prepared together.
  void set_twin(PictureWidget* twin) { twin_ = twin; }
  /// For PaintQueue: those of these widgets that are pictures are prepared on all cores.
  static void prepare(const QList<QWidget*>& widgets);
  /// Writes in a corner whose image it is, while the person wants it there; outlived by it.
  void show_identity(Identity& identity);
  /// What is on the screen, but for whose it is: for what leaves the window.
  QImage picture_of_nobody();
  /// All that was written over the image when it was painted last, in the view's pixels.
  const std::vector<view::PlacedText>& painted_texts() const { return texts_; }
  void take_size();  ///< the view has the widget's size again, after somebody gave it another
  QSize minimumSizeHint() const override { return {80, 80}; }

 signals:
  void hovered(const QString& text);  ///< HU and position under the mouse; empty when it leaves

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  view::PointerEvent pointer_event(const QPointF& at, Qt::MouseButton button,
                                   Qt::KeyboardModifiers keys) const;
  void hand(const char* kind, const std::function<void()>& act);
  void let_go_if_lost(const QMouseEvent& event);
  void tell_place(const view::Vec2& px);
  void show_cursor();
  void request_paint();
  std::unique_ptr<view::PictureView> view_;
  std::unique_ptr<view::Pointer> pointer_;
  Guard guard_;
  session::Subscription stale_, grey_;
  QImage picture_;
  std::uint64_t revision_ = 0;
  session::GreyWindow painted_window_;
  LabelOffsets label_offsets_;
  std::vector<view::PlacedText> texts_;
  std::vector<view::OverlayText> corner_texts(const QPainter& painter, const QSizeF& view_px);
  bool handling_ = false;
  HeldButton button_;
  PictureWidget* twin_ = nullptr;
  const Identity* identity_ = nullptr;
  session::Subscription identity_changed_;
  bool of_nobody_ = false;
  QTimer rest_{this};       // runs while a coarse picture may still be followed by others
  QTimer grey_told_{this};  // runs while the grey window's numbers are shown
};

class ProfileWidget final : public QWidget {
  Q_OBJECT
 public:
  ProfileWidget(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);
  view::ProfileView& view() { return view_; }
  /// All that was written when it was painted last, in device pixels.
  const std::vector<view::PlacedText>& painted_texts() const { return texts_; }
  /// What is said of the stenosis under the mouse.
  void set_lesion_tip(std::function<QString(const analysis::Stenosis&)> tip) { lesion_tip_ = std::move(tip); }
  QSize minimumSizeHint() const override { return {160, 70}; }

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  view::PointerEvent pointer_event(const QPointF& at, Qt::MouseButton button) const;
  void hand(const std::function<void()>& act);
  void let_go_if_lost(const QMouseEvent& event);
  void show_tip(const QHelpEvent& event);
  std::function<QString(const analysis::Stenosis&)> lesion_tip_;
  view::ProfileView view_;
  view::ProfilePointer pointer_;
  std::vector<view::PlacedText> texts_;
  Guard guard_;
  session::Subscription stale_;
  HeldButton button_;
};

}  // namespace ostia::workstation
