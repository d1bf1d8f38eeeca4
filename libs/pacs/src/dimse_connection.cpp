#include "dimse_connection.h"

#include "ostia/pacs/archive.h"

#include <arpa/inet.h>
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcerror.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>
#include <dcmtk/dcmnet/dimse.h>
#include <dcmtk/dcmtls/tlslayer.h>
#include <dcmtk/oflog/oflog.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>

namespace ostia::pacs {
namespace {

constexpr long most_pdu_bytes = 131072;

void limit_silence(int socket, double seconds) {
  timeval time{};
  time.tv_sec = static_cast<time_t>(seconds);
  time.tv_usec = static_cast<suseconds_t>((seconds - std::floor(seconds)) * 1e6);
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
  ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &time, sizeof time);
}

/// Messages are written in several small pieces: Nagle's algorithm, which Debian's DCMTK leaves on, would
/// hold a later one back until the peer acknowledges the first, some 40 ms an object.
void send_at_once(int socket) {
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// And a peer that has it on waits for our acknowledgements, which the system delays as long.
class PromptConnection : public DcmTCPConnection {
 public:
  explicit PromptConnection(DcmNativeSocketType socket) : DcmTCPConnection(socket), socket_(socket) {}
  ssize_t read(void* to, size_t most) override {
    const int on = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);  // the system forgets it after a while
    return DcmTCPConnection::read(to, most);
  }

 private:
  const int socket_;
};

/// A transport layer whose sockets are watched from the moment that they are connected.
template <class Layer>
class WatchedLayer : public Layer {
 public:
  template <class... Arguments>
  WatchedLayer(SocketWatch& watch, double silence_s, Arguments... arguments)
      : Layer(arguments...), watch_(watch), silence_s_(silence_s) {}
  DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool secure) override {
    watch_.add(socket);
    send_at_once(socket);
    DcmTransportConnection* connection =
        secure ? Layer::createConnection(socket, secure) : new PromptConnection(socket);
    if (connection != nullptr) limit_silence(socket, silence_s_);
    return connection;
  }

 private:
  SocketWatch& watch_;
  const double silence_s_;
};

void use_certificates(DcmTLSTransportLayer& layer, const ServerDescription& server, const Secrets& secrets) {
  const auto require = [&](const OFCondition& condition, const char* member) {
    if (condition.bad())
      throw InvalidInput("the server '" + server.name + "': the file of `" + member + "` cannot be used");
  };
  require(layer.setTLSProfile(TSP_Profile_BCP195), "tls");
  if (server.authorities.empty()) {
    require(layer.addTrustedCertificateDir("/etc/ssl/certs", DCF_Filetype_PEM), "authorities");
  } else {
    require(layer.addTrustedCertificateFile(server.authorities.c_str(), DCF_Filetype_PEM), "authorities");
  }
  if (!server.certificate.empty()) {
    layer.setPrivateKeyPasswd(secrets.key_password.c_str());  // else DCMTK would ask on the terminal
    require(layer.setPrivateKeyFile(server.key.c_str(), DCF_Filetype_PEM), "key");
    require(layer.setCertificateFile(server.certificate.c_str(), DCF_Filetype_PEM), "certificate");
    if (!layer.checkPrivateKeyMatchesCertificate())
      throw InvalidInput("the server '" + server.name + "': `key` does not belong to `certificate`");
  }
  layer.setCertificateVerification(DCV_requireCertificate);
  require(layer.activateCipherSuites(), "tls");
}

bool is_foreign_talk(const OFCondition& condition) {
  static constexpr std::array codes{DULC_ILLEGALPDU,
                                    DULC_ILLEGALPDULENGTH,
                                    DULC_UNEXPECTEDPDU,
                                    DULC_UNRECOGNIZEDPDUTYPE,
                                    DULC_UNSUPPORTEDPEERPROTOCOL,
                                    DULC_CODINGERROR,
                                    DULC_PCTRANSLATIONFAILURE,
                                    DIMSEC_PARSEFAILED,
                                    DIMSEC_UNEXPECTEDPDVTYPE,
                                    DIMSEC_BADCOMMANDTYPE,
                                    DIMSEC_INVALIDPRESENTATIONCONTEXTID,
                                    DIMSEC_UNEXPECTEDRESPONSE,
                                    DIMSEC_UNEXPECTEDREQUEST};
  return condition.module() == OFM_dcmnet &&
         std::find(codes.begin(), codes.end(), condition.code()) != codes.end();
}

}  // namespace

const std::vector<std::string>& plain_syntaxes() {
  static const std::vector<std::string> all{UID_LittleEndianExplicitTransferSyntax,
                                            UID_LittleEndianImplicitTransferSyntax};
  return all;
}

const std::vector<std::string>& received_syntaxes() {
  static const std::vector<std::string> all{UID_LittleEndianExplicitTransferSyntax,
                                            UID_JPEGProcess14SV1TransferSyntax,
                                            UID_JPEG2000LosslessOnlyTransferSyntax,
                                            UID_JPEG2000TransferSyntax,
                                            UID_JPEGLSLosslessTransferSyntax,
                                            UID_JPEGLSLossyTransferSyntax,
                                            UID_RLELosslessTransferSyntax,
                                            UID_JPEGProcess1TransferSyntax,
                                            UID_JPEGProcess2_4TransferSyntax,
                                            UID_JPEGProcess14TransferSyntax,
                                            UID_DeflatedExplicitVRLittleEndianTransferSyntax,
                                            UID_LittleEndianImplicitTransferSyntax};
  return all;
}

void prepare_dcmtk() {
  static std::once_flag once;
  std::call_once(once, [] {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);
    dcmDisableGethostbyaddr.set(OFTrue);
    DcmTLSTransportLayer::initializeOpenSSL();
  });
}

void set_transport(T_ASC_Network* network, int role, const ServerDescription& server, const Secrets& secrets,
                   SocketWatch& watch) {
  DcmTransportLayer* layer = nullptr;
  if (server.tls) {
    auto secure = std::make_unique<WatchedLayer<DcmTLSTransportLayer>>(
        watch, server.idle_timeout_s, static_cast<T_ASC_NetworkRole>(role), static_cast<const char*>(nullptr),
        OFFalse);
    use_certificates(*secure, server, secrets);
    layer = secure.release();
  } else {
    layer = new WatchedLayer<DcmTransportLayer>(watch, server.idle_timeout_s);
  }
  ASC_setTransportLayer(network, layer, 1);  // the network's own from now on
}

DimseConnection::DimseConnection(const ServerDescription& server, const Secrets& secrets,
                                 const std::vector<ProposedContext>& contexts, const core::TaskContext& task)
    : server_(server), task_(task), watch_(task) {
  prepare_dcmtk();
  const std::string address = reachable_address(
      server.name, server.host, server.port,
      std::chrono::milliseconds(static_cast<long>(server.connect_timeout_s * 1000.0)), task);
  dcmConnectionTimeout.set(std::max(1, static_cast<int>(std::ceil(server.connect_timeout_s))));
  if (ASC_initializeNetwork(NET_REQUESTOR, 0, timeout(), &network_).bad())
    throw ResourceError("no network can be opened");
  try {
    set_transport(network_, NET_REQUESTOR, server, secrets, watch_);
    request(contexts, address);
    if (server.tls) require_right_host();
  } catch (...) {
    if (association_ != nullptr) ASC_abortAssociation(association_);
    if (association_ != nullptr) ASC_destroyAssociation(&association_);
    ASC_dropNetwork(&network_);
    throw;
  }
}

DimseConnection::~DimseConnection() {
  if (association_ != nullptr) {
    ASC_abortAssociation(association_);
    ASC_destroyAssociation(&association_);
  }
  ASC_dropNetwork(&network_);
}

int DimseConnection::timeout() const {
  return std::max(1, static_cast<int>(std::ceil(server_.idle_timeout_s)));
}

void DimseConnection::request(const std::vector<ProposedContext>& contexts, const std::string& address) {
  T_ASC_Parameters* parameters = nullptr;
  if (ASC_createAssociationParameters(&parameters, most_pdu_bytes).bad())
    throw ResourceError("no association can be opened");
  ASC_setTransportLayerType(parameters, server_.tls);
  ASC_setAPTitles(parameters, server_.own_title.c_str(), server_.title.c_str(), nullptr);
  ASC_setPresentationAddresses(parameters, "localhost",
                               (address + ":" + std::to_string(server_.port)).c_str());
  int id = 1;
  for (const ProposedContext& context : contexts) {
    std::vector<const char*> syntaxes;
    for (const std::string& syntax : context.transfer_syntaxes) syntaxes.push_back(syntax.c_str());
    ASC_addPresentationContext(parameters, static_cast<T_ASC_PresentationContextID>(id),
                               context.abstract_syntax.c_str(), syntaxes.data(),
                               static_cast<int>(syntaxes.size()),
                               context.receives ? ASC_SC_ROLE_SCP : ASC_SC_ROLE_DEFAULT);
    id += 2;
  }
  const int most_s = std::max(1, static_cast<int>(std::ceil(server_.connect_timeout_s)));
  const OFCondition condition =
      ASC_requestAssociation(network_, parameters, &association_, nullptr, nullptr, DUL_NOBLOCK, most_s);
  if (association_ == nullptr) ASC_destroyAssociationParameters(&parameters);
  if (condition.good()) return;
  task_.throw_if_cancelled();
  if (condition == DUL_ASSOCIATIONREJECTED && association_ != nullptr) refuse_rejected();
  if (condition.module() == OFM_dcmtls ||
      (condition.module() == OFM_dcmnet && condition.code() == DULC_TLSERROR))
    throw InvalidInput(
        "the server '" + server_.name +
        "': no secure connection; its certificate is not signed by one of `authorities`, ours is not "
        "accepted, or it does not speak TLS at this port");
  const bool silent = condition == DUL_READTIMEOUT || condition == DIMSE_NODATAAVAILABLE;
  if (server_.tls && !silent && !is_foreign_talk(condition))  // TLS 1.3 looks at our certificate afterwards
    throw NetworkError("the server '" + server_.name +
                       "' has ended the connection before it let us in; it may be busy, or it asks for "
                       "certificates and does not accept our certificate");
  require(condition);
}

void DimseConnection::refuse_rejected() const {
  T_ASC_RejectParameters rejected{};
  ASC_getRejectParameters(association_->params, &rejected);
  const std::string server = "the server '" + server_.name + "' ";
  if (rejected.reason == ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED)
    throw InvalidInput(server + "does not know us by the title '" + server_.own_title +
                       "'; have it registered there, or correct own_title");
  if (rejected.reason == ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED)
    throw InvalidInput(server + "is not called '" + server_.title + "'; correct title");
  if (rejected.result == ASC_RESULT_REJECTEDTRANSIENT)
    throw NetworkError(server + "has no connection free; try again later");
  throw InvalidInput(server + "rejects us; its administrator may know why");
}

void DimseConnection::require_right_host() const {
  // DCMTK looks who signed the certificate, but not for whom.
  const unsigned long size = ASC_getPeerCertificateLength(association_);
  std::vector<unsigned char> bytes(size);
  ASC_getPeerCertificate(association_, bytes.data(), size);
  const unsigned char* from = bytes.data();
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(
      d2i_X509(nullptr, &from, static_cast<long>(size)), &X509_free);
  const bool right =
      certificate && (X509_check_host(certificate.get(), server_.host.c_str(), 0, 0, nullptr) == 1 ||
                      X509_check_ip_asc(certificate.get(), server_.host.c_str(), 0) == 1);
  if (!right)
    throw InvalidInput("the server '" + server_.name + "': its certificate is not for the host '" +
                       server_.host + "'");
}

unsigned char DimseConnection::context(const char* abstract_syntax, const char* what) const {
  const unsigned char id = ASC_findAcceptedPresentationContextID(association_, abstract_syntax);
  if (id == 0) throw InvalidInput("the server '" + server_.name + "' does not offer " + what);
  return id;
}

unsigned char DimseConnection::context_for(const std::string& sop_class,
                                           const std::string& transfer_syntax) const {
  return ASC_findAcceptedPresentationContextID(association_, sop_class.c_str(), transfer_syntax.c_str());
}

void DimseConnection::release() {
  ASC_releaseAssociation(association_);
  ASC_destroyAssociation(&association_);
}

void DimseConnection::require(const OFCondition& condition) {
  if (condition.good()) return;
  task_.throw_if_cancelled();
  if (is_foreign_talk(condition))
    throw InvalidInput("the server '" + server_.name +
                       "' answers what is no DICOM; are host and port right?");
  if (condition == DIMSE_NODATAAVAILABLE || condition == DUL_READTIMEOUT)
    throw NetworkError("the server '" + server_.name + "' has been silent for too long");
  throw NetworkError("the connection to the server '" + server_.name + "' has broken");
}

}  // namespace ostia::pacs
