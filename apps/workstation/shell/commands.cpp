#include "shell/commands.h"

#include "commands/table.h"
#include "shell/desk.h"
#include "shell/messages_dialog.h"
#include "shell/one_dialog.h"
#include "shell/preferences_dialog.h"
#include "shell/theme.h"
#include "views/scene_widget.h"

#include <functional>
#include <optional>

namespace ostia::workstation {
namespace {

void change_theme(Desk& desk, SceneWidget& scene) {
  const Theme theme = current_theme() == Theme::dark ? Theme::light : Theme::dark;
  apply_theme(theme);
  scene.set_dark(theme == Theme::dark);
  desk.machine.set_setting("theme", theme == Theme::dark ? "dark" : "light");
}

using NextStep = std::optional<session::JournalEntry> (session::CaseFile::*)() const;

/// A command that goes through the case's steps, usable where there is a next one, or `also` says so.
Command through_steps(Command command, Desk& desk, NextStep next, const QString& none,
                      const std::function<bool()>& also) {
  command.enabled = [&desk, next, also] {
    return (desk.bench.has_case() && (desk.bench.session().file().*next)().has_value()) || also();
  };
  command.why_not = [&desk, none] { return desk.bench.has_case() ? none : Command::tr("No case is open."); };
  return command;
}

}  // namespace

void add_shell_commands(CommandTable& table, Desk& desk, SceneWidget& scene, const StepsBeside& beside) {
  table.add({.id = "file.quit",
             .text = Command::tr("&Quit"),
             .tip = Command::tr("Ends the program; nothing is lost."),
             .keys = {"Ctrl+Q"},
             .run = [&desk] { desk.window.close(); }});
  table.add(through_steps({.id = "edit.undo",
                           .text = Command::tr("&Undo"),
                           .tip = Command::tr("Takes the last step back."),
                           .keys = {"Ctrl+Z"},
                           .run =
                               [&desk, beside] {
                                 if (beside.can_undo())
                                   beside.undo();
                                 else
                                   desk.bench.undo();
                               }},
                          desk, &session::CaseFile::next_undo, Command::tr("There is no step to take back."),
                          beside.can_undo));
  table.add(through_steps({.id = "edit.redo",
                           .text = Command::tr("&Redo"),
                           .tip = Command::tr("Does again what was taken back."),
                           .keys = {"Ctrl+Shift+Z; Ctrl+Y"},
                           .run =
                               [&desk, beside] {
                                 if (beside.can_redo())
                                   beside.redo();
                                 else
                                   desk.bench.redo();
                               }},
                          desk, &session::CaseFile::next_redo, Command::tr("No step was taken back."),
                          beside.can_redo));
  table.add({.id = "edit.preferences",
             .text = Command::tr("&Preferences\u2026"),
             .tip = Command::tr("Keys, theme and language."),
             .keys = {"Ctrl+,"},
             .run = [&desk, &table] { show_one<PreferencesDialog>(desk.window, desk, table); }});
  table.add({.id = "help.messages",
             .text = Command::tr("&Messages\u2026"),
             .tip = Command::tr("All that the window has said since it was opened, to be read again."),
             .keys = {"Ctrl+Shift+L"},
             .run = [&desk] { show_one<MessagesDialog>(desk.window, desk); }});
  table.add({.id = "view.theme",
             .text = Command::tr("Light or dark"),
             .tip = Command::tr("Changes between the dark and the light theme."),
             .run = [&desk, &scene] { change_theme(desk, scene); }});
}

}  // namespace ostia::workstation
