#pragma once
/// \file How the heart in 3D was left: its look with the window's layout, box and cuts with the case.

#include "ostia/session/property.h"
#include "ostia/view/volume_cuts.h"

#include <QObject>
#include <QTimer>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ostia::workstation {

struct Desk;
class HeartVolume;

/// The look, whether it is without bones and whether the tree is over it, for Layouts.
std::map<std::string, std::string> look_settings(const HeartVolume& heart);
/// What is missing, or is nothing that it could be, stays as it is.
void restore_look(HeartVolume& heart, const std::map<std::string, std::string>& values);

/// As JSON, for a case's settings; tenths of a millimetre.
std::string text_of_cuts(const std::vector<view::VolumeCut>& cuts);
std::string text_of_box(const view::VolumeCrop& box);
/// Nothing for any other text.
std::optional<std::vector<view::VolumeCut>> cuts_of_text(const std::string& text);
std::optional<view::VolumeCrop> box_of_text(const std::string& text);

/// Box and cuts are kept in the case a second after the last of them, and come back with it. Those that were
/// made before there was a case go into the one that is begun.
class HeartMemory final : public QObject {
  Q_OBJECT
 public:
  HeartMemory(Desk& desk, HeartVolume& heart);
  void keep();  ///< now: the case is about to be left

 private:
  void changed();
  void on_case();
  void restore();
  std::map<std::string, std::string> now() const;
  Desk& desk_;
  HeartVolume& heart_;
  QTimer resting_;
  std::map<std::string, std::string> kept_;  // what the case has
  bool had_case_ = false, restoring_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
