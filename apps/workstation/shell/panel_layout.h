#pragma once
/// \file The window's views and lists, and where they stand.

#include "views/picture_widget.h"

#include <QObject>
#include <map>
#include <memory>
#include <string>
#include <vector>

class QSplitter;

namespace ostia::workstation {

struct Desk;
class DoubtList;
class FloatingViews;
class Hanging;
class LesionList;
class Panel;
class SceneWidget;
class VesselList;

class PanelLayout final : public QObject {
  Q_OBJECT
 public:
  explicit PanelLayout(Desk& desk);
  /// All of them; for the window's centre.
  QWidget& whole();
  QSplitter& curved() { return *curved_; }
  SceneWidget& scene() { return *scene_; }
  ProfileWidget& profile() { return *profile_; }
  VesselList& vessels() { return *vessels_; }
  LesionList& lesions() { return *lesions_; }
  DoubtList& doubts() { return *doubts_; }
  const std::vector<PictureWidget*>& pictures() const { return pictures_; }
  /// Something in the title of the tree: a combo box, a button.
  void add_beside_tree(QWidget* control);
  /// Where the splitters stand and which panels they hold, as settings of this machine, with all panels
  /// shown.
  std::map<std::string, std::string> layout_settings();
  /// Of splitters that hold the panels that they held then.
  void restore_layout(const std::map<std::string, std::string>& settings);
  void show_tree(bool shown);  ///< its room goes to the other views
  bool tree_shown() const;
  FloatingViews& floating() { return *floating_; }  ///< views in windows of their own

 signals:
  void hovered(const QString& text);           ///< what is under the mouse in a 2D view
  void end_chosen(const geometry::Vec3& end);  ///< of a vessel that is wanted
  void narrow_changed(bool narrow);

 private:
  Panel* panel(const QString& title, const QString& name, QWidget* content);
  Panel* picture_panel(const QString& title, const QString& name, std::unique_ptr<view::PictureView> view);
  QSplitter* splitter(Qt::Orientation orientation, const QString& name);
  QWidget* curved_column();
  QWidget* neighbours();
  Panel* slice_panel();
  QWidget* section_column();
  Panel* tree_panel();
  QWidget* side_column();
  QWidget* bottom_row();
  void maximise(Panel* panel);
  void let_views_float();
  void fold();
  Desk& desk_;
  Guard guard_;
  SceneWidget* scene_ = nullptr;
  ProfileWidget* profile_ = nullptr;
  VesselList* vessels_ = nullptr;
  LesionList* lesions_ = nullptr;
  DoubtList* doubts_ = nullptr;
  std::vector<PictureWidget*> pictures_;
  std::vector<QSplitter*> splitters_;
  std::map<const QSplitter*, std::string> parts_;  // their panels, in a wide window
  QSplitter *curved_ = nullptr, *rows_ = nullptr;
  Hanging* hanging_ = nullptr;
  FloatingViews* floating_ = nullptr;
  Panel *tree_ = nullptr, *alone_ = nullptr;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
