#pragma once
/// \file How often each value comes, in the colours of a scale.

#include "ostia/view/value_scale.h"

#include <QWidget>
#include <cstddef>
#include <vector>

namespace ostia::workstation {

/// Bars of a height that grows with the logarithm of the count: a few bad ones among many are seen.
class HistogramWidget final : public QWidget {
  Q_OBJECT
 public:
  explicit HistogramWidget(QWidget* parent = nullptr);
  /// Values beyond the scale are in its first or last bar. Nothing: an empty one.
  void set_values(const std::vector<double>& values, const view::ValueScale& scale);
  const std::vector<std::size_t>& counts() const { return counts_; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QString told(std::size_t bar) const;
  QRectF bars() const;
  view::ValueScale scale_;
  std::vector<std::size_t> counts_;
};

}  // namespace ostia::workstation
