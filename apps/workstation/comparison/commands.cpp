#include "comparison/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "comparison/comparing.h"
#include "comparison/page.h"
#include "measuring/reporting.h"
#include "shell/bind.h"
#include "shell/desk.h"
#include "views/scene_widget.h"

#include <QSignalBlocker>

namespace ostia::workstation {
namespace {

Command needs_comparison(Command command, Comparing& comparing) {
  command.enabled = [&comparing] { return comparing.made() != nullptr; };
  command.why_not = [&comparing] { return comparing.why_none(); };
  return command;
}

/// Of what the page shows.
Command needs_comparison_page(Command command, Comparing& comparing, const ComparisonPage& page) {
  command.why_not = [&comparing, &page] {
    if (!comparing.made()) return comparing.why_none();
    return page.isHidden() ? Command::tr("The page of the comparison is not open.") : QString();
  };
  command.enabled = [why_not = command.why_not] { return why_not().isEmpty(); };
  return command;
}

void bind_page(QAction& action, ComparisonPage& page) {
  action.setCheckable(true);
  QObject::connect(&action, &QAction::toggled, &page, &QWidget::setVisible);
  QObject::connect(&page, &ComparisonPage::shown, &action, [&action](bool visible) {
    const QSignalBlocker quiet(&action);
    action.setChecked(visible);
  });
}

/// Off again with another comparison, or none.
void bind_former_wall(QAction& action, Comparing& comparing, ComparisonPage& page, SceneWidget& scene) {
  action.setCheckable(true);
  QObject::connect(&action, &QAction::toggled, &scene, [&comparing, &page, &scene](bool shown) {
    scene.show_other_wall(shown ? comparing.former_wall() : nullptr);
    if (shown) page.hide();  // it lies over the views
  });
  keep_with(&action, comparing.changed.observe([&action] { action.setChecked(false); }));
}

}  // namespace

void add_comparison_commands(CommandTable& table, Desk& desk, Comparing& comparing, ComparisonPage& page,
                             SceneWidget& scene, Reporting& reporting) {
  table.add(needs_case({.id = "file.compare",
                        .text = Command::tr("Compare with the last s&can\u2026"),
                        .tip = Command::tr("What has changed since the same patient's former case: lesions, "
                                           "lumen, plaque. The former case is only read."),
                        .keys = {"Ctrl+Alt+B"},
                        .run = [&comparing] { comparing.choose(); }},
                       desk));
  table.add(
      needs_comparison({.id = "compare.page",
                        .text = Command::tr("&Page of the comparison"),
                        .tip = Command::tr("Both scans side by side in the place of the views, and back."),
                        .keys = {"Ctrl+Alt+Y"},
                        .bind = [&page](QAction& action) { bind_page(action, page); }},
                       comparing));
  table.add(needs_comparison_page(
      {.id = "compare.blink",
       .text = Command::tr("&Blink"),
       .tip = Command::tr("The other scan in the same place; again, and the first is back."),
       .keys = {"Z"},
       .run = [&page] { page.blink(); }},
      comparing, page));
  table.add(needs_comparison_page({.id = "compare.side",
                                   .text = Command::tr("&Side by side"),
                                   .keys = {"Shift+Z"},
                                   .run = [&page] { page.side_by_side(); }},
                                  comparing, page));
  table.add(needs_comparison_page({.id = "compare.next",
                                   .text = Command::tr("Ne&xt lesion of either scan"),
                                   .tip = Command::tr("Both scans go to the next lesion of the list."),
                                   .keys = {"I"},
                                   .run = [&page] { page.step_lesion(1); }},
                                  comparing, page));
  table.add(needs_comparison_page({.id = "compare.previous",
                                   .text = Command::tr("Pre&vious lesion of either scan"),
                                   .keys = {"Shift+I"},
                                   .run = [&page] { page.step_lesion(-1); }},
                                  comparing, page));
  table.add(needs_comparison(
      {.id = "compare.in_3d",
       .text = Command::tr("&Former tree in the 3D view"),
       .tip = Command::tr("The former wall, blue and half transparent, over the present one: where it stands "
                          "out the vessel was wider."),
       .bind = [&comparing, &page,
                &scene](QAction& action) { bind_former_wall(action, comparing, page, scene); }},
      comparing));
  table.add(needs_comparison({.id = "compare.again",
                              .text = Command::tr("&Compare again"),
                              .tip = Command::tr("With the case as it is now."),
                              .run = [&comparing] { comparing.compare_again(); }},
                             comparing));
  table.add(
      needs_comparison({.id = "compare.report",
                        .text = Command::tr("&Take it into the next report"),
                        .tip = Command::tr("The lesions before and now, and what runs along the vessels, "
                                           "become pages of the next report."),
                        .run = [&comparing, &reporting] { reporting.add_pages(comparing.pages()); }},
                       comparing));
  table.add(
      needs_comparison({.id = "compare.save",
                        .text = Command::tr("&Write pages and tables\u2026"),
                        .tip = Command::tr("A folder with the comparison as PDF, HTML, JSON and table."),
                        .run = [&comparing] { comparing.save(); }},
                       comparing));
  table.add(needs_comparison({.id = "compare.close",
                              .text = Command::tr("Put the &former scan away"),
                              .run =
                                  [&comparing, &page] {
                                    page.hide();
                                    comparing.close();
                                  }},
                             comparing));
  keep_with(&table, comparing.changed.observe([&table, &comparing, &page] {
    page.setVisible(comparing.made() != nullptr);
    table.refresh();
  }));
  QObject::connect(&page, &ComparisonPage::shown, &table, &CommandTable::refresh);
}

}  // namespace ostia::workstation
