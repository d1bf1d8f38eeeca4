#pragma once
/// \file The line below the window's views.

#include <QLabel>
#include <QStatusBar>

namespace ostia::workstation {

/// A status bar whose message ends in an ellipsis where it is longer than its room, which ends at the first
/// of the widgets at the right. As a tip it is whole.
class StatusLine final : public QStatusBar {
  Q_OBJECT
 public:
  explicit StatusLine(QWidget* parent = nullptr);
  QString shown_message() const;  ///< as it is painted

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QRect message_room() const;
};

/// One line of plain text that gives way, with an ellipsis in its middle: never wider than so many letters of
/// a usual width, and narrower where there is no room. Cut off, it is whole as a tip.
class ElidedLabel final : public QLabel {
  Q_OBJECT
 public:
  ElidedLabel(int most_letters, QWidget* parent = nullptr);
  QString shown_text() const;  ///< as it is painted
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  int most_letters_;
};

}  // namespace ostia::workstation
