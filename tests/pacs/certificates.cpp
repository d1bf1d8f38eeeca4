#include "certificates.h"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/rsa.h>
#include <openssl/x509v3.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace ostia::testing {
namespace {

using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File opened(const std::filesystem::path& path, const char* mode) {
  File file(std::fopen(path.c_str(), mode), [](std::FILE* one) { return one ? std::fclose(one) : 0; });
  if (!file) throw std::runtime_error("cannot open " + path.string());
  return file;
}

void extend(X509* certificate, X509* issuer, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const std::unique_ptr<X509_EXTENSION, decltype(&X509_EXTENSION_free)> extension(
      X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()), &X509_EXTENSION_free);
  if (!extension) throw std::runtime_error("no extension " + value);
  X509_add_ext(certificate, extension.get(), -1);
}

}  // namespace

void make_certificate(const std::filesystem::path& folder, const CertificateWish& wish) {
  const Key key(EVP_RSA_gen(2048), &EVP_PKEY_free);
  const Certificate certificate(X509_new(), &X509_free);
  X509_set_version(certificate.get(), 2);
  std::uint64_t serial = 0;
  RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial);
  ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate.get()), serial >> 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), wish.begins_s);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), wish.ends_s);
  X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate.get()), "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>(wish.name.c_str()), -1, -1, 0);
  X509_set_pubkey(certificate.get(), key.get());

  Key signing(nullptr, &EVP_PKEY_free);
  Certificate issuer(nullptr, &X509_free);
  if (!wish.issuer.empty()) {
    signing.reset(PEM_read_PrivateKey(opened(wish.issuer / "key.pem", "r").get(), nullptr, nullptr, nullptr));
    issuer.reset(
        PEM_read_X509(opened(wish.issuer / "certificate.pem", "r").get(), nullptr, nullptr, nullptr));
    if (!signing || !issuer) throw std::runtime_error("the issuer cannot be read");
  }
  X509* by = issuer ? issuer.get() : certificate.get();
  X509_set_issuer_name(certificate.get(), X509_get_subject_name(by));
  extend(certificate.get(), by, NID_basic_constraints, issuer ? "CA:FALSE" : "critical,CA:TRUE");
  extend(certificate.get(), by, NID_subject_alt_name, "DNS:" + wish.name);
  if (X509_sign(certificate.get(), signing ? signing.get() : key.get(), EVP_sha256()) == 0)
    throw std::runtime_error("cannot sign a certificate");

  const std::string& password = wish.key_password;
  PEM_write_PrivateKey(opened(folder / "key.pem", "w").get(), key.get(),
                       password.empty() ? nullptr : EVP_aes_256_cbc(),
                       reinterpret_cast<const unsigned char*>(password.data()),
                       static_cast<int>(password.size()), nullptr, nullptr);
  PEM_write_X509(opened(folder / "certificate.pem", "w").get(), certificate.get());
}

}  // namespace ostia::testing
