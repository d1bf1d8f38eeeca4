#include "commands/palette_rows.h"

#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QVariant>

namespace ostia::workstation {
namespace {

constexpr int margin = 10, between_lines = 2, above = 5;  // units of the interface
constexpr int tick_width = 20;
constexpr int key_pad = 6, between_keys = 5;
constexpr double small_font = 0.9;

QFont smaller(const QFont& font) {
  QFont made = font;
  made.setPointSizeF(small_font * font.pointSizeF());
  return made;
}

struct Colors {
  QColor text, below, edge, typed;
};

Colors colors_of(const QStyleOptionViewItem& option, bool usable) {
  const QPalette& palette = option.palette;
  const bool chosen = option.state & QStyle::State_Selected;
  const QColor text = chosen ? palette.color(QPalette::Active, QPalette::HighlightedText)
                             : palette.color(QPalette::Active, QPalette::Text);
  const QColor faint = palette.color(QPalette::Disabled, QPalette::Text);
  Colors made{text, faint, faint, chosen ? text : palette.color(QPalette::Active, QPalette::Link)};
  if (chosen) {
    made.below = made.edge = text;
    made.below.setAlphaF(0.85);
    made.edge.setAlphaF(0.6);
  }
  if (!usable) {
    made.text = made.typed = chosen ? made.below : faint;
    if (chosen) made.text.setAlphaF(0.7);
  }
  return made;
}

/// Each key in a frame, from the right; returns the width that they take.
int draw_keys(QPainter& painter, const QRect& room, const QStringList& keys, const Colors& colors) {
  const QFontMetrics metrics = painter.fontMetrics();
  int right = room.right();
  for (int i = keys.size() - 1; i >= 0; --i) {
    const int width = metrics.horizontalAdvance(keys[i]) + 2 * key_pad;
    const QRectF cap(right - width + 0.5, room.center().y() - 0.5 * metrics.height() - 1.5, width - 1.0,
                     metrics.height() + 3.0);
    painter.setPen(QPen(colors.edge, 1.0));
    painter.drawRoundedRect(cap, 3.0, 3.0);
    painter.setPen(colors.text);
    painter.drawText(cap, Qt::AlignCenter, keys[i]);
    right -= width + between_keys;
  }
  return room.right() - right;
}

/// In one line; what was typed is bold and in a colour of its own.
void draw_text(QPainter& painter, const QRect& room, const QString& text, const QVariantList& marks,
               const Colors& colors) {
  const QFont plain = painter.font();
  QFont bold = plain;
  bold.setBold(true);
  int x = room.left();
  for (int begin = 0; begin < text.size();) {
    const bool typed = marks.contains(begin);
    int end = begin + 1;
    while (end < text.size() && marks.contains(end) == typed) ++end;
    painter.setFont(typed ? bold : plain);
    painter.setPen(typed ? colors.typed : colors.text);
    const QRect rest(x, room.top(), room.right() - x, room.height());
    if (rest.width() <= 0) break;
    const QString part =
        painter.fontMetrics().elidedText(text.mid(begin, end - begin), Qt::ElideRight, rest.width());
    painter.drawText(rest, Qt::AlignVCenter | Qt::AlignLeft | Qt::TextSingleLine, part);
    x += painter.fontMetrics().horizontalAdvance(part);
    begin = end;
  }
  painter.setFont(plain);
}

void draw_tick(QPainter& painter, const QRect& room, const QColor& color) {
  painter.setPen(QPen(color, 1.7, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  const QPointF at = QRectF(room).center();
  painter.drawPolyline(
      QPolygonF({at + QPointF(-4.0, 0.0), at + QPointF(-1.0, 3.5), at + QPointF(4.5, -4.0)}));
}

}  // namespace

void PaletteRows::paint(QPainter* painter, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const {
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  const bool usable = index.data(palette_usable).toBool();
  const Colors colors = colors_of(option, usable);
  if (option.state & QStyle::State_Selected)
    painter->fillRect(option.rect, option.palette.color(QPalette::Active, QPalette::Highlight));
  QRect room = option.rect.adjusted(margin, above, -margin, -above);
  painter->setFont(smaller(option.font));
  room.setRight(room.right() - draw_keys(*painter, room, index.data(palette_keys).toStringList(), colors));
  if (index.data(palette_checked).toBool()) {
    room.setRight(room.right() - tick_width);
    draw_tick(*painter, QRect(room.right(), room.top(), tick_width, room.height()), colors.text);
  }
  const int high = QFontMetrics(option.font).height();
  painter->setFont(option.font);
  draw_text(*painter, QRect(room.left(), room.top(), room.width(), high), index.data(palette_text).toString(),
            index.data(palette_marks).toList(), colors);
  painter->setFont(smaller(option.font));
  painter->setPen(colors.below);
  const QRect below(room.left(), room.top() + high + between_lines, room.width(),
                    painter->fontMetrics().height());
  painter->drawText(
      below, Qt::AlignVCenter | Qt::AlignLeft | Qt::TextSingleLine,
      painter->fontMetrics().elidedText(index.data(palette_below).toString(), Qt::ElideRight, below.width()));
  painter->restore();
}

QSize PaletteRows::sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const {
  const int high = QFontMetrics(option.font).height() + between_lines +
                   QFontMetrics(smaller(option.font)).height() + 2 * above;
  return {100, high};
}

}  // namespace ostia::workstation
