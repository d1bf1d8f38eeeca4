#include "ostia/view/opengl_check.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace ostia::view {
namespace {

/// Another value of an environment variable while it lives.
class WithDisplay {
 public:
  explicit WithDisplay(const char* value) {
    if (const char* former = std::getenv("DISPLAY")) former_ = former;
    if (value == nullptr)
      ::unsetenv("DISPLAY");
    else
      ::setenv("DISPLAY", value, 1);
  }
  ~WithDisplay() { ::setenv("DISPLAY", former_.c_str(), 1); }
  WithDisplay(const WithDisplay&) = delete;
  WithDisplay& operator=(const WithDisplay&) = delete;

 private:
  std::string former_;
};

TEST(OpenGlCheckGui, ThisDisplayWillDo) {
  EXPECT_EQ(check_opengl(), std::nullopt);
}

TEST(OpenGlCheckGui, SaysSoWithoutADisplay) {
  for (const char* display : {static_cast<const char*>(nullptr), "", ":4999"}) {
    const WithDisplay none(display);
    const auto message = check_opengl();
    ASSERT_TRUE(message);
    EXPECT_NE(message->find("no X display"), std::string::npos) << *message;
    EXPECT_NE(message->find("OpenGL 3.2"), std::string::npos) << *message;
  }
  EXPECT_EQ(check_opengl(), std::nullopt) << "asking in vain spoilt the process";
}

}  // namespace
}  // namespace ostia::view
