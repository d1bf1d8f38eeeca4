#include "shell/theme.h"

#include <QApplication>
#include <QIcon>
#include <QPainter>
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

QColor role_color(view::Role role, Ground ground) {
  using view::Role;
  const bool bright = ground == Ground::image || theme_now == Theme::dark;
  switch (role) {
    case Role::lumen:
      return QColor(255, 176, 46);
    case Role::outer_wall:
      return bright ? QColor(240, 228, 66) : QColor(130, 115, 0);
    case Role::truth:
      return QColor(102, 219, 255);
    case Role::axis:
      return QColor(120, 200, 120);
    case Role::other_axis:
      return QColor(150, 150, 160);
    case Role::cursor:
      return bright ? QColor(90, 190, 255) : QColor(20, 110, 190);
    case Role::reference:
      return bright ? QColor(140, 220, 160) : QColor(30, 130, 60);
    case Role::stenosis:
      return QColor(232, 84, 72);
    case Role::measurement:
      return bright ? QColor(255, 240, 120) : QColor(130, 105, 0);
    case Role::selected:
      return bright ? QColor(255, 110, 220) : QColor(185, 20, 140);
    case Role::stroke:
      return QColor(120, 255, 220);
    case Role::dismissed:
      return QColor(255, 90, 90);
    case Role::handle:
      return QColor(255, 255, 255);
    case Role::information:
      return bright ? QColor(214, 218, 224) : QColor(40, 44, 50);
    case Role::warning:
      return QColor(255, 150, 60);
    case Role::diameter:
      return bright ? QColor(255, 176, 46) : QColor(180, 95, 0);
    case Role::area:
      return bright ? QColor(120, 170, 255) : QColor(40, 80, 190);
    case Role::grid:
      return bright ? QColor(110, 115, 125) : QColor(170, 174, 182);
    // Told apart by the colour-blind, too, also over grey: warm is soft, blue is hard.
    case Role::low_attenuation:
      return QColor(213, 94, 0);
    case Role::fibrofatty:
      return QColor(240, 228, 66);
    case Role::fibrous:
      return QColor(40, 90, 255);
    case Role::calcified:
      return QColor(86, 180, 233);
  }
  return Qt::white;
}

double role_width(view::Role role) {
  using view::Role;
  switch (role) {
    case Role::lumen:
      return 1.6;
    case Role::diameter:
      return 1.8;
    case Role::stroke:
    case Role::selected:
    case Role::measurement:
      return 1.6;
    case Role::grid:
    case Role::outer_wall:
      return 0.8;
    default:
      return 1.1;
  }
}

}  // namespace ostia::workstation
