#include "commands/shortcuts.h"

#include <algorithm>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr const char* no_keys = "none";
constexpr const char* default_keys = "default";
const std::string prefix = "shortcut.";

bool collide(const QKeySequence& a, const QKeySequence& b) {
  return a.matches(b) != QKeySequence::NoMatch || b.matches(a) != QKeySequence::NoMatch;
}

}  // namespace

ShortcutKeys::ShortcutKeys(Shortcuts defaults, ShortcutScheme scheme)
    : defaults_(std::move(defaults)), scheme_(scheme) {}

QList<QKeySequence> ShortcutKeys::scheme_keys(const QString& id) const {
  for (const Shortcut& one : *defaults_) {
    const QString& keys = scheme_ == ShortcutScheme::pacs ? one.pacs : one.research;
    if (one.id == id && !keys.isEmpty())
      return QKeySequence::listFromString(keys, QKeySequence::PortableText);
  }
  return {};
}

bool is_kept_by_views(const QKeySequence& keys) {
  static const QList<QKeySequence> kept = QKeySequence::listFromString(
      "Up; Down; Left; Right; PgUp; PgDown; Home; End; +; =; -; 0; Del; "
      "Backspace; Tab; Shift+Tab; Return; Enter; F2; F10; Alt+F4");
  return std::any_of(kept.begin(), kept.end(), [&](const QKeySequence& one) { return collide(one, keys); });
}

bool is_kept_by_window_managers(const QKeySequence& keys) {
  static const QList<QKeySequence> kept = QKeySequence::listFromString(
      "Alt+Tab; Alt+Shift+Tab; Alt+Esc; Alt+Space; Ctrl+Esc; Print; Alt+Print; Ctrl+Alt+Del; "
      "Ctrl+Alt+Backspace; Ctrl+Alt+Tab; Ctrl+Alt+Esc; Ctrl+Alt+T; Ctrl+Alt+L; Ctrl+Alt+D");
  const auto taken = [](int key) {
    const int plain = key & ~static_cast<int>(Qt::KeyboardModifierMask);
    const bool ctrl = key & Qt::CTRL, alt = key & Qt::ALT;
    const bool function = plain >= Qt::Key_F1 && plain <= Qt::Key_F12;
    const bool arrow = plain >= Qt::Key_Left && plain <= Qt::Key_Down;
    return (key & Qt::META) || (alt && function) || (ctrl && function) || (ctrl && alt && arrow);
  };
  for (int i = 0; i < keys.count(); ++i)
    if (taken(keys[i])) return true;
  return std::any_of(kept.begin(), kept.end(), [&](const QKeySequence& one) { return collide(one, keys); });
}

ShortcutKeys ShortcutKeys::from(const std::map<std::string, std::string>& settings, Shortcuts defaults) {
  const auto scheme = settings.find("shortcuts");
  const bool research = scheme != settings.end() && scheme->second == "research";
  ShortcutKeys made(std::move(defaults), research ? ShortcutScheme::research : ShortcutScheme::pacs);
  // Keys that were taken away first: another command may have got them.
  for (const bool taken_away : {true, false})
    for (const auto& [name, value] : settings) {
      if (name.rfind(prefix, 0) != 0 || value == default_keys || (value == no_keys) != taken_away) continue;
      const QString id = QString::fromStdString(name.substr(prefix.size()));
      const QKeySequence keys(taken_away ? QString() : QString::fromStdString(value),
                              QKeySequence::PortableText);
      if (taken_away || !keys.isEmpty()) made.changed_[id] = keys;
    }
  // What was changed by hand so that two commands would have one key goes.
  for (auto at = made.changed_.begin(); at != made.changed_.end();) {
    const bool wrong =
        !at->second.isEmpty() && (is_kept_by_views(at->second) || made.taken_by(at->second, at->first));
    at = wrong ? made.changed_.erase(at) : std::next(at);
  }
  return made;
}

std::map<std::string, std::string> ShortcutKeys::settings(const ShortcutKeys& before) const {
  std::map<std::string, std::string> made;
  made["shortcuts"] = scheme_ == ShortcutScheme::pacs ? "pacs" : "research";
  for (const auto& [id, keys] : before.changed_) made[prefix + id.toStdString()] = default_keys;
  for (const auto& [id, keys] : changed_)
    made[prefix + id.toStdString()] =
        keys.isEmpty() ? no_keys : keys.toString(QKeySequence::PortableText).toStdString();
  return made;
}

QList<QKeySequence> ShortcutKeys::keys(const QString& id) const {
  const auto found = changed_.find(id);
  if (found == changed_.end()) return scheme_keys(id);
  return found->second.isEmpty() ? QList<QKeySequence>() : QList<QKeySequence>{found->second};
}

std::optional<QString> ShortcutKeys::taken_by(const QKeySequence& keys, const QString& but) const {
  if (keys.isEmpty()) return std::nullopt;
  const auto has = [&](const QString& id) {
    const QList<QKeySequence> own = this->keys(id);
    return id != but &&
           std::any_of(own.begin(), own.end(), [&](const QKeySequence& one) { return collide(one, keys); });
  };
  for (const Shortcut& one : *defaults_)
    if (has(one.id)) return one.id;
  for (const auto& [id, changed] : changed_)
    if (has(id)) return id;
  return std::nullopt;
}

bool ShortcutKeys::change(const QString& id, const QKeySequence& keys) {
  if (!keys.isEmpty() && (is_kept_by_views(keys) || taken_by(keys, id))) return false;
  changed_[id] = keys;
  return true;
}

bool ShortcutKeys::reset(const QString& id) {
  for (const QKeySequence& keys : scheme_keys(id))
    if (taken_by(keys, id)) return false;
  changed_.erase(id);
  return true;
}

}  // namespace ostia::workstation
