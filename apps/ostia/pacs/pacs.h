#pragma once
/// \file `ostia pacs`: search in an image archive, fetch from it, send to it.

#include "commands.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

/// Which server, and how it lets us in.
struct PacsServerOptions {
  std::string server;                   ///< its name in `servers`
  std::filesystem::path servers;        ///< file of descriptions; empty: the user's own
  std::filesystem::path password_file;  ///< empty: the environment
};

struct PacsEchoCommand {
  PacsServerOptions at;
  bool json = false;
};
ExitCode run_pacs_echo(const PacsEchoCommand& options, const core::TaskContext& task);

struct PacsFindCommand {
  PacsServerOptions at;
  std::string level;  ///< study, series, image; empty: by the UIDs given
  std::string patient_name, patient_id, from, to, description, modality, study, series;
  std::size_t most = 1000;
  bool json = false;
};
ExitCode run_pacs_find(const PacsFindCommand& options, const core::TaskContext& task);

struct PacsGetCommand {
  PacsServerOptions at;
  std::string study, series;
  std::filesystem::path output;  ///< folder that is made
  bool json = false;
};
ExitCode run_pacs_get(const PacsGetCommand& options, const core::TaskContext& task);

struct PacsSendCommand {
  PacsServerOptions at;
  std::vector<std::filesystem::path> inputs;  ///< files and folders
  std::filesystem::path queue;                ///< folder; empty: sent without one
  bool json = false;
};
ExitCode run_pacs_send(const PacsSendCommand& options, const core::TaskContext& task);

struct PacsQueueCommand {
  PacsServerOptions at;         ///< without a server
  std::filesystem::path queue;  ///< folder
  bool send = false, retry = false, forget = false;
  bool json = false;
};
ExitCode run_pacs_queue(const PacsQueueCommand& options, const core::TaskContext& task);

struct PacsCommands {
  PacsEchoCommand echo;
  PacsFindCommand find;
  PacsGetCommand get;
  PacsSendCommand send;
  PacsQueueCommand queue;
};

/// Adds `pacs` with its subcommands.
void define_pacs(CLI::App& app, PacsCommands& pacs, std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
