#include "local_orthanc.h"

#include "certificates.h"
#include "shared_data.h"

#include "ostia/core/files.h"

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace ostia::testing {
namespace {

constexpr const char* program = "/usr/sbin/Orthanc";
constexpr const char* plugin = "/usr/share/orthanc/plugins/libOrthancDicomWeb.so";

}  // namespace

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
  program_ = std::make_unique<StartedProgram>(
      std::vector<std::string>{program, (folder_ / "orthanc.json").string()}, folder_ / "log");
  if (!comes_to_answer(web_port_) || !comes_to_answer(dicom_port_)) kill();
  if (tls_) front_ = std::make_unique<TlsFront>(web_port_, folder_);
}

std::string LocalOrthanc::log() const {
  return core::read_file(folder_ / "log");
}

std::string LocalOrthanc::rest_url() const {
  return "http://localhost:" + std::to_string(web_port_);
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
  server.url = (tls_ ? "https://localhost:" + std::to_string(front_->port()) : rest_url()) + "/dicom-web";
  if (tls_) server.authorities = folder_ / "certificate.pem";
  server.login = pacs::Login::basic;
  server.user = "ostia";
  server.idle_timeout_s = 20.0;
  return server;
}

}  // namespace ostia::testing
