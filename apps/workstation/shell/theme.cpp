#include "shell/theme.h"

#include <QApplication>
#include <QColor>
#include <QIcon>
#include <QPainter>
#include <QPalette>
#include <QProxyStyle>
#include <QStyleOption>

namespace ostia::workstation {
namespace {

Theme theme_now = Theme::dark;

/// Dialogs' buttons without the style's pictures, which are made for light themes, and boxes to tick that
/// are seen on dark ones.
class PlainButtons final : public QProxyStyle {
 public:
  PlainButtons() : QProxyStyle(QStringLiteral("Fusion")) {}
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    if (element != PE_IndicatorCheckBox && element != PE_IndicatorItemViewItemCheck) return;
    QColor edge = option->palette.color(QPalette::Text);
    edge.setAlphaF(option->state & State_Enabled ? 0.6 : 0.3);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(QPen(edge, 1.0));
    painter->setBrush(Qt::NoBrush);
    painter->drawRoundedRect(QRectF(option->rect).adjusted(0.5, 0.5, -0.5, -0.5), 2.0, 2.0);
    painter->restore();
  }
  /// The arrow of a tool bar that hides commands: the style's own is black.
  QIcon standardIcon(StandardPixmap which, const QStyleOption* option, const QWidget* widget) const override {
    if (which != SP_ToolBarHorizontalExtensionButton) return QProxyStyle::standardIcon(which, option, widget);
    constexpr int side = 32;
    QPixmap arrows(side, side);
    arrows.fill(Qt::transparent);
    QPainter painter(&arrows);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(QColor(128, 134, 142), 3.5));  // seen in both themes: a bar keeps it
    for (const double x : {8.0, 17.0})
      painter.drawPolyline(QPolygonF({{x, 7.0}, {x + 7.0, 16.0}, {x, 25.0}}));
    return QIcon(arrows);
  }
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* data) const override {
    if (hint == SH_DialogButtonBox_ButtonsHaveIcons) return 0;
    return QProxyStyle::styleHint(hint, option, widget, data);
  }
};

QPalette palette_of(Theme theme) {
  const bool dark = theme == Theme::dark;
  const QColor window = dark ? QColor(32, 34, 38) : QColor(240, 241, 243);
  const QColor base = dark ? QColor(23, 24, 27) : QColor(255, 255, 255);
  const QColor text = dark ? QColor(222, 225, 230) : QColor(25, 28, 33);
  const QColor faint = dark ? QColor(122, 127, 135) : QColor(125, 130, 138);
  const QColor accent = dark ? QColor(64, 132, 214) : QColor(28, 98, 185);
  QPalette p;
  p.setColor(QPalette::Window, window);
  p.setColor(QPalette::WindowText, text);
  p.setColor(QPalette::Base, base);
  p.setColor(QPalette::AlternateBase, dark ? QColor(28, 30, 34) : QColor(247, 248, 250));
  p.setColor(QPalette::Text, text);
  p.setColor(QPalette::Button, dark ? QColor(44, 47, 53) : QColor(228, 230, 234));
  p.setColor(QPalette::ButtonText, text);
  // Of bevels and of lines between parts.
  p.setColor(QPalette::Light, dark ? QColor(58, 62, 69) : QColor(255, 255, 255));
  p.setColor(QPalette::Midlight, dark ? QColor(50, 54, 60) : QColor(240, 241, 244));
  p.setColor(QPalette::Mid, dark ? QColor(38, 41, 46) : QColor(178, 182, 189));
  p.setColor(QPalette::Dark, dark ? QColor(20, 21, 24) : QColor(150, 155, 163));
  p.setColor(QPalette::Shadow, dark ? QColor(8, 9, 10) : QColor(105, 110, 118));
  p.setColor(QPalette::BrightText, Qt::white);
  p.setColor(QPalette::ToolTipBase, dark ? QColor(52, 56, 63) : QColor(255, 255, 235));
  p.setColor(QPalette::ToolTipText, text);
  p.setColor(QPalette::Highlight, accent);
  p.setColor(QPalette::HighlightedText, Qt::white);
  p.setColor(QPalette::Link, accent);
  p.setColor(QPalette::PlaceholderText, faint);
  for (const QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    p.setColor(QPalette::Disabled, role, faint);
  return p;
}

}  // namespace

void apply_theme(Theme theme) {
  theme_now = theme;
  QApplication::setStyle(new PlainButtons);
  QApplication::setPalette(palette_of(theme));
}

Theme current_theme() {
  return theme_now;
}

}  // namespace ostia::workstation
