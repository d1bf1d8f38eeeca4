#pragma once
/// \file What of the volume is seen in 3D, over how often each CT number comes.

#include "ostia/view/volume_look.h"

#include <QWidget>
#include <cstdint>
#include <vector>

namespace ostia::workstation {

class HeartVolume;

/// The curve of opacities in its colours over a histogram. A drag to the side shifts it, one up or down makes
/// it softer or harder; a double click puts it back.
class TransferPlot final : public QWidget {
  Q_OBJECT
 public:
  explicit TransferPlot(HeartVolume& heart, QWidget* parent = nullptr);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  void paint_histogram(QPainter& painter, const QRectF& area) const;
  void paint_curve(QPainter& painter, const QRectF& area) const;
  void paint_numbers(QPainter& painter, const QRectF& area) const;
  QRectF area() const;
  HeartVolume& heart_;
  QPointF pressed_;
  double shift_hu_ = 0.0, stretch_ = 1.0;  // when the button went down
};

}  // namespace ostia::workstation
