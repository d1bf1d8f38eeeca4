#pragma once
/// \file Pictures of Qt as the libraries have them.

#include "ostia/figure/picture.h"

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

}  // namespace ostia::workstation
