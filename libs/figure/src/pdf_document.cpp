#include "ostia/figure/pdf_document.h"

#include "page_flow.h"
#include "page_table.h"
#include "page_text.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <cairo-pdf.h>
#include <cairo.h>

#include <array>
#include <cmath>

namespace ostia::figure {
namespace {

constexpr double kBody = 13.0, kBodyLine = 18.5;
constexpr Color kAccent{0.043, 0.384, 0.651}, kGood{0.039, 0.498, 0.349}, kWarn{0.659, 0.357, 0.0},
    kBad{0.702, 0.149, 0.118};

Color color_of(Notice kind) {
  return kind == Notice::good      ? kGood
         : kind == Notice::warning ? kWarn
         : kind == Notice::bad     ? kBad
                                   : kAccent;
}

/// "Page %1 of %2" with its numbers.
std::string page_text(std::string words, std::size_t number, std::size_t of) {
  for (const auto& [place, value] : {std::pair("%1", number), std::pair("%2", of)})
    if (const auto at = words.find(place); at != std::string::npos)
      words.replace(at, 2, std::to_string(value));
  return words;
}

struct ReleasePdf {
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
  void operator()(cairo_t* p) const { cairo_destroy(p); }
};

cairo_status_t append_pdf(void* text, const unsigned char* bytes, unsigned int count) {
  try {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  } catch (...) {
    return CAIRO_STATUS_NO_MEMORY;  // an exception must not pass through C
  }
  return CAIRO_STATUS_SUCCESS;
}

void check_pdf(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw ResourceError(std::string("a PDF could not be made: ") + cairo_status_to_string(status));
}

}  // namespace

struct PdfDocument::Impl {
  std::string title;
  PdfOptions options;
  PageFlow flow;
  Theme look = theme(Look::light);
  int pictures = 0, tables = 0;

  void text(const std::string& what, double size, double line, bool bold, const Color& color,
            double inset = 0.0) {
    for (const std::string& one : wrapped(what, size, bold, text_width_px - inset))
      flow.put(line, [one, size, bold, color, inset](Canvas& canvas, double y) {
        canvas.text({page_left_px + inset, y}, one, {.size_px = size, .color = color, .bold = bold});
      });
  }
  void heading(const std::string& what, double size, double above, bool rule, bool bookmark) {
    flow.space(above);
    std::vector<std::string> lines = wrapped(what, size, true, text_width_px);
    if (lines.size() > 4) {
      lines.resize(4);
      lines.back() = cut_to(lines.back() + std::string(3, '.'), size, true, text_width_px);
    }
    const double line = 1.35 * size;
    const double height = line * static_cast<double>(lines.size()) + (rule ? 12.0 : 4.0);
    flow.heading(
        height,
        [lines, size, line, rule, height, look = look](Canvas& canvas, double y) {
          for (const std::string& one : lines) {
            canvas.text({page_left_px, y}, one, {.size_px = size, .color = look.foreground, .bold = true});
            y += line;
          }
          if (rule)
            canvas.line({page_left_px, y + 3.0}, {page_left_px + text_width_px, y + 3.0}, look.grid, 1.0);
        },
        bookmark ? what : std::string());
  }
  Picture page(const PageFlow& set, std::size_t number) const {
    return drawn(
        static_cast<int>(std::ceil(page_width_px)), static_cast<int>(std::ceil(page_height_px)),
        [&](Canvas& canvas) {
          canvas.fill(0.0, 0.0, std::ceil(page_width_px), std::ceil(page_height_px), {1.0, 1.0, 1.0, 1.0});
          for (const auto& draw : set.pages()[number]) draw(canvas);
          foot(canvas, number + 1, set.pages().size());
        });
  }
  void foot(Canvas& canvas, std::size_t number, std::size_t of) const {
    const double y = page_bottom_px + 22.0, right = page_left_px + text_width_px;
    canvas.line({page_left_px, y - 7.0}, {right, y - 7.0}, look.grid, 0.8);
    const std::string count = page_text(options.words.page, number, of);
    canvas.text({right, y}, count, {.size_px = 10.5, .color = look.muted, .across = Align::end});
    canvas.text({page_left_px, y}, cut_to(options.footer, 10.5, false, text_width_px - 110.0),
                {.size_px = 10.5, .color = look.muted});
  }
};

PdfDocument::PdfDocument(std::string title, std::string subtitle, PdfOptions options)
    : impl_(std::make_unique<Impl>()) {
  impl_->title = std::move(title);
  impl_->options = std::move(options);
  impl_->text(impl_->title, 24.0, 32.0, true, impl_->look.foreground);
  if (!subtitle.empty()) impl_->text(subtitle, 13.0, 18.0, false, impl_->look.muted);
  impl_->flow.space(10.0);
}
PdfDocument::~PdfDocument() = default;
PdfDocument::PdfDocument(PdfDocument&&) noexcept = default;
PdfDocument& PdfDocument::operator=(PdfDocument&&) noexcept = default;

void PdfDocument::section(const std::string& heading) {
  impl_->heading(heading, 17.0, 16.0, true, true);
}
void PdfDocument::subsection(const std::string& heading) {
  impl_->heading(heading, 14.0, 10.0, false, false);
}

void PdfDocument::paragraph(const std::string& text) {
  impl_->text(text, kBody, kBodyLine, false, impl_->look.foreground);
  impl_->flow.space(7.0);
}

void PdfDocument::notice(Notice kind, const std::string& text) {
  constexpr double kInset = 16.0;
  const Color color = color_of(kind);
  const std::string heading = impl_->options.words.heading(kind);
  std::vector<std::string> lines = wrapped(text, kBody, false, text_width_px - 2.0 * kInset);
  lines.insert(lines.begin(), heading);
  // The whole of it on one page where it is short; else it runs on.
  impl_->flow.require(kBodyLine * static_cast<double>(std::min<std::size_t>(lines.size(), 30)) + 12.0);
  const auto strip = [&](double height, const std::string& line, bool bold) {
    impl_->flow.put(height, [=, look = impl_->look](Canvas& canvas, double y) {
      canvas.fill(page_left_px, y, text_width_px, height + 0.3, look.panel);
      canvas.fill(page_left_px, y, 4.0, height + 0.3, color);
      if (!line.empty())
        canvas.text({page_left_px + kInset, y}, line,
                    {.size_px = kBody, .color = bold ? color : look.foreground, .bold = bold});
    });
  };
  strip(6.0, {}, false);
  for (std::size_t i = 0; i < lines.size(); ++i) strip(kBodyLine, lines[i], i == 0);
  strip(6.0, {}, false);
  impl_->flow.space(10.0);
}

void PdfDocument::key_values(const std::vector<std::pair<std::string, std::string>>& rows) {
  PageTable table;
  for (const auto& [key, value] : rows) table.rows.push_back({key, value});
  put_table(impl_->flow, table);
}

void PdfDocument::table(const std::vector<std::string>& header,
                        const std::vector<std::vector<std::string>>& rows, const std::string& caption) {
  if (header.empty()) throw InvalidInput("a report's table needs at least one column");
  for (const auto& row : rows)
    if (row.size() != header.size())
      throw InvalidInput("a report's table has a row of " + std::to_string(row.size()) +
                         " cells under a header of " + std::to_string(header.size()));
  ++impl_->tables;
  put_table(impl_->flow, {header, rows,
                          caption.empty() ? caption
                                          : impl_->options.words.table + " " + std::to_string(impl_->tables) +
                                                ". " + caption});
}

void PdfDocument::picture(const Picture& picture, const std::string& caption) {
  constexpr double kSize = 12.0, kLine = 16.5;
  const std::string text =
      impl_->options.words.figure + " " + std::to_string(++impl_->pictures) + ". " + caption;
  const std::vector<std::string> lines = wrapped(text, kSize, false, text_width_px);
  const double below = 8.0 + kLine * static_cast<double>(lines.size());
  const double most = std::max(100.0, text_height_px - impl_->flow.waiting() - below - 2.0);
  const double scale = std::min({1.0, text_width_px / picture.width(), most / picture.height()});
  const double high = scale * picture.height();
  impl_->flow.put(high + below, [=, look = impl_->look](Canvas& canvas, double y) {
    canvas.picture(picture, page_left_px, y, scale);
    y += high + 8.0;
    for (const std::string& line : lines) {
      canvas.text({page_left_px, y}, line, {.size_px = kSize, .color = look.muted});
      y += kLine;
    }
  });
  impl_->flow.space(14.0);
}

std::vector<Picture> PdfDocument::pages() const {
  PageFlow set = impl_->flow;
  set.finish();
  std::vector<Picture> pages;
  for (std::size_t i = 0; i < set.pages().size(); ++i) pages.push_back(impl_->page(set, i));
  return pages;
}

std::string PdfDocument::pdf() const {
  constexpr double kPoints = 0.75;
  PageFlow set = impl_->flow;
  set.finish();
  std::string bytes;
  const std::unique_ptr<cairo_surface_t, ReleasePdf> surface(cairo_pdf_surface_create_for_stream(
      append_pdf, &bytes, kPoints * page_width_px, kPoints * page_height_px));
  // Cairo would write the time of day, and with it no two files would be the same.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  const std::string title = cut_to(impl_->title, 10.0, false, 4000.0);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  for (const Bookmark& mark : set.bookmarks()) {
    const std::string place = "page=" + std::to_string(mark.page + 1) + " pos=[" +
                              std::to_string(std::lround(kPoints * page_left_px)) + " " +
                              std::to_string(std::lround(kPoints * mark.y_px)) + "]";
    cairo_pdf_surface_add_outline(surface.get(), CAIRO_PDF_OUTLINE_ROOT,
                                  cut_to(mark.heading, 10.0, false, 2000.0).c_str(), place.c_str(),
                                  CAIRO_PDF_OUTLINE_FLAG_OPEN);
  }
  {
    const std::unique_ptr<cairo_t, ReleasePdf> context(cairo_create(surface.get()));
    cairo_scale(context.get(), kPoints, kPoints);
    for (std::size_t i = 0; i < set.pages().size(); ++i) {
      impl_->page(set, i).drawing().replay(context.get());
      cairo_show_page(context.get());
      check_pdf(cairo_status(context.get()));
    }
  }
  cairo_surface_finish(surface.get());
  check_pdf(cairo_surface_status(surface.get()));
  return bytes;
}

void PdfDocument::write(const std::filesystem::path& path) const {
  core::write_file(path, pdf());
}

}  // namespace ostia::figure
