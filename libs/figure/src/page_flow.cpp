#include "page_flow.h"

#include <algorithm>
#include <utility>

namespace ostia::figure {

void PageFlow::heading(double height, Draw draw, const std::string& bookmark) {
  waiting_.push_back({height, std::move(draw), bookmark});
}

double PageFlow::waiting() const {
  double height = 0.0;
  for (const Heading& one : waiting_) height += one.height;
  return height;
}

void PageFlow::new_page() {
  if (pages_.back().empty()) return;
  pages_.emplace_back();
  y_ = page_top_px;
}

void PageFlow::require(double height) {
  if (std::min(height + waiting(), text_height_px) > room()) new_page();
}

void PageFlow::place_headings() {
  for (Heading& one : std::exchange(waiting_, {})) {
    if (one.height > room()) new_page();
    if (!one.bookmark.empty()) bookmarks_.push_back({one.bookmark, pages_.size() - 1, y_});
    draw(one.height, std::move(one.draw));
  }
}

void PageFlow::draw(double height, Draw draw) {
  pages_.back().push_back([y = y_, draw = std::move(draw)](Canvas& canvas) { draw(canvas, y); });
  y_ += height;
}

void PageFlow::put(double height, Draw how) {
  require(height);
  place_headings();
  if (height > room()) new_page();
  draw(height, std::move(how));
}

void PageFlow::space(double height) {
  if (!pages_.back().empty()) y_ += height;
}

void PageFlow::finish() {
  place_headings();
}

}  // namespace ostia::figure
