#pragma once
/// \file Which image archives there are, and how each is reached. No secret is part of it.

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::pacs {

enum class Transport {
  dimse,    ///< DICOM's own protocol (PS3.7, PS3.8)
  dicomweb  ///< QIDO-RS, WADO-RS, STOW-RS (PS3.18)
};
/// How a server of transport dimse hands objects over.
enum class Retrieval {
  get,  ///< C-GET: on the connection that asked
  move  ///< C-MOVE: the server connects to `receive_port`, and must know `own_title` with this machine's
        ///< address
};
enum class Login { none, basic, bearer };

struct ServerDescription {
  std::string name;  ///< how it is called here
  Transport transport = Transport::dimse;

  // dimse
  std::string host;
  int port = 104;
  std::string title;                ///< the server's application entity title, 1 to 16 characters
  std::string own_title = "OSTIA";  ///< ours
  Retrieval retrieval = Retrieval::get;
  int receive_port = 11112;      ///< of move: where this machine listens while it fetches
  int receive_associations = 4;  ///< of move: the most at a time; 1 to 16
  bool tls = false;              ///< of dicomweb: an URL that begins with https

  // dicomweb
  std::string url;  ///< https://host/dicom-web, without query; http, with a login, on this machine alone
  Login login = Login::none;
  std::string user;   ///< of login basic
  std::string proxy;  ///< http://host:port; empty: none, whatever the environment says

  // both, with TLS; files in PEM
  std::filesystem::path authorities;  ///< certificates that are trusted; empty: the system's
  std::filesystem::path certificate;  ///< our own, for a server that asks for one; empty: none
  std::filesystem::path key;          ///< of `certificate`

  double connect_timeout_s = 10.0;  ///< until it answers at all
  double idle_timeout_s = 30.0;     ///< the longest silence
  int attempts = 3;                 ///< of what a broken connection ended; 1 to 10
};

/// Throws InvalidInput naming server, member and the way out.
void validate(const ServerDescription& server);

/// A file of {"servers": [{"name": ..., "transport": "dimse", ...}]}, each with the members of
/// ServerDescription that are not the default. Throws IoError, and InvalidInput for what is no such file, an
/// unknown member (a password among them) or a name that is there twice.
std::vector<ServerDescription> read_servers(const std::filesystem::path& file);
/// Throws InvalidInput (validate), IoError, ResourceError.
void write_servers(const std::filesystem::path& file, const std::vector<ServerDescription>& servers);
/// Throws InvalidInput that lists the names there are.
const ServerDescription& server_named(const std::vector<ServerDescription>& servers, const std::string& name);
/// `$XDG_CONFIG_HOME/ostia/pacs.json` or `~/.config/ostia/pacs.json`.
std::filesystem::path default_servers_file();

/// What must not be written down: in memory alone, and never in a message.
struct Secrets {
  std::string password;      ///< of login basic, or the token of login bearer
  std::string key_password;  ///< of an encrypted `key`
};
/// The first line of `password_file` where it is given, else the environment's OSTIA_PACS_PASSWORD; the key's
/// from OSTIA_PACS_KEY_PASSWORD. What is not there is empty. Both are kept out of logs from then on. Throws
/// IoError, and InvalidInput for a file that others than its owner may read.
Secrets secrets_from(const std::filesystem::path& password_file);

}  // namespace ostia::pacs
