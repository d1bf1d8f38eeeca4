#include "commands/shortcuts.h"

#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr const char* no_keys = "none";
constexpr const char* scheme_keys = "default";
const std::string prefix = "shortcut.";

bool collide(const QKeySequence& a, const QKeySequence& b) {
  return a.matches(b) != QKeySequence::NoMatch || b.matches(a) != QKeySequence::NoMatch;
}

}  // namespace

const std::vector<Shortcut>& shortcuts() {
  static const std::vector<Shortcut> all{
      {"file.open", "Ctrl+O", "Ctrl+O"},
      {"file.open_folder", "Ctrl+Shift+O", "Ctrl+Shift+O"},
      {"file.sample", "", ""},
      {"file.save_as", "Ctrl+Shift+S", "Ctrl+Shift+S"},
      {"file.close", "Ctrl+W", "Ctrl+W"},
      {"file.report", "Ctrl+R", "Ctrl+R"},
      {"file.pin", "Ctrl+P", "Ctrl+P"},
      {"file.export_surface", "Ctrl+E", "Ctrl+E"},
      {"file.export_mesh", "Ctrl+M", "Ctrl+M"},
      {"file.flow_case", "Ctrl+Shift+M", "Ctrl+Shift+M"},
      {"file.open_mesh", "Ctrl+Alt+M", "Ctrl+Alt+M"},
      {"file.flow_results", "Ctrl+Shift+R", "Ctrl+Shift+R"},
      {"file.motion", "Ctrl+Shift+B", "Ctrl+Shift+B"},
      {"file.export_centerlines", "Ctrl+Shift+E", "Ctrl+Shift+E"},
      {"file.quit", "Ctrl+Q", "Ctrl+Q"},
      {"edit.undo", "Ctrl+Z", "Ctrl+Z"},
      {"edit.redo", "Ctrl+Shift+Z; Ctrl+Y", "Ctrl+Shift+Z; Ctrl+Y"},
      {"edit.preferences", "Ctrl+,", "Ctrl+,"},
      {"vessel.find", "Ctrl+Shift+F", "Ctrl+Shift+F"},
      {"vessel.split", "Ctrl+Shift+X", "Ctrl+Shift+X"},
      {"vessel.merge", "Ctrl+Shift+J", "Ctrl+Shift+J"},
      {"vessel.cut", "Ctrl+Shift+K", "Ctrl+Shift+K"},
      {"vessel.connect", "Ctrl+Shift+C", "Ctrl+Shift+C"},
      {"tool.browse", "Esc", "Q; Esc"},
      {"tool.drag", "E", "W"},
      {"tool.draw", "W", "D"},
      {"tool.brush", "B", "B"},
      {"tool.axis", "C", "C"},
      {"tool.add_vessel", "V", "A"},
      {"tool.distance", "D", "1"},
      {"tool.angle", "A", "2"},
      {"tool.area", "R", "3"},
      {"tool.diameter", "F", "4"},
      {"tool.stenosis", "S", "5"},
      {"tool.volume", "U", "6"},
      {"tool.ring_hu", "H", "7"},
      {"tool.smaller", ",", ","},
      {"tool.larger", ".", "."},
      {"view.turn_left", "[; Alt+Left", "[; Alt+Left"},
      {"view.turn_right", "]; Alt+Right", "]; Alt+Right"},
      {"view.proximal", "Ctrl+Up", "K; Ctrl+Up"},
      {"view.distal", "Ctrl+Down", "J; Ctrl+Down"},
      {"view.root", "Ctrl+Home", "Ctrl+Home"},
      {"view.end", "Ctrl+End", "Ctrl+End"},
      {"view.next_lesion", "L", "L"},
      {"view.previous_lesion", "Shift+L", "Shift+L"},
      {"view.next_vessel", "Ctrl+Right", "N; Ctrl+Right"},
      {"view.previous_vessel", "Ctrl+Left", "P; Ctrl+Left"},
      {"view.stretched", "T", "T"},
      {"view.mip", "M", "M"},
      {"view.mean", "Shift+M", "Shift+M"},
      {"view.thinner", "Ctrl+Alt+Down", "Ctrl+Alt+Down"},
      {"view.thicker", "Ctrl+Alt+Up", "Ctrl+Alt+Up"},
      {"view.contours", "Space", "Space"},
      {"view.outer_wall", "", ""},
      {"view.plaque", "Shift+P", "Shift+P"},
      {"view.play", "Ctrl+Space", "Ctrl+Space"},
      {"view.own_phase", "Ctrl+Shift+Space", "Ctrl+Shift+Space"},
      {"view.fit", "Ctrl+0", "F"},
      {"view.theme", "", ""},
      {"tree.select", "Ctrl+Alt+1", "Ctrl+Alt+1"},
      {"tree.straight", "Ctrl+Alt+2", "Ctrl+Alt+2"},
      {"tree.along", "Ctrl+Alt+3", "Ctrl+Alt+3"},
      {"tree.angle", "Ctrl+Alt+4", "Ctrl+Alt+4"},
      {"tree.region", "Ctrl+Alt+5", "Ctrl+Alt+5"},
      {"tree.grid", "Ctrl+Alt+6", "Ctrl+Alt+6"},
      {"tree.subtree", "Ctrl+Alt+7", "Ctrl+Alt+7"},
      {"tree.fit", "Ctrl+Alt+0", "Ctrl+Alt+0"},
      {"tree.copy", "Ctrl+Alt+C", "Ctrl+Alt+C"},
      {"tree.export", "Ctrl+Alt+E", "Ctrl+Alt+E"},
      {"tree.clear", "Ctrl+Alt+X", "Ctrl+Alt+X"},
      {"tree.close", "Ctrl+Alt+W", "Ctrl+Alt+W"},
      {"window.1", "F5", "F5"},
      {"window.2", "F6", "F6"},
      {"window.3", "F7", "F7"},
      {"window.4", "F8", "F8"},
      {"panel.next", "Ctrl+Tab", "Ctrl+Tab"},
      {"panel.previous", "Ctrl+Shift+Tab", "Ctrl+Shift+Tab"},
      {"panel.alone", "F11", "F11"},
      {"panel.vessels", "Alt+1", "Alt+1"},
      {"panel.cpr1", "Alt+2", "Alt+2"},
      {"panel.cpr2", "Alt+3", "Alt+3"},
      {"panel.section", "Alt+4", "Alt+4"},
      {"panel.slice", "Alt+5", "Alt+5"},
      {"panel.tree", "Alt+6", "Alt+6"},
      {"panel.profile", "Alt+7", "Alt+7"},
      {"panel.measurements", "Alt+8", "Alt+8"},
      {"panel.steps", "Alt+9", "Alt+9"},
      {"mouse.left", "Alt+Shift+Left", "Alt+Shift+Left"},
      {"mouse.right", "Alt+Shift+Right", "Alt+Shift+Right"},
      {"mouse.up", "Alt+Shift+Up", "Alt+Shift+Up"},
      {"mouse.down", "Alt+Shift+Down", "Alt+Shift+Down"},
      {"mouse.press", "Ins", "Ins"},
      {"help.manual", "Shift+F1", "Shift+F1"},
      {"help.shortcuts", "F1", "F1"},
      {"help.tour", "", ""},
      {"help.about", "", ""},
  };
  return all;
}

QList<QKeySequence> keys_of(const QString& id, ShortcutScheme scheme) {
  for (const Shortcut& one : shortcuts()) {
    const QString& keys = scheme == ShortcutScheme::pacs ? one.pacs : one.research;
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

ShortcutKeys ShortcutKeys::from(const std::map<std::string, std::string>& settings) {
  const auto scheme = settings.find("shortcuts");
  ShortcutKeys made(scheme != settings.end() && scheme->second == "research" ? ShortcutScheme::research
                                                                             : ShortcutScheme::pacs);
  // Keys that were taken away first: another command may have got them.
  for (const bool taken_away : {true, false})
    for (const auto& [name, value] : settings) {
      if (name.rfind(prefix, 0) != 0 || value == scheme_keys || (value == no_keys) != taken_away) continue;
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
  for (const auto& [id, keys] : before.changed_) made[prefix + id.toStdString()] = scheme_keys;
  for (const auto& [id, keys] : changed_)
    made[prefix + id.toStdString()] =
        keys.isEmpty() ? no_keys : keys.toString(QKeySequence::PortableText).toStdString();
  return made;
}

QList<QKeySequence> ShortcutKeys::keys(const QString& id) const {
  const auto found = changed_.find(id);
  if (found == changed_.end()) return keys_of(id, scheme_);
  return found->second.isEmpty() ? QList<QKeySequence>() : QList<QKeySequence>{found->second};
}

std::optional<QString> ShortcutKeys::taken_by(const QKeySequence& keys, const QString& but) const {
  if (keys.isEmpty()) return std::nullopt;
  const auto has = [&](const QString& id) {
    const QList<QKeySequence> own = this->keys(id);
    return id != but &&
           std::any_of(own.begin(), own.end(), [&](const QKeySequence& one) { return collide(one, keys); });
  };
  for (const Shortcut& one : shortcuts())
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
  for (const QKeySequence& keys : keys_of(id, scheme_))
    if (taken_by(keys, id)) return false;
  changed_.erase(id);
  return true;
}

}  // namespace ostia::workstation
