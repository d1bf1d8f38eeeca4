#include "ostia/cohort/pseudonym.h"

#include "ostia/core/error.h"

#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <sys/random.h>

#include <array>

namespace ostia::cohort {
namespace {

constexpr std::size_t key_bytes = 32;
constexpr std::size_t pseudonym_digits = 20;

std::string hexadecimal(const unsigned char* bytes, std::size_t count) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    text += digits[bytes[i] >> 4];
    text += digits[bytes[i] & 15];
  }
  return text;
}

int value_of_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

}  // namespace

std::string hmac_sha256(std::string_view key, std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned int size = 0;
  if (!HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()),
            reinterpret_cast<const unsigned char*>(text.data()), text.size(), bytes.data(), &size))
    throw Error("the keyed hash failed");
  return hexadecimal(bytes.data(), size);
}

std::string new_key() {
  std::array<unsigned char, key_bytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error("the system gives no random numbers for a key");
  return hexadecimal(bytes.data(), bytes.size());
}

Pseudonyms::Pseudonyms(std::string_view key_hex) {
  if (key_hex.size() != 2 * key_bytes) throw InvalidInput("a key has 64 hexadecimal digits");
  for (std::size_t i = 0; i < key_hex.size(); i += 2) {
    const int high = value_of_digit(key_hex[i]), low = value_of_digit(key_hex[i + 1]);
    if (high < 0 || low < 0) throw InvalidInput("a key has 64 hexadecimal digits, 0 to 9 and a to f");
    key_ += static_cast<char>(16 * high + low);
  }
}

std::string Pseudonyms::of(std::string_view name) const {
  return "p-" + hmac_sha256(key_, name).substr(0, pseudonym_digits);
}

}  // namespace ostia::cohort
