#pragma once
/// \file Three slices through the middle of an image, as they are for the axes that a person is about to give
/// it.

#include "ostia/imaging/image_axes.h"
#include "ostia/session/workbench.h"

#include <QImage>
#include <QWidget>
#include <memory>

namespace ostia::workstation {

/// Of an image that lies as `now` says, if it lay as `wanted` says; seen as radiology does.
struct TurnedImage {
  std::shared_ptr<const imaging::ImageVolume> volume;
  imaging::AxesGiven now, wanted;
};

enum class MidSlice { axial, coronal, sagittal };

/// `side` x `side` pixels about the image's middle, black outside of it; the nearest voxels.
QImage mid_slice(const TurnedImage& image, MidSlice which, int side, const session::GreyWindow& grey);
/// What lies to the left, right, above and below in such a picture.
struct SliceLetters {
  const char *left, *right, *above, *below;
};
SliceLetters letters_of(MidSlice which);

/// One of them, with its letters.
class OrientationSlice final : public QWidget {
  Q_OBJECT
 public:
  OrientationSlice(MidSlice which, const QString& title, QWidget* parent = nullptr);
  void show_image(const TurnedImage& image, const session::GreyWindow& grey);
  const QImage& picture() const { return picture_; }
  QSize sizeHint() const override;  ///< smaller on a small screen

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  MidSlice which_;
  QImage picture_;
};

}  // namespace ostia::workstation
