#include "qa/walk.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <QKeySequence>
#include <array>
#include <utility>

namespace ostia::workstation {
namespace {

using Kind = WalkStep::Kind;

struct Form {
  Kind kind;
  const char* word;
  const char* form;
};
constexpr std::array forms{
    Form{Kind::command, "command", "command ID"},
    Form{Kind::key, "key", "key WIDGET KEY"},
    Form{Kind::type, "type", "type WIDGET \"TEXT\""},
    Form{Kind::click, "click", "click WIDGET PLACE [HOLD]"},
    Form{Kind::double_click, "double", "double WIDGET PLACE [HOLD]"},
    Form{Kind::drag, "drag", "drag WIDGET PLACE PLACE ... [HOLD]"},
    Form{Kind::wheel, "wheel", "wheel WIDGET PLACE NOTCHES [HOLD]"},
    Form{Kind::go, "go", "go X,Y,Z"},
    Form{Kind::file, "file", "file NAME"},
    Form{Kind::look, "look", "look NAME"},
    Form{Kind::expect, "expect", "expect WHAT >=|<=|= NUMBER"},
};
constexpr std::array<std::pair<const char*, Qt::MouseButton>, 3> buttons{
    {{"left", Qt::LeftButton}, {"middle", Qt::MiddleButton}, {"right", Qt::RightButton}}};
constexpr std::array<std::pair<const char*, Qt::KeyboardModifier>, 3> modifiers{
    {{"shift", Qt::ShiftModifier}, {"ctrl", Qt::ControlModifier}, {"alt", Qt::AltModifier}}};

struct NotAStep {};

double number_of(const QString& text) {
  bool good = false;
  const double number = text.toDouble(&good);
  if (!good || !qIsFinite(number)) throw NotAStep{};
  return number;
}

QPointF pair_of(const QString& text) {
  const QStringList both = text.split(',');
  if (both.size() != 2) throw NotAStep{};
  return {number_of(both[0]), number_of(both[1])};
}

WalkPlace place_of(const QString& text) {
  WalkPlace place;
  const QStringList parts = text.split('+');
  if (parts.size() > 2) throw NotAStep{};
  if (parts.size() == 2) place.beside = pair_of(parts[1]);
  if (parts[0] == "cursor")
    place.of = WalkPlace::Of::cursor;
  else if (parts[0] == "wall")
    place.of = WalkPlace::Of::wall;
  else
    place.part = pair_of(parts[0]);
  return place;
}

QString text_of(const WalkPlace& place) {
  const auto pair = [](const QPointF& at) {
    return QStringLiteral("%1,%2").arg(at.x(), 0, 'g', 6).arg(at.y(), 0, 'g', 6);
  };
  const QString of = place.of == WalkPlace::Of::cursor ? QStringLiteral("cursor")
                     : place.of == WalkPlace::Of::wall ? QStringLiteral("wall")
                                                       : pair(place.part);
  return place.beside.isNull() ? of : of + '+' + pair(place.beside);
}

/// Whether `text` says what is held while the mouse moves; then it is taken into the step.
bool take_hold(const QString& text, WalkStep& step) {
  WalkStep held = step;
  for (const QString& word : text.split('+')) {
    bool known = false;
    for (const auto& [name, button] : buttons)
      if (word == name) held.button = button, known = true;
    for (const auto& [name, key] : modifiers)
      if (word == name) held.held |= key, known = true;
    if (!known) return false;
  }
  step = std::move(held);
  return true;
}

QString hold_of(const WalkStep& step) {
  QStringList words;
  for (const auto& [name, button] : buttons)
    if (step.button == button && button != Qt::LeftButton) words << name;
  for (const auto& [name, key] : modifiers)
    if (step.held & key) words << name;
  return words.isEmpty() ? QString() : ' ' + words.join('+');
}

bool is_file_name(const QString& name) {
  return !name.isEmpty() && !name.startsWith('.') && !name.contains('/');
}

void take_mouse(QStringList words, WalkStep& step) {
  if (words.size() > 1 && take_hold(words.back(), step)) words.removeLast();
  if (step.kind == Kind::wheel) {
    if (words.size() != 2) throw NotAStep{};
    step.number = number_of(words.takeLast());
  }
  for (const QString& word : std::as_const(words)) step.places << place_of(word);
  if (step.kind == Kind::drag ? step.places.size() < 2 : step.places.size() != 1) throw NotAStep{};
}

/// What stands behind the first word.
void take_rest(const QString& rest, WalkStep& step) {
  QStringList words = rest.split(' ', Qt::SkipEmptyParts);
  if (words.isEmpty()) throw NotAStep{};
  step.what = words.takeFirst();
  switch (step.kind) {
    case Kind::command:
      if (!words.isEmpty()) throw NotAStep{};
      return;
    case Kind::file:
    case Kind::look:
      if (!words.isEmpty() || !is_file_name(step.what)) throw NotAStep{};
      return;
    case Kind::key:
      if (words.size() != 1 || QKeySequence(words[0])[0] == Qt::Key_unknown) throw NotAStep{};
      step.text = words[0];
      return;
    case Kind::type:
      step.text = rest.mid(rest.indexOf('"') + 1);
      if (!rest.contains('"') || step.text.size() < 2 || !step.text.endsWith('"')) throw NotAStep{};
      step.text.chop(1);
      return;
    case Kind::go: {
      const QStringList numbers = step.what.split(',');
      if (!words.isEmpty() || numbers.size() != 3) throw NotAStep{};
      for (int i = 0; i < 3; ++i) step.world_mm[static_cast<std::size_t>(i)] = number_of(numbers[i]);
      return;
    }
    case Kind::expect:
      if (words.size() != 2 || !QStringList{"<=", ">=", "="}.contains(words[0])) throw NotAStep{};
      step.text = words[0];
      step.number = number_of(words[1]);
      return;
    case Kind::click:
    case Kind::double_click:
    case Kind::drag:
    case Kind::wheel:
      return take_mouse(words, step);
  }
}

WalkStep step_of(const QString& line, const QString& where, int number) {
  const QString word = line.section(' ', 0, 0);
  for (const Form& form : forms) {
    if (word != form.word) continue;
    WalkStep step;
    step.kind = form.kind;
    step.line = number;
    try {
      take_rest(line.mid(word.size()), step);
    } catch (const NotAStep&) {
      throw InvalidInput(where.toStdString() + ": expected \"" + form.form + "\"");
    }
    return step;
  }
  QStringList known;
  for (const Form& form : forms) known << form.word;
  throw InvalidInput(where.toStdString() + ": a step begins with one of " + known.join(", ").toStdString());
}

}  // namespace

std::vector<WalkStep> parse_walk(const QString& text, const QString& name) {
  std::vector<WalkStep> steps;
  int number = 0;
  for (const QString& line : text.split('\n')) {
    ++number;
    const QString said = line.trimmed();
    if (said.isEmpty() || said.startsWith('#')) continue;
    steps.push_back(step_of(said, QStringLiteral("%1, line %2").arg(name).arg(number), number));
  }
  if (steps.empty()) throw InvalidInput(name.toStdString() + " is a walk without a step");
  return steps;
}

std::vector<WalkStep> read_walk(const std::filesystem::path& file) {
  constexpr std::uint64_t most_bytes = 16U << 20U;
  return parse_walk(QString::fromStdString(core::read_file(file, most_bytes)),
                    QString::fromStdString(file.filename().string()));
}

QString walk_line(const WalkStep& step) {
  QString line;
  for (const Form& form : forms)
    if (form.kind == step.kind) line = form.word;
  line += ' ' + step.what;
  for (const WalkPlace& place : step.places) line += ' ' + text_of(place);
  if (step.kind == Kind::type)
    line += " \"" + step.text + '"';
  else if (!step.text.isEmpty())
    line += ' ' + step.text;
  if (step.kind == Kind::wheel || step.kind == Kind::expect) line += ' ' + QString::number(step.number);
  return step.places.isEmpty() ? line : line + hold_of(step);
}

}  // namespace ostia::workstation
