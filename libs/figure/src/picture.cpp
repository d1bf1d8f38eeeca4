#include "ostia/figure/picture.h"

#include "canvas.h"
#include "png_bytes.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>

namespace ostia::figure {
namespace {

struct ReleasePicture {
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
  void operator()(cairo_t* p) const { cairo_destroy(p); }
};
using Surface = std::unique_ptr<cairo_surface_t, ReleasePicture>;
using Context = std::unique_ptr<cairo_t, ReleasePicture>;

cairo_status_t append_picture(void* text, const unsigned char* bytes, unsigned int count) {
  try {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  } catch (...) {
    return CAIRO_STATUS_NO_MEMORY;  // an exception must not pass through C
  }
  return CAIRO_STATUS_SUCCESS;
}

void check_picture(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw ResourceError(std::string("a figure could not be drawn: ") + cairo_status_to_string(status));
  }
}

Surface painted(const Drawing& drawing, double density, cairo_format_t format) {
  if (!(density >= 0.1 && density <= 16.0)) {
    throw InvalidInput("a picture's density must lie between 0.1 and 16, not " + std::to_string(density));
  }
  const auto pixels = [&](int length) {
    return std::max(1, static_cast<int>(std::lround(length * density)));
  };
  Surface surface(cairo_image_surface_create(format, pixels(drawing.width()), pixels(drawing.height())));
  const Context context(cairo_create(surface.get()));
  if (format == CAIRO_FORMAT_RGB24) {
    cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
    cairo_paint(context.get());
  }
  cairo_scale(context.get(), density, density);
  drawing.replay(context.get());
  check_picture(cairo_status(context.get()));
  cairo_surface_flush(surface.get());
  return surface;
}

/// Draws on a vector surface that appends to the text given.
template <class Create>
std::string vector_file(const Drawing& drawing, double unit, const Create& create) {
  std::string bytes;
  Surface surface(create(&bytes, drawing.width() * unit, drawing.height() * unit));
  {
    const Context context(cairo_create(surface.get()));
    cairo_scale(context.get(), unit, unit);
    drawing.replay(context.get());
    check_picture(cairo_status(context.get()));
  }
  cairo_surface_finish(surface.get());
  check_picture(cairo_surface_status(surface.get()));
  return bytes;
}

/// Cairo numbers the surfaces and images of an SVG through the life of the process; numbered anew by first
/// appearance, the same picture gives the same bytes. Neither quotes nor # occur in embedded data.
std::string renumbered(const std::string& svg) {
  std::string result;
  std::map<std::string, std::size_t> numbers;
  std::size_t at = 0;
  while (at < svg.size()) {
    std::size_t name = std::string::npos;
    for (const std::string_view lead : {"id=\"surface", "id=\"image", "#surface", "#image"}) {
      if (svg.compare(at, lead.size(), lead) == 0) name = lead.size();
    }
    if (name == std::string::npos) {
      result += svg[at++];
      continue;
    }
    const std::size_t digits = std::min(svg.find_first_not_of("0123456789", at + name), svg.size());
    const std::string number = svg.substr(at + name, digits - at - name);
    result.append(svg, at, name);
    result += std::to_string(numbers.try_emplace(number, numbers.size()).first->second);
    at = digits;
  }
  return result;
}

}  // namespace

Picture::Picture(std::shared_ptr<const Drawing> drawing) : drawing_(std::move(drawing)) {}

int Picture::width() const {
  return drawing_->width();
}
int Picture::height() const {
  return drawing_->height();
}

Raster Picture::raster(double density) const {
  const Surface surface = painted(*drawing_, density, CAIRO_FORMAT_ARGB32);
  Raster result;
  result.width = cairo_image_surface_get_width(surface.get());
  result.height = cairo_image_surface_get_height(surface.get());
  result.rgba.resize(4 * static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height));
  const unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  std::uint8_t* out = result.rgba.data();
  for (int row = 0; row < result.height; ++row) {
    for (int column = 0; column < result.width; ++column, out += 4) {
      std::uint32_t argb = 0;
      std::memcpy(&argb,
                  data + static_cast<std::ptrdiff_t>(row) * stride + 4 * static_cast<std::ptrdiff_t>(column),
                  4);
      const std::uint32_t alpha = argb >> 24;
      const auto straight = [&](std::uint32_t c) {
        return static_cast<std::uint8_t>(alpha == 0 ? 0 : std::min(255U, (c * 255U + alpha / 2) / alpha));
      };
      out[0] = straight((argb >> 16) & 255U);
      out[1] = straight((argb >> 8) & 255U);
      out[2] = straight(argb & 255U);
      out[3] = static_cast<std::uint8_t>(alpha);
    }
  }
  return result;
}

std::string Picture::png(double density) const {
  return drawing_->png(density, [&] {
    const Surface surface = painted(*drawing_, density, CAIRO_FORMAT_RGB24);
    return png_bytes(
        cairo_image_surface_get_data(surface.get()), cairo_image_surface_get_width(surface.get()),
        cairo_image_surface_get_height(surface.get()), cairo_image_surface_get_stride(surface.get()));
  });
}

std::string Picture::svg() const {
  return renumbered(vector_file(*drawing_, 1.0, [](std::string* bytes, double width, double height) {
    cairo_surface_t* surface = cairo_svg_surface_create_for_stream(append_picture, bytes, width, height);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    return surface;
  }));
}

std::string Picture::pdf() const {
  constexpr double kPointsPerPixel = 0.75;
  return vector_file(*drawing_, kPointsPerPixel, [](std::string* bytes, double width, double height) {
    cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(append_picture, bytes, width, height);
    // Cairo would write the time of day, and with it no two files would be the same.
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
    return surface;
  });
}

void Picture::write_png(const std::filesystem::path& path, double density) const {
  core::write_file(path, png(density));
}
void Picture::write_svg(const std::filesystem::path& path) const {
  core::write_file(path, svg());
}
void Picture::write_pdf(const std::filesystem::path& path) const {
  core::write_file(path, pdf());
}

void Picture::write(const std::filesystem::path& path, double density) const {
  const std::string extension = path.extension().string();
  if (extension == ".png") return write_png(path, density);
  if (extension == ".svg") return write_svg(path);
  if (extension == ".pdf") return write_pdf(path);
  throw InvalidInput("a picture cannot be written as \"" + path.filename().string() +
                     "\": its name must end in .png, .svg or .pdf");
}

Picture picture_of(const Raster& raster, double width) {
  if (raster.width < 1 || raster.height < 1 ||
      raster.rgba.size() !=
          4 * static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height)) {
    throw InvalidInput("an image of " + std::to_string(raster.width) + " x " + std::to_string(raster.height) +
                       " pixels with " + std::to_string(raster.rgba.size()) + " bytes cannot be shown");
  }
  if (!(width > 0.0)) width = raster.width;
  const double height = width * raster.height / raster.width;
  return drawn(static_cast<int>(std::lround(width)), std::max(1, static_cast<int>(std::lround(height))),
               [&](Canvas& canvas) { canvas.image(raster, 0.0, 0.0, width, height); });
}

Picture grid(const std::vector<Picture>& panels, const GridOptions& options) {
  if (panels.empty()) throw InvalidInput("a figure needs at least one panel");
  if (options.columns < 0 || options.gap_px < 0)
    throw InvalidInput("a figure's columns and gap must not be negative");
  const std::size_t most = options.columns > 0 ? static_cast<std::size_t>(options.columns) : 4;
  const std::size_t columns = std::min(most, panels.size());
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  std::vector<int> widths(columns, 0);
  std::vector<int> heights(rows, 0);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    widths[i % columns] = std::max(widths[i % columns], panels[i].width());
    heights[i / columns] = std::max(heights[i / columns], panels[i].height());
  }
  const int gap = options.gap_px;
  const int title = options.title.empty() ? 0 : 40;
  int width = gap;
  for (const int w : widths) width += w + gap;
  int height = gap + title;
  for (const int h : heights) height += h + gap;

  const Theme look = theme(options.look);
  return drawn(width, height, [&](Canvas& canvas) {
    canvas.fill(0, 0, width, height, look.background);
    if (title > 0) {
      canvas.text({gap + 4.0, gap + 0.5 * title - 4.0}, options.title,
                  {.size_px = 19, .color = look.foreground, .bold = true, .along = Align::middle});
    }
    double y = gap + title;
    for (std::size_t row = 0; row < rows; ++row) {
      double x = gap;
      for (std::size_t column = 0; column < columns && row * columns + column < panels.size(); ++column) {
        const std::size_t i = row * columns + column;
        canvas.picture(panels[i], x, y);
        if (options.letters) {
          canvas.text({x + 8.0, y + 6.0}, std::string(1, static_cast<char>('a' + static_cast<int>(i % 26))),
                      {.size_px = 16, .color = look.foreground, .bold = true, .halo = look.background});
        }
        x += widths[column] + gap;
      }
      y += heights[row] + gap;
    }
  });
}

}  // namespace ostia::figure
