#include "views/corner_texts.h"

#include "shell/quantities.h"

#include <QCoreApplication>

namespace ostia::workstation {
namespace {

constexpr double corner_edge = 6.0;   // units from the rim, as the view's own texts have it
constexpr double least_view = 110.0;  // units; smaller ones are strips beside a larger view

bool too_small(const QSizeF& view_px, double density) {
  return view_px.width() < least_view * density || view_px.height() < least_view * density;
}

}  // namespace

QStringList broken(const QString& text, double most_px, const view::TextMeasure& measure) {
  const auto fits = [&](const QString& one) { return measure.width(one.toStdString(), 1.0) <= most_px; };
  QStringList lines;
  for (const QString& word : text.split(' ', Qt::SkipEmptyParts)) {
    if (!lines.isEmpty() && fits(lines.back() + ' ' + word)) {
      lines.back() += ' ' + word;
      continue;
    }
    lines << QString();
    if (fits(word)) {
      lines.back() = word;
      continue;
    }
    for (const QChar letter : word) {
      if (!lines.back().isEmpty() && !letter.isLowSurrogate() && !fits(lines.back() + letter))
        lines << QString();
      lines.back() += letter;
    }
  }
  return lines;
}

std::vector<view::OverlayText> identity_texts(const QSizeF& view_px, const QStringList& parts, double density,
                                              const view::TextMeasure& measure) {
  std::vector<view::OverlayText> texts;
  if (parts.isEmpty() || too_small(view_px, density)) return texts;
  QStringList lines;
  for (const QString& part : parts)
    lines << broken(part, view_px.width() - 2.0 * corner_edge * density, measure);
  double y = view_px.height() - corner_edge * density;
  for (auto line = lines.crbegin(); line != lines.crend(); ++line, y -= measure.line)
    texts.push_back({{corner_edge * density, y},
                     line->toStdString(),
                     view::Role::information,
                     view::Anchor::bottom_left});
  return texts;
}

std::vector<view::OverlayText> grey_window_texts(const QSizeF& view_px, const session::GreyWindow& window,
                                                 double density) {
  if (too_small(view_px, density)) return {};
  const QString text = QCoreApplication::translate("ostia::workstation::PictureWidget", "W %1  L %2")
                           .arg(quantity::hu(window.width_hu), quantity::hu(window.level_hu));
  return {{{view_px.width() - corner_edge * density, corner_edge * density},
           text.toStdString(),
           view::Role::information,
           view::Anchor::top_right}};
}

}  // namespace ostia::workstation
