#pragma once
/// \file Pages that are filled from the top down.

#include "canvas.h"

#include <functional>
#include <string>
#include <vector>

namespace ostia::figure {

/// A4 in CSS pixels.
inline constexpr double page_width_px = 210.0 / 25.4 * 96.0, page_height_px = 297.0 / 25.4 * 96.0;
inline constexpr double page_left_px = 60.0, page_top_px = 56.0, page_bottom_px = page_height_px - 72.0;
inline constexpr double text_width_px = page_width_px - 2.0 * page_left_px;
inline constexpr double text_height_px = page_bottom_px - page_top_px;

struct Bookmark {
  std::string heading;
  std::size_t page = 0;  ///< from 0
  double y_px = 0.0;
};

/// Where the next part goes. Headings wait for what follows them, so that both stand on the same page.
class PageFlow {
 public:
  using Draw = std::function<void(Canvas&, double y)>;

  /// A heading of a height, drawn when the next part's page is known.
  void heading(double height, Draw draw, const std::string& bookmark);
  /// A part that is not cut: on this page if it fits, with the headings before it, else on the next.
  void put(double height, Draw draw);
  /// What the next parts need together; begins a page where this one has not got it. No more than a page.
  void require(double height);
  /// Empty space, left out at the top of a page.
  void space(double height);
  double room() const { return page_bottom_px - y_; }
  /// Height of the headings that wait.
  double waiting() const;
  /// The page that is being filled, from 1.
  std::size_t page() const { return pages_.size(); }
  void finish();

  const std::vector<std::vector<std::function<void(Canvas&)>>>& pages() const { return pages_; }
  const std::vector<Bookmark>& bookmarks() const { return bookmarks_; }

 private:
  struct Heading {
    double height = 0.0;
    Draw draw;
    std::string bookmark;
  };
  void draw(double height, Draw draw);
  void new_page();
  void place_headings();
  double y_ = page_top_px;
  std::vector<std::vector<std::function<void(Canvas&)>>> pages_{1};
  std::vector<Heading> waiting_;
  std::vector<Bookmark> bookmarks_;
};

}  // namespace ostia::figure
