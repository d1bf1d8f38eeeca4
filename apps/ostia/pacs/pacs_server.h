#pragma once
/// \file The server that a command of `ostia pacs` names.

#include "pacs/pacs.h"

#include "ostia/pacs/archive.h"

#include <memory>
#include <string>

namespace ostia::app {

/// Throws InvalidInput (no such server), IoError (no file of servers).
std::unique_ptr<pacs::Archive> archive_at(const PacsServerOptions& options);
std::unique_ptr<pacs::Archive> archive_at(const PacsServerOptions& options, const std::string& server);

/// Exit code of sending: 0 all, 5 where the server was not reached, 4 where it refused some.
ExitCode sending_code(std::size_t refused, std::size_t unreachable);

}  // namespace ostia::app
