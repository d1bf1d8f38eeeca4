#include "page_table.h"

#include "page_text.h"
#include "text.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>

namespace ostia::figure {
namespace {

constexpr double kPadding = 5.5;  // on either side of a cell
constexpr double kLine = 1.35;    // height of a line over that of its letters

struct Columns {
  double size_px = 0.0;
  std::vector<double> width;  ///< paddings included
  std::vector<bool> numeric;
};

bool is_bold(const PageTable& table, std::size_t column, bool header) {
  return header || (table.header.empty() && column == 0);
}

/// The widths that a column would like, and must have.
struct Need {
  double wish = 0.0, least = 0.0;
};

Need need_of(const PageTable& table, std::size_t column, bool numeric, double size) {
  Need need;
  const auto ask = [&](const std::string& text, bool header) {
    const bool bold = is_bold(table, column, header);
    for (const std::string& line : wrapped(text, size, bold, 1e9))
      need.wish = std::max(need.wish, Canvas::text_size(line, size, bold).x());
    // Numbers are kept in one line, with their units.
    const bool whole = numeric && !header;
    need.least =
        std::max(need.least, whole ? Canvas::text_size(text, size, bold).x() : widest_word(text, size, bold));
  };
  if (!table.header.empty()) ask(table.header[column], true);
  for (const auto& row : table.rows) ask(row[column], false);
  need.wish = std::max(need.wish, need.least) + 2.0 * kPadding + 1.0;
  need.least += 2.0 * kPadding + 1.0;
  return need;
}

/// What is left over goes to the columns in the measure of what they lack.
std::vector<double> shared_out(const std::vector<Need>& needs, double width) {
  double wish = 0.0, least = 0.0;
  for (const Need& need : needs) wish += need.wish, least += need.least;
  std::vector<double> widths;
  const double share = wish > least ? std::clamp((width - least) / (wish - least), 0.0, 1.0) : 0.0;
  const double shrink = std::min(1.0, width / least);
  for (const Need& need : needs) widths.push_back(shrink * (need.least + share * (need.wish - need.least)));
  return widths;
}

Columns columns_of(const PageTable& table) {
  const std::size_t count = table.header.empty() ? table.rows.front().size() : table.header.size();
  Columns columns;
  columns.numeric =
      table.header.empty() ? std::vector<bool>(count, false) : numeric_columns(count, table.rows);
  for (const double size : {12.5, 11.5, 10.5, 9.5, 8.5}) {
    std::vector<Need> needs;
    double least = 0.0;
    for (std::size_t c = 0; c < count; ++c) {
      needs.push_back(need_of(table, c, columns.numeric[c], size));
      least += needs.back().least;
    }
    columns.size_px = size;
    columns.width = shared_out(needs, text_width_px);
    if (least <= text_width_px) break;
  }
  return columns;
}

/// The cells of a row in lines.
struct Row {
  std::vector<std::vector<std::string>> cells;
  std::size_t lines = 1;
  bool header = false;
};

Row row_of(const PageTable& table, const std::vector<std::string>& cells, const Columns& columns,
           bool header) {
  Row row;
  row.header = header;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    row.cells.push_back(wrapped(cells[c], columns.size_px, is_bold(table, c, header),
                                columns.width[c] - 2.0 * kPadding + 0.5));
    row.lines = std::max(row.lines, row.cells.back().size());
  }
  return row;
}

class TableSetter {
 public:
  TableSetter(PageFlow& flow, const PageTable& table)
      : flow_(flow), table_(table), columns_(columns_of(table)), look_(theme(Look::light)) {
    if (!table.header.empty())
      header_ = std::make_shared<const Row>(row_of(table, table.header, columns_, true));
  }

  void set() {
    const double head = header_ ? height(*header_, header_->lines) : 0.0;
    std::vector<Row> rows;
    for (const auto& cells : table_.rows) rows.push_back(row_of(table_, cells, columns_, false));
    const double first = rows.empty() ? 0.0 : std::min(height(rows[0], rows[0].lines), 200.0);
    std::vector<std::string> caption;
    if (!table_.caption.empty()) caption = wrapped(table_.caption, 12.0, false, text_width_px);
    flow_.require(head + first + 17.0 * static_cast<double>(caption.size()) + 6.0);
    for (const std::string& line : caption)
      flow_.put(17.0, [line, color = look_.muted](Canvas& canvas, double y) {
        canvas.text({page_left_px, y}, line, {.size_px = 12.0, .color = color});
      });
    put_header();
    const std::size_t most = static_cast<std::size_t>((text_height_px - head - 20.0) / line_height()) - 1;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto row = std::make_shared<const Row>(std::move(rows[r]));
      for (std::size_t from = 0; from < row->lines; from += most)
        put(row, from, std::min(row->lines, from + most), r % 2 == 1);
    }
    flow_.space(14.0);
  }

 private:
  double line_height() const { return kLine * columns_.size_px; }
  double height(const Row&, std::size_t lines) const {
    return line_height() * static_cast<double>(lines) + 8.0;
  }
  double width() const { return std::accumulate(columns_.width.begin(), columns_.width.end(), 0.0); }
  void put_header() {
    if (header_) put_lines(header_, 0, header_->lines, false);
  }
  void put(const std::shared_ptr<const Row>& row, std::size_t from, std::size_t to, bool panel) {
    const std::size_t page = flow_.page();
    flow_.require(height(*row, to - from));
    if (flow_.page() != page) put_header();
    put_lines(row, from, to, panel);
  }
  void put_lines(const std::shared_ptr<const Row>& row, std::size_t from, std::size_t to, bool panel) {
    const double high = height(*row, to - from);
    flow_.put(high, [row, from, to, panel, high, columns = columns_, look = look_, wide = width(),
                     facts = header_ == nullptr, line = line_height()](Canvas& canvas, double y) {
      if (panel) canvas.fill(page_left_px, y, wide, high, look.panel);
      double x = page_left_px;
      for (std::size_t c = 0; c < row->cells.size(); ++c) {
        const bool number = columns.numeric[c];
        for (std::size_t i = from; i < std::min(to, row->cells[c].size()); ++i)
          canvas.text({number ? x + columns.width[c] - kPadding : x + kPadding,
                       y + 4.0 + line * static_cast<double>(i - from)},
                      row->cells[c][i],
                      {.size_px = columns.size_px,
                       .color = facts && c == 0 ? look.muted : look.foreground,
                       .bold = row->header || (facts && c == 0),
                       .across = number ? Align::end : Align::start});
        x += columns.width[c];
      }
      canvas.line({page_left_px, y + high}, {page_left_px + wide, y + high},
                  row->header ? look.muted : look.grid, row->header ? 1.4 : 0.8);
    });
  }

  PageFlow& flow_;
  const PageTable& table_;
  Columns columns_;
  Theme look_;
  std::shared_ptr<const Row> header_;
};

}  // namespace

void put_table(PageFlow& flow, const PageTable& table) {
  if (table.header.empty() && table.rows.empty()) return;
  TableSetter(flow, table).set();
}

}  // namespace ostia::figure
