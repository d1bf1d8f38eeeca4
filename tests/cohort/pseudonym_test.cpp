#include "ostia/cohort/pseudonym.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::cohort {
namespace {

// RFC 4231, test cases 1, 2, 3 and 6.
TEST(Pseudonyms, TheKeyedHashIsThatOfRfc4231) {
  EXPECT_EQ(hmac_sha256(std::string(20, '\x0b'), "Hi There"),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hmac_sha256("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hmac_sha256(std::string(20, '\xaa'), std::string(50, '\xdd')),
            "773ea91e36800e46854db8ebd09181a72959098b3ef8c122d9635514ced565fe");
  EXPECT_EQ(hmac_sha256(std::string(131, '\xaa'), "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

TEST(Pseudonyms, AreTheKeysAndTheNamesAlone) {
  const Pseudonyms one(std::string(64, '0')), same(std::string(64, '0')), other(std::string(63, '0') + "1");
  EXPECT_EQ(one.of("Jane Doe"), same.of("Jane Doe"));
  EXPECT_NE(one.of("Jane Doe"), other.of("Jane Doe"));
  EXPECT_NE(one.of("Jane Doe"), one.of("Jane Do"));
  EXPECT_EQ(one.of("Jane Doe"), "p-" + hmac_sha256(std::string(32, '\0'), "Jane Doe").substr(0, 20));
}

TEST(Pseudonyms, AKeyIsNewEachTimeAndWhatIsNoneIsRefused) {
  const std::string key = new_key();
  EXPECT_NE(key, new_key());
  EXPECT_NO_THROW(Pseudonyms{key});
  EXPECT_THROW(Pseudonyms{""}, InvalidInput);
  EXPECT_THROW(Pseudonyms{key.substr(1)}, InvalidInput);
  EXPECT_THROW(Pseudonyms{key.substr(1) + "g"}, InvalidInput);
}

}  // namespace
}  // namespace ostia::cohort
