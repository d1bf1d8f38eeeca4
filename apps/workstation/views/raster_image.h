#pragma once
/// \file Pictures of Qt as the libraries have them, and the other way round.

#include "ostia/figure/picture.h"
#include "ostia/imaging/series_preview.h"

#include <QImage>
#include <cstring>

namespace ostia::workstation {

/// Copies the pixels, with their opacity.
inline figure::Raster raster_of(const QImage& image) {
  const QImage rgba = image.convertToFormat(QImage::Format_RGBA8888);
  figure::Raster raster{rgba.width(), rgba.height(), {}};
  const std::size_t line = 4 * static_cast<std::size_t>(rgba.width());
  raster.rgba.resize(line * static_cast<std::size_t>(rgba.height()));
  for (int row = 0; row < rgba.height(); ++row)
    std::memcpy(raster.rgba.data() + static_cast<std::size_t>(row) * line, rgba.constScanLine(row), line);
  return raster;
}

/// Copies the pixels.
inline QImage preview_image(const imaging::SeriesPreview& made) {
  return QImage(made.pixels.data(), made.width, made.height, made.width, QImage::Format_Grayscale8).copy();
}

}  // namespace ostia::workstation
