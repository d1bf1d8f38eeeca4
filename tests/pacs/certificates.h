#pragma once
/// \file Keys and certificates for tests.

#include <filesystem>
#include <string>

namespace ostia::testing {

struct CertificateWish {
  std::string name = "localhost";              ///< the host that it is for
  long begins_s = -3600, ends_s = 24L * 3600;  ///< valid, from now
  std::filesystem::path issuer{};              ///< folder of the one that signs it; empty: it does so itself
  std::string key_password{};                  ///< of the key's file; empty: not encrypted
};
/// `key.pem` and `certificate.pem` in a folder that is there, RSA with 2048 bits.
void make_certificate(const std::filesystem::path& folder, const CertificateWish& wish = {});

}  // namespace ostia::testing
