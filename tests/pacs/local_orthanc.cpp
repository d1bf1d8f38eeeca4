#include "local_orthanc.h"

#include "shared_data.h"

#include "ostia/core/files.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace ostia::testing {
namespace {

constexpr const char* program = "/usr/sbin/Orthanc";
constexpr const char* plugin = "/usr/share/orthanc/plugins/libOrthancDicomWeb.so";

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

}  // namespace

int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof address;
  ::bind(socket, reinterpret_cast<const sockaddr*>(&address), size);
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(socket);
  return ntohs(address.sin_port);
}

void make_certificate(const std::filesystem::path& folder) {
  const std::string at = folder.string();
  const std::string command =
      "openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=localhost -addext "
      "subjectAltName=DNS:localhost -keyout " +
      at + "/key.pem -out " + at + "/certificate.pem 2>/dev/null";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("openssl makes no certificate");
}

bool LocalOrthanc::is_installed() {
  return ::access(program, X_OK) == 0 && ::access(plugin, R_OK) == 0;
}

LocalOrthanc::LocalOrthanc(const OrthancSetting& setting)
    : folder_(temporary_folder("orthanc")),
      tls_(setting.tls),
      web_port_(free_port()),
      dicom_port_(free_port()),
      receive_port_(free_port()) {
  const std::string store = (setting.store.empty() ? folder_ / "store" : setting.store).string();
  nlohmann::json config{{"Name", "test"},
                        {"StorageDirectory", store},
                        {"IndexDirectory", store},
                        {"Plugins", {plugin}},
                        {"HttpPort", web_port_},
                        {"RemoteAccessAllowed", false},
                        {"AuthenticationEnabled", true},
                        {"RegisteredUsers", {{"ostia", "open sesame"}}},
                        {"DicomAet", "ORTHANC"},
                        {"DicomCheckCalledAet", true},
                        {"DicomPort", dicom_port_},
                        {"DicomAlwaysAllowFind", true},
                        {"DicomAlwaysAllowGet", true},
                        {"DicomAlwaysAllowMove", true},
                        {"DicomModalities", {{"ostia", {"OSTIA", "127.0.0.1", receive_port_}}}},
                        {"DicomWeb", {{"Enable", true}, {"Root", "/dicom-web/"}}},
                        {"DefaultEncoding", "Utf8"},
                        {"SaveJobs", false}};
  if (tls_) {
    make_certificate(folder_);
    config["DicomTlsEnabled"] = true;
    config["DicomTlsCertificate"] = (folder_ / "certificate.pem").string();
    config["DicomTlsPrivateKey"] = (folder_ / "key.pem").string();
    config["DicomTlsTrustedCertificates"] = (folder_ / "certificate.pem").string();
    config["DicomTlsRemoteCertificateRequired"] = false;
  }
  core::write_file(folder_ / "orthanc.json", config.dump(1));
  const std::string log_file = (folder_ / "log").string(), config_file = (folder_ / "orthanc.json").string();
  process_ = ::fork();
  if (process_ == 0) {
    const int out = ::open(log_file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    ::dup2(out, 1);
    ::dup2(out, 2);
    ::execl(program, program, config_file.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  for (int n = 0; n < 600; ++n) {
    if (answers(web_port_) && answers(dicom_port_)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  kill();
}

LocalOrthanc::~LocalOrthanc() {
  kill();
}

void LocalOrthanc::kill() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

std::string LocalOrthanc::log() const {
  return core::read_file(folder_ / "log");
}

bool LocalOrthanc::answers(int port) const {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = loopback(port);
  const bool connected = ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::close(socket);
  return connected;
}

pacs::ServerDescription LocalOrthanc::by_dimse() const {
  pacs::ServerDescription server;
  server.name = "archive";
  server.host = tls_ ? "localhost" : "127.0.0.1";
  server.port = dicom_port_;
  server.title = "ORTHANC";
  server.receive_port = receive_port_;
  server.tls = tls_;
  if (tls_) server.authorities = folder_ / "certificate.pem";
  server.idle_timeout_s = 20.0;
  return server;
}

pacs::ServerDescription LocalOrthanc::by_get() const {
  return by_dimse();
}

pacs::ServerDescription LocalOrthanc::by_move() const {
  pacs::ServerDescription server = by_dimse();
  server.retrieval = pacs::Retrieval::move;
  return server;
}

pacs::ServerDescription LocalOrthanc::by_web() const {
  pacs::ServerDescription server;
  server.name = "archive";
  server.transport = pacs::Transport::dicomweb;
  server.url = "http://localhost:" + std::to_string(web_port_) + "/dicom-web";
  server.login = pacs::Login::basic;
  server.user = "ostia";
  server.idle_timeout_s = 20.0;
  return server;
}

}  // namespace ostia::testing
