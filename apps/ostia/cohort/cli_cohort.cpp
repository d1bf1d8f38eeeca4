// What `ostia cohort` and its subcommands are told.

#include "cohort/cohort.h"
#include "options/subcommand.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace ostia::app {

void define_cohort(CLI::App& app, CohortCommands& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* cohort =
      app.add_subcommand("cohort", "Many scans in one folder: begun from a table, looked over, measured");
  cohort->footer("Example:\n  ostia cohort init scans.csv -o study");
  cohort->fallthrough();
  cohort->require_subcommand(1);

  CLI::App* init =
      add_subcommand_of(*cohort, "init", "A folder for a cohort from a table of scans, checked row by row",
                        "ostia cohort init scans.csv -o study", c.init, run_cohort_init, run);
  init->add_option(
          "TABLE", c.init.table,
          "CSV table, a row a scan: columns id, scan and, where wanted, patient, kind, series; paths from "
          "the table's folder on")
      ->required();
  init->add_option("-o,--output", c.init.output,
                   "Folder that is made; beside it one with .private, for the key and the names")
      ->required();
  init->add_flag("--skip-bad", c.init.skip_bad,
                 "Leave rows out that cannot be used (exit code 4), instead of making nothing");

  CLI::App* status = add_subcommand_of(*cohort, "status", "How many scans are how far, and why others failed",
                                       "ostia cohort status study", c.status, run_cohort_status, run);
  status->add_option("COHORT", c.status.cohort, "Folder of the cohort")->required();
  status->add_flag("--verify", c.status.verify, "Compute the digest of every file that was made, too");

  CLI::App* table =
      add_subcommand_of(*cohort, "table", "The measures of all scans as tidy tables with a data dictionary",
                        "ostia cohort table study -o tables", c.table, run_cohort_table, run);
  table->add_option("COHORT", c.table.cohort, "Folder of the cohort")->required();
  table
      ->add_option("-o,--output", c.table.output,
                   "Folder that is made: scans.csv, measures.csv, dictionary.csv, measures.sqlite")
      ->required();

  CLI::App* page =
      add_subcommand_of(*cohort, "page", "A page for a browser: counts, failures, pictures, reviews",
                        "ostia cohort page study", c.page, run_cohort_page, run);
  page->add_option("COHORT", c.page.cohort, "Folder of the cohort; its folder page is made")->required();

  CLI::App* serve =
      add_subcommand_of(*cohort, "serve", "That page on this machine's loopback, which writes reviews itself",
                        "ostia cohort serve study", c.serve, run_cohort_serve, run);
  serve->add_option("COHORT", c.serve.cohort, "Folder of the cohort; its page is made anew")->required();
  serve->add_option("--port", c.serve.port, "Port of 127.0.0.1; 0: one that is free");

  CLI::App* compare = add_subcommand_of(
      *cohort, "compare", "The same scans in two cohorts: what changed for whom",
      "ostia cohort compare release-1 release-2 -o changes", c.compare, run_cohort_compare, run);
  compare->add_option("BEFORE", c.compare.before, "Folder of a cohort")->required();
  compare->add_option("AFTER", c.compare.after, "Folder of another one, of the same scans")->required();
  compare
      ->add_option("-o,--output", c.compare.output, "Folder that is made: index.html, changes.csv, pictures")
      ->required();

  CLI::App* statistics = add_subcommand_of(
      *cohort, "statistics", "Those tables against what else is known: agreement, ROC curves",
      "ostia cohort statistics tables reference.csv -o statistics", c.statistics, run_cohort_statistics, run);
  statistics->add_option("TABLES", c.statistics.tables, "Folder that `ostia cohort table` has made")
      ->required();
  statistics
      ->add_option(
          "REFERENCE", c.statistics.reference,
          "CSV with a column scan (pseudonyms): columns of values, or measure and value as measures.csv "
          "has them")
      ->required();
  statistics
      ->add_option("-o,--output", c.statistics.output,
                   "Folder that is made: index.html, agreement.csv, roc.csv, pairs.csv")
      ->required();

  CLI::App* crate =
      add_subcommand_of(*cohort, "crate", "How all results were made, as a Workflow Run RO-Crate",
                        "ostia cohort crate study", c.crate, run_cohort_crate, run);
  crate->add_option("COHORT", c.crate.cohort, "Folder of the cohort; its ro-crate-metadata.json is written")
      ->required();
  crate->add_option("--name", c.crate.name, "What the crate is called");
  crate->add_option("--license", c.crate.license, "Under which terms: a URL or a sentence");

  CLI::App* reproduce = add_subcommand_of(
      *cohort, "reproduce", "Scans of a crate done once more, and compared bit by bit",
      "ostia cohort reproduce study -o again --only 3", c.reproduce, run_cohort_reproduce, run);
  reproduce->add_option("CRATE", c.reproduce.crate, "Folder of the crate")->required();
  reproduce
      ->add_option("-o,--output", c.reproduce.output, "Folder that is made: what was made again, files.csv")
      ->required();
  reproduce->add_option("--only", c.reproduce.only,
                        "So many scans, evenly spaced over all that have results; 0: all");
  reproduce->add_option(
      "--private", c.reproduce.private_folder,
      "The private folder of the cohort, which says where scans are; beside it unless given");

  CLI::App* review = add_subcommand_of(
      *cohort, "review", "What a person said of the cases on that page, taken into the cohort",
      "ostia cohort review study reviews.json", c.review, run_cohort_review, run);
  review->add_option("COHORT", c.review.cohort, "Folder of the cohort")->required();
  review->add_option("FILE", c.review.file, "Reviews that the page exported")->required();
}

}  // namespace ostia::app
