#pragma once
/// \file The same view of two scans, side by side or by turns in one place.

#include "views/picture_widget.h"

#include <QTimer>
#include <QWidget>
#include <memory>
#include <vector>

class QLabel;
class QHBoxLayout;

namespace ostia::workstation {

struct Desk;

enum class TwinsShown { both, now, before };

/// What a hand does in one of the two (zoom, shift, another kind of slice) the other does, too; CPRs have the
/// cursor in the same row.
class TwinViews final : public QWidget {
  Q_OBJECT
 public:
  /// Of two views of the same kind, on two workbenches. They are called `name`_now and `name`_before.
  TwinViews(Desk& desk, const QString& title, const QString& name, std::unique_ptr<view::PictureView> now,
            std::unique_ptr<view::PictureView> before);
  PictureWidget& now() { return *now_; }
  PictureWidget& before() { return *before_; }
  void show_twins(TwinsShown shown);
  /// A scan that does not reach the place of the cursor says so, and has no picture there.
  void set_reached(bool now, bool before);
  void add_control(QWidget* control);  ///< beside the title
  void fit();
  /// As large as a view is at first, with the cursor in it.
  void begin();

 signals:
  void hovered(const QString& text);

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  PictureWidget* picture(const QString& title, const QString& name, std::unique_ptr<view::PictureView> view);
  void align();
  void refresh();
  Desk& desk_;
  QString title_;
  PictureWidget *now_ = nullptr, *before_ = nullptr;
  PictureWidget* lead_ = nullptr;  // the hand was there last
  QLabel *now_title_ = nullptr, *before_title_ = nullptr;
  QWidget *now_side_ = nullptr, *before_side_ = nullptr;
  QHBoxLayout* controls_ = nullptr;
  TwinsShown shown_ = TwinsShown::both;
  bool now_reached_ = true, before_reached_ = true;
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
