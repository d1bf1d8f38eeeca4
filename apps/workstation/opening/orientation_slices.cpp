#include "opening/orientation_slices.h"

#include <QPainter>
#include <QPainterPath>
#include <QScreen>
#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::workstation {
namespace {

using geometry::Vec3;

constexpr int picture_side = 220;

/// Unit vectors to the right and down in a picture, LPS.
std::pair<Vec3, Vec3> slice_directions(MidSlice which) {
  switch (which) {
    case MidSlice::coronal:
      return {Vec3::UnitX(), -Vec3::UnitZ()};
    case MidSlice::sagittal:
      return {Vec3::UnitY(), -Vec3::UnitZ()};
    case MidSlice::axial:
      break;
  }
  return {Vec3::UnitX(), Vec3::UnitY()};
}

/// Of the image's longest side, whichever way it is turned.
double longest_mm(const imaging::Geometry& grid) {
  double longest = 0.0;
  for (Eigen::Index a = 0; a < 3; ++a)
    longest =
        std::max(longest, grid.spacing[a] * static_cast<double>(grid.size[static_cast<std::size_t>(a)]));
  return longest;
}

uchar grey_of(double hu, const session::GreyWindow& grey) {
  const double share = (hu - grey.level_hu) / grey.width_hu + 0.5;
  return static_cast<uchar>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

}  // namespace

SliceLetters letters_of(MidSlice which) {
  switch (which) {
    case MidSlice::coronal:
      return {"R", "L", "S", "I"};
    case MidSlice::sagittal:
      return {"A", "P", "S", "I"};
    case MidSlice::axial:
      break;
  }
  return {"R", "L", "A", "P"};
}

QImage mid_slice(const TurnedImage& image, MidSlice which, int side, const session::GreyWindow& grey) {
  QImage picture(side, side, QImage::Format_Grayscale8);
  picture.fill(Qt::black);
  const imaging::Geometry& grid = image.wanted.grid;
  const imaging::ImageVolume& volume = *image.volume;
  const bool other_order = image.now.slices_reversed != image.wanted.slices_reversed;
  const Vec3 last(static_cast<double>(grid.size[0] - 1), static_cast<double>(grid.size[1] - 1),
                  static_cast<double>(grid.size[2] - 1));
  const Vec3 middle = grid.world(0.5 * last);
  const auto [right, down] = slice_directions(which);
  const double step = longest_mm(grid) / side;
  for (int y = 0; y < side; ++y) {
    uchar* line = picture.scanLine(y);
    for (int x = 0; x < side; ++x) {
      const Vec3 index =
          grid.index(middle + step * (x + 0.5 - 0.5 * side) * right + step * (y + 0.5 - 0.5 * side) * down);
      // A middle between two slices is one of them, whatever the last bits say.
      const Vec3 at = (index + Vec3::Constant(1e-6)).array().round().matrix();
      if ((at.array() < 0.0).any() || (at.array() > last.array()).any()) continue;
      const auto k = static_cast<std::int64_t>(at.z());
      line[x] = grey_of(volume(static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()),
                               other_order ? grid.size[2] - 1 - k : k),
                        grey);
    }
  }
  return picture;
}

OrientationSlice::OrientationSlice(MidSlice which, const QString& title, QWidget* parent)
    : QWidget(parent), which_(which) {
  setAccessibleName(title);
  setToolTip(title);
  setMinimumSize(120, 120);
}

QSize OrientationSlice::sizeHint() const {
  constexpr int small_screen = 760, small_side = 130;
  const int side = screen()->availableSize().height() < small_screen ? small_side : picture_side;
  return {side, side};
}

void OrientationSlice::show_image(const TurnedImage& image, const session::GreyWindow& grey) {
  picture_ = mid_slice(image, which_, picture_side, grey);
  update();
}

void OrientationSlice::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Qt::black);
  const int side = std::min(width(), height());
  const QRect square((width() - side) / 2, (height() - side) / 2, side, side);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(square, picture_);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setBold(true);
  const QFontMetrics metrics(font);
  const SliceLetters letters = letters_of(which_);
  const auto write = [&](const char* letter, const QPointF& centre) {
    QPainterPath path;
    path.addText(centre + QPointF(-0.5 * metrics.horizontalAdvance(letter), 0.5 * metrics.capHeight()), font,
                 letter);
    painter.strokePath(path, QPen(Qt::black, 3.0));
    painter.fillPath(path, QColor(255, 214, 90));
  };
  const double edge = 0.8 * metrics.height(), middle = 0.5 * side;
  write(letters.left, square.topLeft() + QPointF(edge, middle));
  write(letters.right, square.topLeft() + QPointF(side - edge, middle));
  write(letters.above, square.topLeft() + QPointF(middle, edge));
  write(letters.below, square.topLeft() + QPointF(middle, side - edge));
}

}  // namespace ostia::workstation
