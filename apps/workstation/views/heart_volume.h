#pragma once
/// \file The CT in 3D: what of it is shown, and how.

#include "ostia/coronary/heart_region.h"
#include "ostia/imaging/volume.h"
#include "ostia/session/property.h"
#include "ostia/session/workbench.h"
#include "ostia/view/volume_cuts.h"
#include "ostia/view/volume_look.h"
#include "ostia/view/volume_scene.h"

#include <QObject>
#include <QTimer>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace ostia::workstation {

struct Desk;
class SceneWidget;

/// Prepares the volume in the background once it is to be shown: reduced, the heart taken out of the chest,
/// what the scissors took away. It is of the image that the views show; while one follows the other, as in a
/// cine, the last one stays until they rest. Box and cuts are those of a study, in the patient's millimetres;
/// look and heart stay with the window.
class HeartVolume final : public QObject {
  Q_OBJECT
 public:
  static constexpr double histogram_low_hu = -200.0, histogram_high_hu = 1000.0;
  static constexpr int histogram_bins = 150;

  /// Nothing is prepared while an image `is_being_read`.
  HeartVolume(Desk& desk, SceneWidget& scene, std::function<bool()> is_being_read);

  session::Property<bool> alone{true};  ///< without ribs, breastbone and spine
  session::Property<bool> tree_over_it{
      true};  ///< the wall that was found; without a heart it is always there
  session::Property<view::VolumePreset> preset{view::VolumePreset::coronary};
  session::Property<double> shift_hu{0.0, session::Range<double>{-500.0, 500.0, 5.0}};
  session::Property<double> stretch{1.0, session::Range<double>{0.3, 3.0, 0.0}};
  session::Property<view::VolumeCrop> crop;
  session::Property<bool> box_shown{false};  ///< with its handles, while the volume is shown

  view::VolumeLook look() const { return {preset.get(), shift_hu.get(), stretch.get()}; }
  void reset_look();  ///< the preset as it is
  /// Shows the rendering where the volume is not shown.
  void show();
  void cut(const view::VolumeCut& cut);
  bool undo_cut();  ///< false: there is none
  void reset_cuts();
  std::size_t cuts() const { return cuts_.size(); }
  const std::vector<view::VolumeCut>& all_cuts() const { return cuts_; }
  void set_cuts(std::vector<view::VolumeCut> cuts);  ///< in the place of those that are there
  const std::vector<std::int64_t>& histogram() const { return histogram_; }
  /// What is shown; null before it has been prepared.
  const std::shared_ptr<const imaging::ImageVolume>& shown() const { return shown_; }
  /// The grid of which `crop` has shares: the image's until a heart is shown.
  const imaging::Geometry& crop_grid() const { return crop_grid_; }

 signals:
  void shown_changed();
  void cuts_changed();

 private:
  using SharedImage = std::shared_ptr<const imaging::ImageVolume>;
  /// Of one image and one tree.
  struct Ground {
    SharedImage reduced;
    std::shared_ptr<const imaging::MaskVolume> heart;  ///< null: all of the image
  };
  struct Prepared;
  struct Wish {
    SharedImage image;
    std::vector<coronary::ArteryPlace> arteries;
    bool alone = true, lit = false;
    std::vector<view::VolumeCut> cuts;
  };
  static Prepared prepare(const Wish& wish, Ground ground, const core::TaskContext& task);
  void follow_image();
  void follow_shown();
  void make_stale();     ///< something else is wished: what is under way comes too late
  void forget_ground();  ///< another tree, or another wish
  void refresh();
  std::vector<coronary::ArteryPlace> arteries() const;
  Desk& desk_;
  SceneWidget& scene_;
  std::function<bool()> is_being_read_;
  SharedImage image_;   // on the table: box and cuts are its study's
  SharedImage source_;  // that is shown in the views: all below is of it
  QTimer resting_;      // runs while one image follows the other
  Ground ground_;
  std::vector<view::VolumeCut> cuts_;
  SharedImage shown_;
  imaging::Geometry crop_grid_;
  std::vector<std::int64_t> histogram_;
  bool stale_ = true;
  int wish_ = 0;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
