#include "commands/icons.h"

#include <QApplication>
#include <QIconEngine>
#include <QMap>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <array>

namespace ostia::workstation {
namespace {

// All on a square of 24 by 24, in lines 1.7 wide of the text's colour; `accent` is the theme's.
using Draw = void (*)(QPainter& p, const QColor& line, const QColor& accent);

void pen(QPainter& p, const QColor& color, Qt::PenStyle style = Qt::SolidLine, double width = 1.7) {
  p.setPen(QPen(color, width, style, Qt::RoundCap, Qt::RoundJoin));
  p.setBrush(Qt::NoBrush);
}
void dot(QPainter& p, const QColor& color, double x, double y, double radius = 2.0) {
  p.setPen(Qt::NoPen);
  p.setBrush(color);
  p.drawEllipse(QPointF(x, y), radius, radius);
  p.setBrush(Qt::NoBrush);
}
QPainterPath curve(QPointF from, QPointF first, QPointF second, QPointF to) {
  QPainterPath path(from);
  path.cubicTo(first, second, to);
  return path;
}

void back_arrow(QPainter& p, const QColor& line) {
  pen(p, line);
  QPainterPath path(QPointF(5, 9));
  path.lineTo(14, 9);
  path.cubicTo(21, 9, 21, 18, 14, 18);
  path.lineTo(9, 18);
  p.drawPath(path);
  p.drawPolyline(QPolygonF({QPointF(9, 5), QPointF(5, 9), QPointF(9, 13)}));
}
void undo(QPainter& p, const QColor& line, const QColor&) {
  back_arrow(p, line);
}
void redo(QPainter& p, const QColor& line, const QColor&) {
  p.translate(24, 0);
  p.scale(-1, 1);
  back_arrow(p, line);
}
void browse(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  for (const auto& [from, to] : {std::pair(QPointF(12, 3), QPointF(12, 9)),
                                 {QPointF(12, 15), QPointF(12, 21)},
                                 {QPointF(3, 12), QPointF(9, 12)},
                                 {QPointF(15, 12), QPointF(21, 12)}})
    p.drawLine(from, to);
  dot(p, accent, 12, 12, 1.8);
}
void pull(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawPath(curve({6, 3}, {6, 9}, {13, 7}, {13, 12}));
  p.drawPath(curve({13, 12}, {13, 17}, {6, 15}, {6, 21}));
  pen(p, accent);
  p.drawLine(QPointF(14, 12), QPointF(21, 12));
  p.drawPolyline(QPolygonF({QPointF(18, 9), QPointF(21, 12), QPointF(18, 15)}));
}
void pencil(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawPolygon(QPolygonF(
      {QPointF(9, 12), QPointF(18, 3), QPointF(21, 6), QPointF(12, 15), QPointF(8, 16), QPointF(9, 12)}));
  pen(p, accent);
  p.drawPath(curve({3, 20}, {7, 16}, {10, 23}, {20, 19}));
}
void brush(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawPath(curve({17, 3}, {17, 7}, {21, 8}, {21, 12}));
  p.drawPath(curve({21, 12}, {21, 16}, {17, 17}, {17, 21}));
  pen(p, accent);
  p.drawEllipse(QPointF(10, 12), 6.5, 6.5);
  dot(p, accent, 10, 12, 1.4);
}
void centerline(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line, Qt::SolidLine, 1.2);
  p.drawPath(curve({3, 14}, {8, 4}, {14, 18}, {17, 3}));
  p.drawPath(curve({7, 21}, {12, 10}, {18, 24}, {22, 7}));
  pen(p, accent, Qt::DotLine);
  p.drawPath(curve({5, 18}, {10, 7}, {16, 21}, {20, 5}));
  dot(p, accent, 5, 18);
  dot(p, accent, 12.7, 13.2);
  dot(p, accent, 20, 5);
}
void add_vessel(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawPath(curve({7, 3}, {7, 10}, {9, 14}, {9, 21}));
  pen(p, accent);
  p.drawPath(curve({7.6, 9}, {8, 12}, {14, 12}, {15, 18}));
  p.drawLine(QPointF(18, 4), QPointF(18, 10));
  p.drawLine(QPointF(15, 7), QPointF(21, 7));
}
void add_artery(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawArc(QRectF(-6, 2, 16, 20), -70 * 16, 140 * 16);
  pen(p, accent);
  p.drawPath(curve({10, 12}, {14, 12}, {15, 16}, {19, 21}));
  p.drawLine(QPointF(18, 4), QPointF(18, 10));
  p.drawLine(QPointF(15, 7), QPointF(21, 7));
}
void distance(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawLine(QPointF(6, 18), QPointF(18, 6));
  pen(p, accent);
  p.drawLine(QPointF(3, 15), QPointF(9, 21));
  p.drawLine(QPointF(15, 3), QPointF(21, 9));
}
void angle(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawPolyline(QPolygonF({QPointF(16, 4), QPointF(4, 19), QPointF(21, 19)}));
  pen(p, accent);
  p.drawArc(QRectF(-5, 10, 18, 18), 0, 51 * 16);
}
void area(QPainter& p, const QColor& line, const QColor& accent) {
  QPainterPath path(QPointF(5, 13));
  path.cubicTo(3, 3, 13, 3, 15, 5);
  path.cubicTo(24, 8, 21, 21, 13, 19);
  path.cubicTo(9, 18, 6, 20, 5, 13);
  QColor fill = accent;
  fill.setAlphaF(0.45 * accent.alphaF());
  p.fillPath(path, fill);
  pen(p, line);
  p.drawPath(path);
}
void diameter(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawEllipse(QPointF(12, 12), 7.5, 7.5);
  pen(p, accent);
  p.drawLine(QPointF(4, 20), QPointF(20, 4));
}
void stenosis(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawPath(curve({3, 5}, {10, 5}, {8, 10}, {12, 10}));
  p.drawPath(curve({12, 10}, {16, 10}, {14, 5}, {21, 5}));
  p.drawPath(curve({3, 19}, {10, 19}, {8, 14}, {12, 14}));
  p.drawPath(curve({12, 14}, {16, 14}, {14, 19}, {21, 19}));
  pen(p, accent);
  p.drawLine(QPointF(12, 3), QPointF(12, 7));
  p.drawLine(QPointF(12, 17), QPointF(12, 21));
}
void volume(QPainter& p, const QColor& line, const QColor& accent) {
  QColor fill = accent;
  fill.setAlphaF(0.45 * accent.alphaF());
  p.fillRect(QRectF(4, 8, 16, 8), fill);
  pen(p, line);
  p.drawLine(QPointF(5, 7), QPointF(19, 7));
  p.drawLine(QPointF(5, 17), QPointF(19, 17));
  p.drawEllipse(QPointF(19, 12), 2.2, 5);
  p.drawArc(QRectF(2.8, 7, 4.4, 10), 90 * 16, 180 * 16);
}
void ring(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, accent, Qt::DotLine);
  p.drawEllipse(QPointF(12, 12), 9, 9);
  pen(p, line);
  p.drawEllipse(QPointF(12, 12), 4.5, 4.5);
}

void arrow(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawLine(QPointF(20, 4), QPointF(6, 18));
  pen(p, accent);
  p.drawPolyline(QPolygonF({QPointF(6, 10), QPointF(5, 19), QPointF(14, 18)}));
}
void note(QPainter& p, const QColor& line, const QColor& accent) {
  pen(p, line);
  p.drawPolyline(QPolygonF(
      {QPointF(9, 15), QPointF(20, 15), QPointF(20, 4), QPointF(5, 4), QPointF(5, 19), QPointF(9, 15)}));
  pen(p, accent);
  p.drawLine(QPointF(8, 8), QPointF(17, 8));
  p.drawLine(QPointF(8, 11), QPointF(14, 11));
}

void whole_window(QPainter& p, const QColor& line, const QColor&) {
  pen(p, line, Qt::SolidLine, 2.2);
  p.drawLine(QPointF(6, 18), QPointF(18, 6));
  p.drawPolyline(QPolygonF({QPointF(10.5, 5), QPointF(19, 5), QPointF(19, 13.5)}));
  p.drawPolyline(QPolygonF({QPointF(5, 10.5), QPointF(5, 19), QPointF(13.5, 19)}));
}

const QMap<QString, Draw>& drawings() {
  static const QMap<QString, Draw> all{
      {"edit.undo", undo},
      {"edit.redo", redo},
      {"tool.browse", browse},
      {"tool.drag", pull},
      {"tool.draw", pencil},
      {"tool.brush", brush},
      {"tool.axis", centerline},
      {"tool.distance", distance},
      {"tool.angle", angle},
      {"tool.area", area},
      {"tool.diameter", diameter},
      {"tool.stenosis", stenosis},
      {"tool.volume", volume},
      {"tool.ring_hu", ring},
      {"tool.arrow", arrow},
      {"tool.note", note},
      {"tool.add_vessel", add_vessel},
      {"tool.add_artery", add_artery},
      {"panel.alone", whole_window},
  };
  return all;
}

/// Draws when it is asked for, so that another theme or a sharper screen needs no other icon.
class LineIcon final : public QIconEngine {
 public:
  explicit LineIcon(Draw draw) : draw_(draw) {}
  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    const QPalette palette = QApplication::palette();
    const bool disabled = mode == QIcon::Disabled;
    const QColor line = palette.color(disabled ? QPalette::Disabled : QPalette::Active, QPalette::ButtonText);
    const QColor accent = disabled ? line : palette.color(QPalette::Link).lighter(115);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->translate(rect.topLeft());
    painter->scale(rect.width() / 24.0, rect.height() / 24.0);
    draw_(*painter, line, accent);
    painter->restore();
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap made(size);
    made.fill(Qt::transparent);
    QPainter painter(&made);
    paint(&painter, QRect(QPoint(0, 0), size), mode, state);
    return made;
  }
  QIconEngine* clone() const override { return new LineIcon(draw_); }

 private:
  Draw draw_;
};

}  // namespace

QIcon command_icon(const QString& id) {
  const Draw draw = drawings().value(id, nullptr);
  return draw ? QIcon(new LineIcon(draw)) : QIcon();
}

}  // namespace ostia::workstation
