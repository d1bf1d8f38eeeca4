#pragma once
/// \file The diameter along a vessel in two scans, and by how much it differs.

#include "ostia/session/comparison.h"
#include "ostia/session/workbench.h"
#include "ostia/view/overlay.h"

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::workstation {

/// A place that both scans show.
struct ComparedPlace {
  double now_mm = 0.0;  ///< abscissa in the present scan
  analysis::Difference
      diameter;  ///< of the circle of the same area, mm; told from noise as a lesion's MLD is
};
/// Of a vessel of the present scan, every section of its profile; empty where it has no partner.
std::vector<ComparedPlace> compared_along(const session::Comparison& made, std::int32_t vessel);

/// Both diameters above, the difference (now - before) below, over the present scan's abscissas; stretches
/// that differ by more than the smallest real difference are coloured. A click, a drag, the wheel and the
/// arrow keys move the cursor of `now`.
class AlongWidget final : public QWidget {
  Q_OBJECT
 public:
  explicit AlongWidget(session::Workbench& now, QWidget* parent = nullptr);
  void show_comparison(std::shared_ptr<const session::Comparison> made);
  /// What is told of the place of the cursor; empty where there is nothing.
  QString told() const;
  const std::vector<ComparedPlace>& places() const { return places_; }
  double x_of(double now_mm) const;  ///< in the widget
  QSize minimumSizeHint() const override { return {200, 110}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  struct Plot;
  Plot plot() const;
  void read();
  const ComparedPlace* at_cursor() const;
  view::Overlay drawn() const;
  void go_to(double x);
  session::Workbench& now_;
  std::shared_ptr<const session::Comparison> made_;
  std::vector<ComparedPlace> places_;
  double length_mm_ = 0.0;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
