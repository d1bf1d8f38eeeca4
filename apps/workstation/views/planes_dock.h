#pragma once
/// \file Three linked planes: a dock of its own, which can stand on another monitor.

#include "views/picture_widget.h"

#include "ostia/view/linked_planes.h"

#include <QDockWidget>
#include <memory>
#include <vector>

namespace ostia::workstation {

struct Desk;

class PlanesDock final : public QDockWidget {
  Q_OBJECT
 public:
  explicit PlanesDock(Desk& desk, QWidget* parent = nullptr);
  view::LinkedPlanes& planes() { return *planes_; }
  const std::vector<PictureWidget*>& pictures() const { return pictures_; }
  void fit();    ///< all of the image in each
  void reset();  ///< straight again

 signals:
  void hovered(const QString& text);
  void end_chosen(const geometry::Vec3& end);

 private:
  PictureWidget* picture(view::LinkedPlane kind, const QString& name, const QString& title);
  QWidget* controls();
  Desk& desk_;
  std::shared_ptr<view::LinkedPlanes> planes_;
  std::vector<PictureWidget*> pictures_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
