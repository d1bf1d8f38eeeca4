#include "pacs/pacs_server.h"

#include "ostia/pacs/server.h"

namespace ostia::app {

std::unique_ptr<pacs::Archive> archive_at(const PacsServerOptions& options, const std::string& server) {
  const std::filesystem::path file = options.servers.empty() ? pacs::default_servers_file() : options.servers;
  if (!std::filesystem::exists(file))
    throw IoError("there is no file of servers " + file.string() +
                  "; write one (docs/reference/pacs.md), or give --servers");
  return pacs::open_archive(pacs::server_named(pacs::read_servers(file), server),
                            pacs::secrets_from(options.password_file));
}

std::unique_ptr<pacs::Archive> archive_at(const PacsServerOptions& options) {
  return archive_at(options, options.server);
}

ExitCode sending_code(std::size_t refused, std::size_t unreachable) {
  if (unreachable > 0) return ExitCode::resources;
  return refused > 0 ? ExitCode::quality_failed : ExitCode::ok;
}

}  // namespace ostia::app
