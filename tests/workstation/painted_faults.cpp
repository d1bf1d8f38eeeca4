#include "painted_faults.h"

#include "views/picture_widget.h"
#include "views/scene_widget.h"

namespace ostia::workstation::testing {
namespace {

struct PaintedText {
  QString text;
  view::LabelRect rect;
  bool shown = true, whole = true;
};

struct PaintedView {
  QString name;
  view::Vec2 size;  // px
  std::vector<PaintedText> texts;
};

std::vector<PaintedText> of(const std::vector<view::PlacedText>& placed) {
  std::vector<PaintedText> texts;
  for (const view::PlacedText& one : placed)
    if (!one.outside && !one.text.empty())
      texts.push_back({QString::fromStdString(one.text), one.rect, one.shown, one.whole});
  return texts;
}

view::Vec2 size_of(const QWidget& widget) {
  return view::Vec2(widget.width(), widget.height()) * widget.devicePixelRatioF();
}

std::vector<PaintedView> views_of(const QWidget& window) {
  std::vector<PaintedView> all;
  const auto seen = [&](const QWidget& widget) { return widget.isVisible() && widget.window() == &window; };
  for (const auto* one : window.findChildren<const PictureWidget*>())
    if (seen(*one)) all.push_back({one->objectName(), size_of(*one), of(one->painted_texts())});
  for (const auto* one : window.findChildren<const ProfileWidget*>())
    if (seen(*one)) all.push_back({one->objectName(), size_of(*one), of(one->painted_texts())});
  for (auto* one : window.findChildren<SceneWidget*>()) {
    if (!seen(*one)) continue;
    const QSize picture = one->picture_size();
    PaintedView made{one->objectName(), view::Vec2(picture.width(), picture.height()), {}};
    for (const view::SceneText& text : one->scene().texts())
      made.texts.push_back({QString::fromStdString(text.text), text.rect});
    all.push_back(std::move(made));
  }
  return all;
}

QString in_words(const view::LabelRect& rect) {
  return QStringLiteral("%1, %2, %3 x %4")
      .arg(rect.low.x(), 0, 'f', 0)
      .arg(rect.low.y(), 0, 'f', 0)
      .arg(rect.size.x(), 0, 'f', 0)
      .arg(rect.size.y(), 0, 'f', 0);
}

void look(const PaintedView& view, QStringList& faults) {
  const QString at = QStringLiteral("%1 (%2 x %3): ").arg(view.name).arg(view.size.x()).arg(view.size.y());
  for (std::size_t i = 0; i < view.texts.size(); ++i) {
    const PaintedText& one = view.texts[i];
    if (!one.whole) faults << at + QStringLiteral("\"%1\" is shortened").arg(one.text);
    if (!one.shown) {
      faults << at + QStringLiteral("\"%1\" has no room").arg(one.text);
      continue;
    }
    if ((one.rect.low.array() < -0.5).any() ||
        ((one.rect.low + one.rect.size).array() > view.size.array() + 0.5).any())
      faults << at + QStringLiteral("\"%1\" is cut off (%2)").arg(one.text, in_words(one.rect));
    for (std::size_t j = 0; j < i; ++j)
      if (view.texts[j].shown && one.rect.meets(view.texts[j].rect))
        faults << at + QStringLiteral("\"%1\" (%2) lies over \"%3\" (%4)")
                           .arg(one.text, in_words(one.rect), view.texts[j].text,
                                in_words(view.texts[j].rect));
  }
}

}  // namespace

QStringList painted_faults(const QWidget& window) {
  QStringList faults;
  for (const PaintedView& view : views_of(window)) look(view, faults);
  return faults;
}

int painted_count(const QWidget& window) {
  int count = 0;
  for (const PaintedView& view : views_of(window)) count += static_cast<int>(view.texts.size());
  return count;
}

}  // namespace ostia::workstation::testing
