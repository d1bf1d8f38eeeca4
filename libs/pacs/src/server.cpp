#include "ostia/pacs/server.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"

#include <arpa/inet.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace ostia::pacs {
namespace {

[[noreturn]] void refuse_server(const ServerDescription& server, const std::string& fault) {
  throw InvalidInput("the server '" + server.name + "': " + fault);
}

bool is_title(const std::string& text) {
  return !text.empty() && text.size() <= 16 && text.find_first_not_of(' ') != std::string::npos &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7F && c != '\\'; });
}

bool is_port(int port) {
  return port >= 1 && port <= 65535;
}

/// The host of an URL that is known to begin with a scheme.
std::string host_of(std::string_view url) {
  url.remove_prefix(url.find("://") + 3);
  url = url.substr(0, url.find('/'));
  if (url.substr(0, 1) == "[") return std::string(url.substr(0, url.find(']') + 1));
  return std::string(url.substr(0, url.find(':')));
}

bool is_this_machine(const std::string& host) {
  in_addr address{};
  const bool is_address = ::inet_pton(AF_INET, host.c_str(), &address) == 1;
  return host == "localhost" || host == "[::1]" || (is_address && ntohl(address.s_addr) >> 24 == 127);
}

void validate_dimse(const ServerDescription& server) {
  if (server.host.empty() || server.host.find_first_of(" /:\n") != std::string::npos)
    refuse_server(server, "host must be a name or an address");
  if (!is_port(server.port)) refuse_server(server, "port must be 1 to 65535");
  if (!is_title(server.title))
    refuse_server(server, "title must be its application entity title, 1 to 16 characters of ASCII");
  if (!is_title(server.own_title)) refuse_server(server, "own_title must be 1 to 16 characters of ASCII");
  if (!is_port(server.receive_port)) refuse_server(server, "receive_port must be 1 to 65535");
  if (server.receive_associations < 1 || server.receive_associations > 16)
    refuse_server(server, "receive_associations must be 1 to 16");
}

void validate_dicomweb(const ServerDescription& server) {
  const std::string& url = server.url;
  const bool secure = url.compare(0, 8, "https://") == 0;
  if (!secure && url.compare(0, 7, "http://") != 0)
    refuse_server(server, "url must begin with https:// or http://");
  if (url.find_first_of("?# \n@") != std::string::npos)
    refuse_server(
        server, "url must have neither a query nor a login in it; the login is given by `login` and `user`");
  if (host_of(url).empty()) refuse_server(server, "url names no host");
  if (server.login == Login::basic && server.user.empty()) refuse_server(server, "login basic needs `user`");
  if (server.login != Login::none && !secure && !(is_this_machine(host_of(url)) && server.proxy.empty()))
    refuse_server(server,
                  "a password or token would be readable on the way; the url must begin with https://");
}

}  // namespace

void validate(const ServerDescription& server) {
  if (server.name.empty() || server.name.size() > 64)
    throw InvalidInput("a server needs a name of 1 to 64 bytes");
  server.transport == Transport::dimse ? validate_dimse(server) : validate_dicomweb(server);
  if (server.certificate.empty() != server.key.empty())
    refuse_server(server, "certificate and key belong together; give both or neither");
  if (!(server.connect_timeout_s >= 0.1 && server.connect_timeout_s <= 600.0))
    refuse_server(server, "connect_timeout_s must be 0.1 to 600");
  if (!(server.idle_timeout_s >= 0.1 && server.idle_timeout_s <= 3600.0))
    refuse_server(server, "idle_timeout_s must be 0.1 to 3600");
  if (server.attempts < 1 || server.attempts > 10) refuse_server(server, "attempts must be 1 to 10");
}

const ServerDescription& server_named(const std::vector<ServerDescription>& servers,
                                      const std::string& name) {
  std::string names;
  for (const ServerDescription& server : servers) {
    if (server.name == name) return server;
    names += (names.empty() ? "" : ", ") + server.name;
  }
  throw InvalidInput("there is no server '" + name + "'" +
                     (names.empty() ? "; none is described yet" : "; there are: " + names));
}

std::filesystem::path default_servers_file() {
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config != nullptr && *config == '/')
    return std::filesystem::path(config) / "ostia" / "pacs.json";
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr ? home : ".") / ".config" / "ostia" / "pacs.json";
}

Secrets secrets_from(const std::filesystem::path& password_file) {
  Secrets secrets;
  if (!password_file.empty()) {
    struct stat status {};
    if (::stat(password_file.c_str(), &status) == 0 && S_ISREG(status.st_mode) && (status.st_mode & 077) != 0)
      throw InvalidInput("others may read the password file " + password_file.string() +
                         "; make it its owner's alone (chmod 600)");
    secrets.password = core::read_file(password_file, 64U << 10);
    secrets.password.erase(std::min(secrets.password.find_first_of("\r\n"), secrets.password.size()));
    if (secrets.password.empty())
      throw InvalidInput("the password file " + password_file.string() + " is empty");
  } else if (const char* password = std::getenv("OSTIA_PACS_PASSWORD")) {
    secrets.password = password;
  }
  if (const char* password = std::getenv("OSTIA_PACS_KEY_PASSWORD")) secrets.key_password = password;
  core::redact_in_logs(secrets.password, "PASSWORD");
  core::redact_in_logs(secrets.key_password, "PASSWORD");
  return secrets;
}

}  // namespace ostia::pacs
