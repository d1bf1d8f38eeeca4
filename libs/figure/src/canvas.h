#pragma once
/// \file Drawing with Cairo and Pango, for this room's own use.

#include "ostia/figure/picture.h"
#include "ostia/geometry/vec.h"

#include <cairo.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace ostia::figure {

using geometry::Vec2;

enum class Align { start, middle, end };

struct TextStyle {
  double size_px = 12.0;
  Color color{};
  bool bold = false;
  Align across = Align::start;     ///< where the given point lies within the text's width
  Align along = Align::start;      ///< and within its height: start is the top
  bool upwards = false;            ///< turned by 90 degrees, read from below
  Color halo{0.0, 0.0, 0.0, 0.0};  ///< an outline that keeps the text legible on an image
};

/// Draws in picture pixels, y down. A thin layer: one call, one thing drawn.
class Canvas {
 public:
  explicit Canvas(cairo_t* context) : context_(context) {}

  void fill(double x, double y, double width, double height, const Color& color);
  void frame(double x, double y, double width, double height, const Color& color, double line_px);
  void line(const Vec2& a, const Vec2& b, const Color& color, double line_px);
  void polyline(const std::vector<Vec2>& points, const Color& color, double line_px, bool dashed = false);
  void polygon(const std::vector<Vec2>& points, const Color& color);
  void disc(const Vec2& centre, double radius, const Color& color);
  void circle(const Vec2& centre, double radius, const Color& color, double line_px);
  void text(const Vec2& at, const std::string& text, const TextStyle& style);
  static Vec2 text_size(const std::string& text, double size_px, bool bold = false);
  void image(const Raster& raster, double x, double y, double width, double height);
  void picture(const Picture& picture, double x, double y, double scale = 1.0);

  /// Draws within a rectangle only, for as long as it lives.
  class Clip {
   public:
    Clip(Canvas& canvas, double x, double y, double width, double height);
    ~Clip();
    Clip(const Clip&) = delete;
    Clip& operator=(const Clip&) = delete;

   private:
    Canvas& canvas_;
  };

 private:
  void set(const Color& color);
  cairo_t* context_;
};

/// A recorded picture.
class Drawing {
 public:
  Drawing(int width, int height, const std::function<void(Canvas&)>& draw);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;
  int width() const { return width_; }
  int height() const { return height_; }
  void replay(cairo_t* context) const;
  /// Its PNG, encoded once for a density: a document and the file beside it show the same picture.
  const std::string& png(double density, const std::function<std::string()>& encoded) const;

 private:
  int width_, height_;
  cairo_surface_t* recording_ = nullptr;
  mutable std::mutex encoding_;
  mutable std::map<double, std::string> png_;
};

/// Throws InvalidInput for a size that Cairo cannot hold, and for one of nothing.
Picture drawn(int width, int height, const std::function<void(Canvas&)>& draw);

}  // namespace ostia::figure
