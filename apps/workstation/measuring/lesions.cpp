#include "measuring/lesions.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "shell/desk.h"

#include <QClipboard>
#include <QGuiApplication>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int plaque_pause_ms = 500;  // a hand that edits is let alone that long

void say_of_lesion(Desk& desk, Lesions& lesions, session::LesionState state) {
  if (!lesions.list().say(state)) desk.messages.say(Command::tr("The cursor is in no lesion of the table."));
}

void walk_lesions(Desk& desk, Lesions& lesions, int by) {
  if (!lesions.list().walk(by)) desk.messages.say(Command::tr("No other lesion in this direction."));
}

}  // namespace

Lesions::Lesions(Desk& desk, session::EvaluabilityBoard& evaluability,
                 std::shared_ptr<session::FoundWalls> found, LesionList& list)
    : QObject(&desk.window),
      desk_(desk),
      board_(desk.bench, evaluability, std::move(found)),
      list_(&list),
      work_(desk.bench, board_, plaque_pause_ms) {
  list.show_lesions(&board_);
}

Lesions::~Lesions() {
  if (list_) list_->show_lesions(nullptr);
}

void add_lesion_commands(CommandTable& table, Desk& desk, Lesions& lesions) {
  table.add(needs_case({.id = "view.next_lesion",
                        .text = Command::tr("Next lesion"),
                        .tip = Command::tr("All views go to the narrowest place of the next lesion of the "
                                           "table, as it is sorted and filtered."),
                        .keys = {"L"},
                        .run = [&desk, &lesions] { walk_lesions(desk, lesions, 1); }},
                       desk));
  table.add(needs_case({.id = "view.previous_lesion",
                        .text = Command::tr("Previous lesion"),
                        .tip = Command::tr("All views go to the narrowest place of the lesion before it in "
                                           "the table."),
                        .keys = {"Shift+L"},
                        .run = [&desk, &lesions] { walk_lesions(desk, lesions, -1); }},
                       desk));
  const auto add = [&](const char* id, const QString& text, const QString& tip, const char* keys,
                       session::LesionState state) {
    table.add(needs_case({.id = id,
                          .text = text,
                          .tip = tip,
                          .keys = {keys},
                          .run = [&desk, &lesions, state] { say_of_lesion(desk, lesions, state); }},
                         desk));
  };
  add("lesion.accept", Command::tr("&Accept the lesion"),
      Command::tr("The lesion at the cursor is one: it is graded, as if its vessel were checked."), "Y",
      session::LesionState::accepted);
  add("lesion.reject", Command::tr("&Reject the lesion"),
      Command::tr("The lesion at the cursor is none: the report lists it as rejected and does not grade it."),
      "X", session::LesionState::rejected);
  add("lesion.open", Command::tr("Leave the lesion &open"),
      Command::tr("Takes back what was said of the lesion at the cursor."), "Shift+X",
      session::LesionState::open);
  table.add(
      needs_case({.id = "lesion.comment",
                  .text = Command::tr("&Comment the lesion"),
                  .tip = Command::tr("Types a comment on the lesion at the cursor; it is in the report."),
                  .keys = {"Shift+K"},
                  .run =
                      [&desk, &lesions] {
                        if (!lesions.list().comment())
                          desk.messages.say(Command::tr("The cursor is in no lesion of the table."));
                      }},
                 desk));
  table.add(needs_case({.id = "lesion.copy",
                        .text = Command::tr("Copy the &table of lesions"),
                        .tip = Command::tr("The rows that are shown, as text with tabs between the cells."),
                        .run =
                            [&desk, &lesions] {
                              QGuiApplication::clipboard()->setText(lesions.list().as_text());
                              desk.messages.say(Command::tr("The table of lesions was copied as text."));
                            }},
                       desk));
}

}  // namespace ostia::workstation
