#pragma once
/// \file Names that name nobody: a keyed hash of what a scan or a patient is called.

#include <filesystem>
#include <string>
#include <string_view>

namespace ostia::cohort {

/// HMAC-SHA-256 (RFC 2104, FIPS 198-1) as lower-case hexadecimal.
std::string hmac_sha256(std::string_view key, std::string_view text);

/// 32 bytes of the system's randomness as 64 hexadecimal digits. Throws Error where there are none.
std::string new_key();

/// Who has the key can make a name's pseudonym again and nobody can go back from it; without the key a list
/// of all names that there may be does not help either.
class Pseudonyms {
 public:
  /// `key_hex`: 64 hexadecimal digits. Throws InvalidInput for anything else.
  explicit Pseudonyms(std::string_view key_hex);
  /// "p-" and the first 20 hexadecimal digits (80 bits) of the name's keyed hash.
  std::string of(std::string_view name) const;

 private:
  std::string key_;
};

}  // namespace ostia::cohort
