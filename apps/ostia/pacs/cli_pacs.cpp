// The options of `ostia pacs` and its subcommands.

#include "options/subcommand.h"
#include "pacs/pacs.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

namespace ostia::app {
namespace {

using PacsRun = std::function<ExitCode(const core::TaskContext&)>;

void add_login(CLI::App& app, PacsServerOptions& o) {
  app.add_option(
      "--servers", o.servers,
      "JSON file that describes the servers; left out: ostia/pacs.json in the user's folder of settings");
  app.add_option(
      "--password-file", o.password_file,
      "File whose first line is the password or token, its owner's alone; left out: the environment's "
      "OSTIA_PACS_PASSWORD");
}

void add_server(CLI::App& app, PacsServerOptions& o) {
  app.add_option("SERVER", o.server, "Name of the server in the file of servers")->required();
  add_login(app, o);
}

void add_find(CLI::App& pacs, PacsFindCommand& c, PacsRun& run) {
  CLI::App* find =
      add_subcommand_of(pacs, "find", "Studies, the series of a study, or the images of a series",
                        "ostia pacs find hospital --patient-name 'DOE^J*' --from 20260101 --modality CT\n"
                        "  ostia pacs find hospital --study 1.2.3",
                        c, run_pacs_find, run);
  add_server(*find, c.at);
  find->add_option("--level", c.level,
                   "What is looked for; left out: studies, series with --study, images with --series, too")
      ->check(CLI::IsMember({"study", "series", "image"}));
  find->add_option("--patient-name", c.patient_name,
                   "As DICOM has it, FAMILY^GIVEN; * and ? stand for any characters");
  find->add_option("--patient-id", c.patient_id, "The patient's identifier");
  find->add_option("--from", c.from, "Studies of this day or later, YYYYMMDD");
  find->add_option("--to", c.to, "Studies of this day or earlier, YYYYMMDD");
  find->add_option("--description", c.description,
                   "Of the study or series; * and ? stand for any characters");
  find->add_option("--modality", c.modality, "CT, MR, ...");
  find->add_option("--study", c.study, "UID of the study");
  find->add_option("--series", c.series, "UID of the series");
  find->add_option("--most", c.most, "Results; more are cut off")->check(CLI::Range(1, 1000000));
}

}  // namespace

void define_pacs(CLI::App& app, PacsCommands& c, PacsRun& run) {
  CLI::App* pacs = app.add_subcommand(
      "pacs", "Search in an image archive, fetch from it and send to it (DICOM, DICOMweb)");
  pacs->footer("Example:\n  ostia pacs find hospital --patient-id 4711 --servers servers.json");
  pacs->require_subcommand(1);
  pacs->fallthrough();

  CLI::App* echo =
      add_subcommand_of(*pacs, "echo", "Whether a server answers and lets us in",
                        "ostia pacs echo hospital --servers servers.json", c.echo, run_pacs_echo, run);
  add_server(*echo, c.echo.at);
  add_find(*pacs, c.find, run);

  CLI::App* get = add_subcommand_of(*pacs, "get", "A series as a folder, whole or not at all",
                                    "ostia pacs get hospital --study 1.2.3 --series 1.2.3.4 -o CT", c.get,
                                    run_pacs_get, run);
  add_server(*get, c.get.at);
  get->add_option("--study", c.get.study, "UID of the study")->required();
  get->add_option("--series", c.get.series, "UID of the series")->required();
  get->add_option("-o,--output", c.get.output, "Folder that is made")->required();

  CLI::App* send =
      add_subcommand_of(*pacs, "send", "DICOM objects to a server; sent twice they are there once",
                        "ostia pacs send hospital report.dcm --queue outbox", c.send, run_pacs_send, run);
  add_server(*send, c.send.at);
  send->add_option("INPUT", c.send.inputs, "DICOM files, or folders of them")->required();
  send->add_option("--queue", c.send.queue, "Folder in which waits what cannot be sent now");

  CLI::App* queue = add_subcommand_of(*pacs, "queue", "What waits to be sent, was sent or was refused",
                                      "ostia pacs queue outbox --send", c.queue, run_pacs_queue, run);
  queue->add_option("QUEUE", c.queue.queue, "Folder of `ostia pacs send --queue`")->required();
  add_login(*queue, c.queue.at);
  queue->add_flag("--send", c.queue.send, "Try what waits");
  queue->add_flag("--retry", c.queue.retry, "Try also what was refused");
  queue->add_flag("--forget", c.queue.forget, "Drop the notes of what was sent");
}

}  // namespace ostia::app
