#pragma once
/// \file A 2D view on the screen.

#include "ostia/view/pointer.h"
#include "ostia/view/profile_view.h"

#include <QImage>
#include <QWidget>
#include <functional>
#include <memory>

namespace ostia::workstation {

/// Runs what a hand did; what is refused is shown by the window and ends there.
using Guard = std::function<void(const std::function<void()>&)>;

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
  void take_size();  ///< the view has the widget's size again, after somebody gave it another
  QSize minimumSizeHint() const override { return {80, 80}; }

 signals:
  void hovered(const QString& text);  ///< HU and position under the mouse; empty when it leaves

 protected:
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
  bool handling_ = false;
  PictureWidget* twin_ = nullptr;
};

class ProfileWidget final : public QWidget {
  Q_OBJECT
 public:
  explicit ProfileWidget(session::Workbench& bench, QWidget* parent = nullptr);
  view::ProfileView& view() { return view_; }
  QSize minimumSizeHint() const override { return {160, 70}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void go_to(double x);
  view::ProfileView view_;
  session::Subscription stale_;
};

}  // namespace ostia::workstation
