#include "opening/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "opening/opening.h"
#include "opening/orientation.h"
#include "shell/desk.h"

namespace ostia::workstation {

void add_opening_commands(CommandTable& table, const Desk& desk, Opening& opening, Orientation& orientation) {
  table.add(
      {.id = "file.open",
       .text = Command::tr("&Open a case or image\u2026"),
       .tip = Command::tr(
           "Opens a case, an image file, or a zip of DICOM files; dropping it on the window does the same."),
       .keys = {"Ctrl+O"},
       .run = [&opening] { opening.choose_file(); }});
  table.add({.id = "file.open_folder",
             .text = Command::tr("Open a DICOM &folder\u2026"),
             .tip = Command::tr("Looks for CT series in a folder of DICOM files."),
             .keys = {"Ctrl+Shift+O"},
             .run = [&opening] { opening.choose_folder(); }});
  Command series{.id = "file.series",
                 .text = Command::tr("Ano&ther series\u2026"),
                 .tip = Command::tr("The series of the folder that was opened last, to choose another one."),
                 .run = [&opening] { opening.choose_another_series(); }};
  series.enabled = [&opening] { return opening.has_series(); };
  series.why_not = [] { return Command::tr("What was opened last is no folder of DICOM files."); };
  table.add(series);
  Command turned{
      .id = "file.orientation",
      .text = Command::tr("Set o&rientation\u2026"),
      .tip = Command::tr("How the image lies in the patient, where its file says it wrongly or not "
                         "at all."),
      .run = [&orientation] { orientation.ask(); }};
  turned.enabled = [&orientation] { return orientation.can_be_set(); };
  turned.why_not = [] { return Command::tr("No image is open."); };
  table.add(turned);
  table.add({.id = "file.sample",
             .text = Command::tr("The &sample case"),
             .tip = Command::tr("Opens a computed patient with disease, made on the first use."),
             .run = [&opening] { opening.open_sample(); }});
  table.add(
      needs_case({.id = "file.save_as",
                  .text = Command::tr("Save the case &as\u2026"),
                  .tip = Command::tr("Makes a copy of the case and goes on in it. A case is always saved."),
                  .keys = {"Ctrl+Shift+S"},
                  .run = [&opening] { opening.save_as(); }},
                 desk));
  table.add(needs_case({.id = "file.close",
                        .text = Command::tr("&Close the case"),
                        .tip = Command::tr("Closes the case; nothing is lost."),
                        .keys = {"Ctrl+W"},
                        .run = [&opening] { opening.close_case(); }},
                       desk));
}

}  // namespace ostia::workstation
