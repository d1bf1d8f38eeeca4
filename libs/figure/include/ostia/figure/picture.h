#pragma once
/// \file A finished figure: recorded once, written as PNG, SVG or PDF.

#include "ostia/figure/color.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ostia::figure {

/// 8-bit RGBA pixels with straight alpha, rows from the top.
struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba{};
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() +
           4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

class Drawing;

/// A figure as a list of lines, text and images. A value that is cheap to copy; one picture must not be used
/// by two threads at once. Its unit is the CSS pixel (1/96 inch). The files hold no date, name or path: the
/// same picture gives the same bytes. Writers throw IoError or ResourceError; nothing half-written is left.
class Picture {
 public:
  explicit Picture(std::shared_ptr<const Drawing> drawing);

  int width() const;
  int height() const;
  /// `density` is the number of raster pixels a picture pixel, in [0.1, 16].
  Raster raster(double density = 1.0) const;
  std::string png(double density = 1.0) const;
  std::string svg() const;
  std::string pdf() const;

  void write_png(const std::filesystem::path& path, double density = 1.0) const;
  void write_svg(const std::filesystem::path& path) const;
  void write_pdf(const std::filesystem::path& path) const;
  /// By extension: .png (at `density`), .svg or .pdf; any other throws InvalidInput.
  void write(const std::filesystem::path& path, double density = 1.0) const;

  const Drawing& drawing() const { return *drawing_; }

 private:
  std::shared_ptr<const Drawing> drawing_;
};

/// An image alone, `raster` shown at `width` picture pixels (0: one to one).
Picture picture_of(const Raster& raster, double width = 0.0);

struct GridOptions {
  int columns = 0;  ///< 0: as many as there are panels, four at most
  std::string title{};
  Look look = Look::dark;
  int gap_px = 12;
  bool letters = false;  ///< a, b, c ... in the corners
};
/// Panels side by side, row by row; each row as high as its highest panel. Throws InvalidInput without
/// panels.
Picture grid(const std::vector<Picture>& panels, const GridOptions& options = {});

}  // namespace ostia::figure
