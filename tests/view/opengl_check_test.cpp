#include "ostia/view/opengl_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace ostia::view {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Another value of an environment variable while it lives; null: none.
class With {
 public:
  With(const char* name, const char* value) : name_(name) {
    if (const char* former = std::getenv(name)) former_ = former;
    set(value);
  }
  ~With() { set(former_ ? former_->c_str() : nullptr); }
  With(const With&) = delete;
  With& operator=(const With&) = delete;

 private:
  void set(const char* value) {
    if (value == nullptr)
      ::unsetenv(name_);
    else
      ::setenv(name_, value, 1);
  }
  const char* name_;
  std::optional<std::string> former_;
};

std::string all_is_well_or_text() {
  const auto trouble = check_opengl();
  return trouble ? trouble->text() : "";
}

TEST(OpenGlCheckGui, ThisDisplayWillDo) {
  EXPECT_EQ(all_is_well_or_text(), "");
}

TEST(OpenGlCheckGui, SaysSoWithoutADisplay) {
  for (const char* display : {static_cast<const char*>(nullptr), "", ":4999"}) {
    const With none("DISPLAY", display);
    const auto trouble = check_opengl();
    ASSERT_TRUE(trouble);
    EXPECT_THAT(trouble->text(), AllOf(HasSubstr("no X display"), HasSubstr("OpenGL 3.2")));
    EXPECT_FALSE(trouble->has_display);
  }
  EXPECT_EQ(all_is_well_or_text(), "") << "asking in vain spoilt the process";
}

// Mesa's drivers say of themselves what they are told to.
TEST(OpenGlCheckGui, ADisplayWithAnOlderOpenGlCanStillShowAWindow) {
  for (const char* version : {"2.1", "3.1"}) {
    const With old("MESA_GL_VERSION_OVERRIDE", version);
    const auto trouble = check_opengl();
    ASSERT_TRUE(trouble) << version;
    EXPECT_EQ(trouble->reason, "The display's OpenGL is older than 3.2.") << version;
    EXPECT_THAT(trouble->way_out, HasSubstr("LIBGL_ALWAYS_SOFTWARE=1"));
    EXPECT_TRUE(trouble->has_display) << version;
  }
  const With enough("MESA_GL_VERSION_OVERRIDE", "3.2");
  EXPECT_EQ(all_is_well_or_text(), "");
}

}  // namespace
}  // namespace ostia::view
