// TLS as it must be, certificates of both sides, and proxies on the way.

#include "certificates.h"
#include "fake_server.h"
#include "relays.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/pacs/archive.h"

#include <gmock/gmock.h>
#include <unistd.h>

namespace ostia::pacs {
namespace {

using ::testing::AnyOf;
using testing::CertificateWish;
using testing::FakeServer;
using ::testing::HasSubstr;
using testing::make_certificate;
using testing::StartedProgram;
using testing::TlsAlarm;
using testing::TlsFront;
using testing::Tunnel;
namespace fs = std::filesystem;

/// A folder with a certificate.
fs::path certified(const CertificateWish& wish = {}) {
  const fs::path folder = testing::temporary_folder("certificate");
  make_certificate(folder, wish);
  return folder;
}

/// An archive without studies.
std::string empty_archive(const std::string&) {
  return testing::http_answer(200, "application/dicom+json", "[]");
}

ServerDescription web_by_tls(int port, const fs::path& trusted) {
  ServerDescription server;
  server.name = "archive";
  server.transport = Transport::dicomweb;
  server.url = "https://localhost:" + std::to_string(port) + "/dicom-web";
  server.authorities = trusted / "certificate.pem";
  server.connect_timeout_s = server.idle_timeout_s = 10.0;
  server.attempts = 1;
  return server;
}

ServerDescription with_own(ServerDescription server, const fs::path& folder) {
  server.certificate = folder / "certificate.pem";
  server.key = folder / "key.pem";
  return server;
}

/// Why an echo is refused for good; empty: it is not.
std::string refusal_of(const ServerDescription& server, const Secrets& secrets = {}) {
  try {
    open_archive(server, secrets)->echo();
  } catch (const InvalidInput& error) {
    return error.what();
  } catch (const Error& error) {
    return std::string("not refused, but failed: ") + error.what();
  }
  return {};
}

struct WebByTls : ::testing::Test {
  FakeServer archive{empty_archive};
};

TEST_F(WebByTls, TheServersCertificateIsChecked) {
  const fs::path own = certified();
  const TlsFront front(archive.port(), own);
  ServerDescription server = web_by_tls(front.port(), own);
  EXPECT_EQ(refusal_of(server), "");
  server.authorities.clear();
  EXPECT_THAT(refusal_of(server), HasSubstr("certificate")) << "the system did not sign it";
  server.authorities = certified() / "certificate.pem";
  EXPECT_THAT(refusal_of(server), HasSubstr("certificate")) << "another of the same name did not sign it";
  server.authorities = own / "certificate.pem";
  server.url = "https://127.0.0.1:" + std::to_string(front.port()) + "/dicom-web";
  EXPECT_THAT(refusal_of(server), HasSubstr("certificate")) << "it is for localhost";
  server.authorities = own / "missing.pem";
  EXPECT_THAT(refusal_of(server), HasSubstr("authorities"));
}

TEST_F(WebByTls, AServersCertificateThatHasExpiredOrIsNotValidYetIsRefused) {
  for (const CertificateWish& wish :
       {CertificateWish{"localhost", -7200, -3600, {}, {}}, CertificateWish{"localhost", 3600, 7200, {}, {}},
        CertificateWish{"elsewhere.example", -3600, 3600, {}, {}}}) {
    const fs::path own = certified(wish);
    const TlsFront front(archive.port(), own);
    EXPECT_THAT(refusal_of(web_by_tls(front.port(), own)), HasSubstr("has expired"));
    EXPECT_TRUE(archive.requests().empty()) << "something was sent before the certificate was looked at";
  }
}

TEST_F(WebByTls, OneThatAsksForOurCertificateGetsIt) {
  const fs::path own = certified(), issuer = certified();
  const TlsFront front(archive.port(), own, issuer / "certificate.pem");
  const ServerDescription server = web_by_tls(front.port(), own);
  EXPECT_EQ(refusal_of(with_own(server, certified({"us", -3600, 3600, issuer, {}}))), "");
  EXPECT_THAT(refusal_of(server), HasSubstr("asks for a certificate of ours")) << "none was shown";
  EXPECT_THAT(refusal_of(with_own(server, certified({"us", -3600, 3600, {}, {}}))),
              HasSubstr("does not accept the one of `certificate`"))
      << "nobody signed it";
  EXPECT_THAT(refusal_of(with_own(server, certified({"us", -7200, -3600, issuer, {}}))),
              HasSubstr("does not accept the one of `certificate`"))
      << "it has expired";
  EXPECT_EQ(archive.requests().size(), 1u);
}

TEST_F(WebByTls, AnAlertIsToldForWhatItMeans) {
  const char* ours = "or does not accept the one of `certificate`";
  const fs::path trusted = certified();
  for (const auto& [alert, said] :
       {std::pair(40, "no cipher in common"), std::pair(42, ours), std::pair(45, ours), std::pair(48, ours),
        std::pair(49, ours), std::pair(70, "no TLS that is still safe"), std::pair(71, "ciphers"),
        std::pair(80,
                  "not refused, but failed: the server 'archive' has ended the secure connection (TLS "
                  "alert: internal error)"),
        std::pair(112, "does not know the host of url"), std::pair(116, ours)}) {
    const TlsAlarm front(alert);
    EXPECT_THAT(refusal_of(web_by_tls(front.port(), trusted)), HasSubstr(said)) << "alert " << alert;
  }
}

TEST_F(WebByTls, AKeyThatIsEncryptedNeedsItsPasswordAndOneOfAnotherIsRefused) {
  const fs::path own = certified(), issuer = certified();
  const TlsFront front(archive.port(), own, issuer / "certificate.pem");
  const fs::path locked = certified({"us", -3600, 3600, issuer, "open sesame"});
  ServerDescription server = with_own(web_by_tls(front.port(), own), locked);
  EXPECT_EQ(refusal_of(server, {{}, "open sesame"}), "");
  EXPECT_THAT(refusal_of(server, {{}, "wrong"}), HasSubstr("`certificate` or `key`"));
  server.key = issuer / "key.pem";
  EXPECT_THAT(refusal_of(server), HasSubstr("`certificate` or `key`"));
}

TEST_F(WebByTls, AProxyLeadsThroughAndSeesNothing) {
  const fs::path own = certified();
  const TlsFront front(archive.port(), own);
  const Tunnel proxy;
  ServerDescription server = web_by_tls(front.port(), own);
  server.proxy = "http://127.0.0.1:" + std::to_string(proxy.port());
  EXPECT_EQ(refusal_of(server), "");
  EXPECT_EQ(proxy.asked_for(), "CONNECT localhost:" + std::to_string(front.port()) + " HTTP/1.1\n");
  server.authorities = certified() / "certificate.pem";
  EXPECT_THAT(refusal_of(server), HasSubstr("certificate")) << "a proxy makes it no safer";
}

TEST_F(WebByTls, AProxyThatDoesNotLeadThroughIsSaid) {
  const fs::path own = certified();
  for (const auto& [status, said] : {std::pair(407, "a proxy that asks for a login (HTTP 407)"),
                                     std::pair(403, "the proxy does not lead to it (HTTP 403)"),
                                     std::pair(502, "not refused, but failed: ")}) {
    const Tunnel proxy(status);
    ServerDescription server = web_by_tls(archive.port(), own);
    server.proxy = "http://127.0.0.1:" + std::to_string(proxy.port());
    EXPECT_THAT(refusal_of(server), HasSubstr(said));
  }
  ServerDescription server = web_by_tls(archive.port(), own);
  server.proxy = "http://127.0.0.1:" + std::to_string(testing::free_port());
  EXPECT_THAT(refusal_of(server), HasSubstr("not refused, but failed: "));
}

TEST(Proxy, WithoutTlsItAsksInOurPlace) {
  const FakeServer proxy(empty_archive);
  ServerDescription server;
  server.name = "archive";
  server.transport = Transport::dicomweb;
  server.url = "http://archive.invalid/dicom-web";
  server.proxy = "http://127.0.0.1:" + std::to_string(proxy.port());
  EXPECT_EQ(refusal_of(server), "");
  ASSERT_EQ(proxy.requests().size(), 1u);
  EXPECT_THAT(proxy.requests()[0], HasSubstr("GET http://archive.invalid/dicom-web/studies"));
  const FakeServer closed([](const std::string&) { return testing::http_answer(407, "text/plain", ""); });
  server.proxy = "http://127.0.0.1:" + std::to_string(closed.port());
  EXPECT_THAT(refusal_of(server), HasSubstr("a proxy that asks for a login"));
}

TEST(Proxy, TheOneOfTheEnvironmentIsNotAsked) {
  const FakeServer archive(empty_archive), proxy(empty_archive);
  ServerDescription server;
  server.name = "archive";
  server.transport = Transport::dicomweb;
  server.url = "http://127.0.0.1:" + std::to_string(archive.port()) + "/dicom-web";
  ::setenv("http_proxy", ("http://127.0.0.1:" + std::to_string(proxy.port())).c_str(), 1);
  EXPECT_EQ(refusal_of(server), "");
  ::unsetenv("http_proxy");
  EXPECT_TRUE(proxy.requests().empty());
}

/// DCMTK's storage server with TLS, which takes a certificate of `issuer` alone.
struct DimseByTls : ::testing::Test {
  void SetUp() override {
    if (::access("/usr/bin/storescp", X_OK) != 0) GTEST_SKIP() << "needs storescp (dcmtk)";
  }
  const fs::path own = certified(), issuer = certified();
  const int port = testing::free_port();
  std::unique_ptr<StartedProgram> scp;

  ServerDescription started(const fs::path& shown) {
    scp = std::make_unique<StartedProgram>(std::vector<std::string>{
        "storescp", "--ignore", "+tls", (shown / "key.pem").string(), (shown / "certificate.pem").string(),
        "--add-cert-file", (issuer / "certificate.pem").string(), "--require-peer-cert",
        std::to_string(port)});
    EXPECT_TRUE(testing::comes_to_answer(port));
    ServerDescription server;
    server.name = "archive";
    server.host = "localhost";
    server.port = port;
    server.title = "STORESCP";
    server.tls = true;
    server.authorities = shown / "certificate.pem";
    server.attempts = 1;
    return server;
  }
};

TEST_F(DimseByTls, OurCertificateIsShownAndOthersAreRefused) {
  const ServerDescription server = started(own);
  EXPECT_EQ(refusal_of(with_own(server, certified({"us", -3600, 3600, issuer, {}}))), "");
  const auto said = AnyOf(HasSubstr("ours is not accepted"), HasSubstr("does not accept our certificate"));
  EXPECT_THAT(refusal_of(server), said) << "none was shown";
  EXPECT_THAT(refusal_of(with_own(server, certified({"us", -3600, 3600, {}, {}}))), said);
  EXPECT_THAT(refusal_of(with_own(server, certified({"us", -7200, -3600, issuer, {}}))), said);
}

TEST_F(DimseByTls, AServersCertificateThatHasExpiredIsRefused) {
  const fs::path expired = certified({"localhost", -7200, -3600, {}, {}});
  const ServerDescription server = started(expired);
  EXPECT_THAT(refusal_of(with_own(server, certified({"us", -3600, 3600, issuer, {}}))),
              HasSubstr("no secure connection"));
}

TEST_F(DimseByTls, KeysThatCannotBeUsedAreNamed) {
  ServerDescription server = started(own);
  const fs::path locked = certified({"us", -3600, 3600, issuer, "open sesame"});
  server = with_own(server, locked);
  EXPECT_EQ(refusal_of(server, {{}, "open sesame"}), "");
  EXPECT_THAT(refusal_of(server, {{}, "wrong"}), HasSubstr("`key`"));
  server.key = issuer / "key.pem";
  EXPECT_THAT(refusal_of(server), HasSubstr("`key` does not belong to `certificate`"));
}

}  // namespace
}  // namespace ostia::pacs
