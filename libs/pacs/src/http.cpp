#include "http.h"

#include "ostia/pacs/archive.h"

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <exception>
#include <mutex>

namespace ostia::pacs {
namespace {

constexpr std::size_t most_gathered_bytes = 64U << 20;
constexpr long buffer_bytes = 512L << 10;

void prepare_curl() {
  static std::once_flag once;
  std::call_once(once, [] { curl_global_init(CURL_GLOBAL_DEFAULT); });
}

bool is_success(long status) {
  return status >= 200 && status < 300;
}

/// It may succeed another time.
bool may_pass(long status) {
  return status == 408 || status == 429 || (status >= 500 && status != 501 && status != 505);
}

/// What a proxy said in place of leading us through.
[[noreturn]] void refuse_tunnel(const std::string& server, long status) {
  const std::string said = " (HTTP " + std::to_string(status) + ")";
  if (status == 407) throw InvalidInput(server + " is behind a proxy that asks for a login" + said);
  const std::string refused = server + ": the proxy does not lead to it" + said;
  if (may_pass(status)) throw NetworkError(refused + "; try again later");
  throw InvalidInput(refused);
}

struct TlsAlert {
  std::string_view words;  ///< in OpenSSL's message
  const char* meaning;
};
constexpr const char* not_our_certificate =
    "it asks for a certificate of ours, or does not accept the one of `certificate`";
/// What a server's alerts mean (RFC 8446, 6.2); the first one whose words are there counts.
constexpr TlsAlert tls_alerts[] = {
    {"alert protocol version", "it speaks no TLS that is still safe, 1.2 at least"},
    {"alert insufficient security", "it asks for ciphers that we do not have"},
    {"unrecognized name", "it does not know the host of url"},
    // Before TLS 1.3 this also stands for a certificate that was not shown.
    {"alert handshake failure", "it has no cipher in common with us, or asks for a certificate of ours"},
    {"alert unknown ca", not_our_certificate},
    {"alert access denied", not_our_certificate},
    {"alert certificate", not_our_certificate},
    {"alert bad certificate", not_our_certificate},
    {"alert unsupported certificate", not_our_certificate},
    // libcurl's own words where the server says that ours has expired; of the server's it says which problem.
    {"SSL certificate verification failed", not_our_certificate}};

/// Throws where `fault`, libcurl's words, tells of an alert of the server.
void refuse_alert(const std::string& server, std::string_view fault) {
  for (const TlsAlert& one : tls_alerts)
    if (fault.find(one.words) != std::string_view::npos)
      throw InvalidInput(server + ": no secure connection; " + one.meaning);
  constexpr std::string_view any = " alert ";
  if (const auto at = fault.rfind(any); at != std::string_view::npos)
    throw NetworkError(server + " has ended the secure connection (TLS alert: " +
                       std::string(fault.substr(at + any.size(), 40)) + "); try again later");
}

}  // namespace

struct HttpClient::Curl {
  CURL* easy = nullptr;
  CURLM* multi = nullptr;
  std::array<char, CURL_ERROR_SIZE> fault{};  // in libcurl's words, which may name a host: to look into only
  ~Curl() {
    if (multi != nullptr) curl_multi_cleanup(multi);
    if (easy != nullptr) curl_easy_cleanup(easy);
  }
};

/// One request under way: what libcurl's callbacks see.
struct HttpClient::Exchange {
  const HttpRequest& request;
  const Sink& sink;
  CURL* easy;
  HttpAnswer answer{};
  std::exception_ptr thrown{};

  bool to_sink() {
    curl_easy_getinfo(easy, CURLINFO_RESPONSE_CODE, &answer.status);
    return sink && is_success(answer.status);
  }
  std::string content_type() const {
    const char* type = nullptr;
    curl_easy_getinfo(easy, CURLINFO_CONTENT_TYPE, &type);
    return type != nullptr ? type : "";
  }
  void take(std::string_view bytes) {
    if (to_sink()) return sink(content_type(), bytes);
    if (answer.body.size() + bytes.size() > most_gathered_bytes)
      throw InvalidInput("sends an answer without end");
    answer.body += bytes;
  }
  static std::size_t received(char* data, std::size_t one, std::size_t count, void* self) {
    auto& exchange = *static_cast<Exchange*>(self);
    try {
      exchange.take({data, one * count});
    } catch (...) {  // not through libcurl
      exchange.thrown = std::current_exception();
      return 0;
    }
    return one * count;
  }
  static std::size_t wanted(char* buffer, std::size_t one, std::size_t count, void* self) {
    auto& exchange = *static_cast<Exchange*>(self);
    try {
      return exchange.request.body(buffer, one * count);
    } catch (...) {
      exchange.thrown = std::current_exception();
      return CURL_READFUNC_ABORT;
    }
  }
};

HttpClient::HttpClient(const ServerDescription& server, const Secrets& secrets)
    : server_(server), secrets_(secrets), curl_(std::make_unique<Curl>()) {
  prepare_curl();
  curl_->easy = curl_easy_init();
  curl_->multi = curl_multi_init();
  if (curl_->easy == nullptr || curl_->multi == nullptr) throw ResourceError("no network can be opened");
}

HttpClient::~HttpClient() = default;

HttpAnswer HttpClient::request(const HttpRequest& request, const core::TaskContext& task, const Sink& sink) {
  CURL* easy = curl_->easy;
  curl_easy_reset(easy);  // keeps its connection
  Exchange exchange{request, sink, easy};
  const auto set = [easy](CURLoption option, auto value) { curl_easy_setopt(easy, option, value); };
  const std::string url = server_.url.substr(0, server_.url.find_last_not_of('/') + 1) + request.path;
  curl_->fault.front() = '\0';
  set(CURLOPT_ERRORBUFFER, curl_->fault.data());
  set(CURLOPT_URL, url.c_str());
  set(CURLOPT_PROTOCOLS_STR, "http,https");
  set(CURLOPT_PROXY, server_.proxy.c_str());  // an empty one: none, whatever the environment says
  set(CURLOPT_FOLLOWLOCATION, 0L);            // a login belongs to one server
  set(CURLOPT_NOSIGNAL, 1L);
  set(CURLOPT_QUICK_EXIT, 1L);  // a cancel does not wait for the look-up of a name
  set(CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_1_1));
  set(CURLOPT_BUFFERSIZE, buffer_bytes);
  set(CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(server_.connect_timeout_s * 1000.0));
  set(CURLOPT_LOW_SPEED_LIMIT, 1L);
  set(CURLOPT_LOW_SPEED_TIME, std::max(1L, static_cast<long>(server_.idle_timeout_s + 0.5)));
  set(CURLOPT_SSLVERSION, static_cast<long>(CURL_SSLVERSION_TLSv1_2));
  if (!server_.authorities.empty()) {
    set(CURLOPT_CAINFO, server_.authorities.c_str());
    set(CURLOPT_CAPATH, static_cast<const char*>(nullptr));  // these alone, none of the system's
  }
  if (!server_.certificate.empty()) {
    set(CURLOPT_SSLCERT, server_.certificate.c_str());
    set(CURLOPT_SSLKEY, server_.key.c_str());
    set(CURLOPT_KEYPASSWD, secrets_.key_password.c_str());
  }
  if (server_.login == Login::basic) {
    set(CURLOPT_HTTPAUTH, static_cast<long>(CURLAUTH_BASIC));
    set(CURLOPT_USERNAME, server_.user.c_str());
    set(CURLOPT_PASSWORD, secrets_.password.c_str());
  } else if (server_.login == Login::bearer) {
    set(CURLOPT_HTTPAUTH, static_cast<long>(CURLAUTH_BEARER));
    set(CURLOPT_XOAUTH2_BEARER, secrets_.password.c_str());
  }
  curl_slist* list = nullptr;
  for (const std::string& header : request.headers) list = curl_slist_append(list, header.c_str());
  list = curl_slist_append(list, "Expect:");  // no second round before a POST's body
  const std::unique_ptr<curl_slist, decltype(&curl_slist_free_all)> headers(list, &curl_slist_free_all);
  set(CURLOPT_HTTPHEADER, headers.get());
  set(CURLOPT_WRITEFUNCTION, &Exchange::received);
  set(CURLOPT_WRITEDATA, &exchange);
  if (request.post) {
    set(CURLOPT_POST, 1L);
    set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(request.body_bytes));
    set(CURLOPT_READFUNCTION, &Exchange::wanted);
    set(CURLOPT_READDATA, &exchange);
  }
  perform(exchange, task);
  curl_easy_getinfo(easy, CURLINFO_RESPONSE_CODE, &exchange.answer.status);
  return std::move(exchange.answer);
}

void HttpClient::perform(Exchange& exchange, const core::TaskContext& task) {
  curl_multi_add_handle(curl_->multi, curl_->easy);
  int running = 1;
  bool broken = false;
  while (running > 0 && !broken && !task.cancelled()) {
    broken = curl_multi_perform(curl_->multi, &running) != CURLM_OK;
    if (running > 0 && !broken) curl_multi_poll(curl_->multi, nullptr, 0, 100, nullptr);
  }
  int code = running > 0 ? CURLE_RECV_ERROR : CURLE_OK;
  int left = 0;
  while (const CURLMsg* message = curl_multi_info_read(curl_->multi, &left))
    if (message->msg == CURLMSG_DONE) code = message->data.result;
  curl_multi_remove_handle(curl_->multi, curl_->easy);
  task.throw_if_cancelled();
  if (exchange.thrown) {
    try {
      std::rethrow_exception(exchange.thrown);
    } catch (const InvalidInput& error) {
      throw InvalidInput("the server '" + server_.name + "' " + error.what());
    }
  }
  if (code != CURLE_OK) refuse(code);
}

void HttpClient::refuse(int code) const {
  const std::string name = "the server '" + server_.name + "'";
  long tunnel = 0;
  curl_easy_getinfo(curl_->easy, CURLINFO_HTTP_CONNECTCODE, &tunnel);
  if (tunnel >= 300) refuse_tunnel(name, tunnel);
  // With TLS 1.3 a server looks at our certificate when all else is done: what it says of it comes as an
  // alert in place of an answer.
  refuse_alert(name, curl_->fault.data());
  if (code == CURLE_SSL_CLIENTCERT)
    throw InvalidInput(name + ": no secure connection; " + not_our_certificate);
  switch (code) {
    case CURLE_PEER_FAILED_VERIFICATION:
      throw InvalidInput(
          name +
          ": its certificate is not for this host, has expired, or is not signed by one of `authorities`");
    case CURLE_SSL_CACERT_BADFILE:
      throw InvalidInput(name + ": the file of `authorities` cannot be used");
    case CURLE_SSL_CERTPROBLEM:
      throw InvalidInput(name + ": the file of `certificate` or `key` cannot be used");
    case CURLE_SSL_CONNECT_ERROR:
      throw InvalidInput(
          name +
          ": no secure connection; it does not speak TLS at this port, or does not accept our certificate");
    case CURLE_UNSUPPORTED_PROTOCOL:
    case CURLE_WEIRD_SERVER_REPLY:
    case CURLE_BAD_CONTENT_ENCODING:
      throw InvalidInput(name + " answers what is no HTTP; is url right?");
    case CURLE_URL_MALFORMAT:
      throw InvalidInput(name + ": url is none");
    case CURLE_COULDNT_RESOLVE_HOST:
      throw NetworkError(name + ": the host's name is not known to the network");
    case CURLE_COULDNT_RESOLVE_PROXY:
      throw NetworkError(name + ": the proxy's name is not known to the network");
    case CURLE_COULDNT_CONNECT:
      throw NetworkError(name + " does not answer; is it running, and is url right?");
    case CURLE_OPERATION_TIMEDOUT:
      throw NetworkError(name + " has been silent for too long");
    default:
      throw NetworkError("the connection to " + name.substr(4) + " has broken");
  }
}

void require_success(const ServerDescription& server, const HttpAnswer& answer, const char* what) {
  if (is_success(answer.status)) return;
  const std::string name = "the server '" + server.name + "' ";
  const std::string status = " (HTTP " + std::to_string(answer.status) + ")";
  if (answer.status == 401 || answer.status == 403)
    throw InvalidInput(name + "does not let us in" + status +
                       "; the password or token is missing, wrong or has expired");
  if (answer.status == 407) throw InvalidInput(name + "is behind a proxy that asks for a login" + status);
  if (answer.status == 404 || answer.status == 410)
    throw InvalidInput(name + "knows nothing of what was asked for" + status +
                       "; if all is so, url is wrong");
  if (answer.status >= 300 && answer.status < 400)
    throw InvalidInput(name + "sends us elsewhere" + status + ", where no login is taken; correct url");
  if (may_pass(answer.status)) throw NetworkError(name + "fails in " + what + status + "; try again later");
  throw InvalidInput(name + "refuses " + what + status);
}

}  // namespace ostia::pacs
