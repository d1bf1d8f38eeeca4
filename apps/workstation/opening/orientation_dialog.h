#pragma once
/// \file Asks how an image lies in the patient.

#include "opening/orientation_slices.h"
#include "shell/fitted_dialog.h"

#include <array>
#include <string>

class QComboBox;
class QLabel;

namespace ostia::workstation {

/// Three slices that follow at once what is chosen: what each of the image's axes rises towards, or turns and
/// flips of what is seen.
class OrientationDialog final : public FittedDialog {
  Q_OBJECT
 public:
  /// `as_read`: by its file, `axes` as it lies now (imaging::given_axes; empty: as read). `closes_case`: says
  /// that the case that is open will be closed.
  OrientationDialog(std::shared_ptr<const imaging::ImageVolume> volume, const imaging::Geometry& as_read,
                    const std::string& axes, const session::GreyWindow& grey, bool closes_case,
                    QWidget* parent);
  const std::string& axes() const { return axes_; }  ///< three letters

 private:
  QWidget* slices();
  QWidget* choices();
  void set_axes(const std::string& axes);
  void chosen(std::size_t image_axis);
  void flip(std::size_t patient_axis);
  void turn(MidSlice seen);
  void refresh();
  TurnedImage image_;
  imaging::Geometry as_read_;
  session::GreyWindow grey_;
  std::string axes_;
  std::array<OrientationSlice*, 3> slices_{};
  std::array<QComboBox*, 3> towards_{};
  QLabel* told_;
};

}  // namespace ostia::workstation
