#pragma once
/// \file Which keys run which command.

#include <QKeySequence>
#include <QList>
#include <QString>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::workstation {

enum class ShortcutScheme { pacs, research };

/// The keys that a command has in each scheme.
struct Shortcut {
  QString id;    ///< "edit.undo"
  QString pacs;  ///< keys as a reading station has them; several with "; " between
  QString research;
};
using Shortcuts = std::shared_ptr<const std::vector<Shortcut>>;

/// What views and lists do with a key themselves ("Up", "Delete"): no command may have it.
bool is_kept_by_views(const QKeySequence& keys);

/// What the window managers of the usual desktops take before a program sees it, or may take: Alt and a
/// function key, Ctrl+Alt and an arrow, the Super key. No command has one of these by itself.
bool is_kept_by_window_managers(const QKeySequence& keys);

/// The keys as a person has them: a scheme, and what differs from it.
class ShortcutKeys {
 public:
  ShortcutKeys() = default;  ///< of no commands
  /// `defaults`: of all commands.
  explicit ShortcutKeys(Shortcuts defaults, ShortcutScheme scheme = ShortcutScheme::pacs);
  /// From settings "shortcuts" (pacs, research) and "shortcut.<id>" (keys, "none", or "default"). What cannot
  /// be read, or would give a key to two commands, is as if it were not there.
  static ShortcutKeys from(const std::map<std::string, std::string>& settings, Shortcuts defaults);
  /// The same commands by the keys of a scheme, nothing changed.
  ShortcutKeys in_scheme(ShortcutScheme scheme) const { return ShortcutKeys(defaults_, scheme); }
  /// As `from` reads them; of all commands that are or were changed (`before`).
  std::map<std::string, std::string> settings(const ShortcutKeys& before) const;

  ShortcutScheme scheme() const { return scheme_; }
  /// Empty for a command without keys.
  QList<QKeySequence> keys(const QString& id) const;
  bool is_changed(const QString& id) const { return changed_.count(id) > 0; }
  /// The command that `keys`, or keys that begin like them, run already; `but` is not asked.
  std::optional<QString> taken_by(const QKeySequence& keys, const QString& but = {}) const;
  /// False, and nothing changed, where another command or the views have these keys. Empty: no key at all.
  bool change(const QString& id, const QKeySequence& keys);
  /// Back to the scheme's keys; false where another command has been given one of them meanwhile.
  bool reset(const QString& id);
  void reset_all() { changed_.clear(); }

 private:
  QList<QKeySequence> scheme_keys(const QString& id) const;
  Shortcuts defaults_ = std::make_shared<const std::vector<Shortcut>>();
  ShortcutScheme scheme_ = ShortcutScheme::pacs;
  std::map<QString, QKeySequence> changed_;
};

}  // namespace ostia::workstation
