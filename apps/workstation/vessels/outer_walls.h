#pragma once
/// \file The outer wall in the window: found in the background, drawn on the pictures, told in words.

#include "ostia/session/outer_wall_board.h"
#include "ostia/view/outer_wall_layer.h"
#include "ostia/view/plaque_layer.h"

#include <QObject>
#include <QPointer>
#include <QStringList>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::workstation {

struct Desk;
class PictureWidget;
class ProfileWidget;

/// "Plaque 45 mm³ (low attenuation 2, ...), burden 41 %; ..." of a vessel.
QString plaque_text(const session::VesselWalls& walls);
/// How narrow a stenosis is and, where the walls (null: not known) cover it, what its plaque is made of.
QStringList lesion_text(const session::VesselWalls* walls, const analysis::Stenosis& lesion);

/// While the outer wall or the plaque is switched on, the selected vessel's outer wall is looked for whenever
/// it is not known: after an edit, for another vessel, for another case. Never waited for. Goes before the
/// views that it draws on.
class OuterWalls final : public QObject {
  Q_OBJECT
 public:
  OuterWalls(Desk& desk, const std::vector<PictureWidget*>& pictures, ProfileWidget* profile);
  ~OuterWalls() override;
  session::OuterWallBoard& board() { return board_; }
  /// Nothing will be looked for before the next edit; what is looked for now is a job.
  bool idle() const { return !soon_.isActive(); }
  /// Why the selected vessel's plaque cannot be shown: its outer wall is not known. Empty where it is.
  QString why_no_plaque() const;

 private:
  bool wanted() const { return board_.shown.get() || board_.plaque_shown.get(); }
  void look_soon();
  void look();
  void tell();
  void tell_lesion();
  Desk& desk_;
  session::OuterWallBoard board_;
  QPointer<ProfileWidget> profile_;
  std::vector<std::unique_ptr<view::OuterWallLayer>> layers_;
  std::vector<std::unique_ptr<view::PlaqueLayer>> plaque_;
  std::optional<double> told_mm_;  // throat of the stenosis that was told of last
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
