#include "ostia/view/opengl_check.h"

#include <dlfcn.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string_view>

namespace ostia::view {
namespace {

// What Xlib and GLX look like, as far as it is needed: the libraries are opened by name, so that a machine
// without them gets a sentence and not a loader's error.
using Display = void;
using Config = void*;
using Context = void*;
using ErrorHandler = int (*)(Display*, void*);

constexpr int glx_render_type = 0x8011, glx_rgba_bit = 1, glx_drawable_type = 0x8010, glx_window_bit = 1;
constexpr int glx_major = 0x2091, glx_minor = 0x2092, glx_profile = 0x9126, glx_core_bit = 1;

constexpr const char* way_out =
    "Ostia's window needs OpenGL 3.2: update the graphics driver, or draw without the graphics card (install "
    "Mesa's software renderer, package libgl1-mesa-dri, and start with LIBGL_ALWAYS_SOFTWARE=1). The command "
    "line "
    "program ostia needs no display.";

constexpr char display_there = '\1', all_well = '\2';  // what the child says beside sentences

void tell(int pipe, std::string_view text) {
  if (::write(pipe, text.data(), text.size()) != static_cast<ssize_t>(text.size())) ::_exit(1);
}

template <class Function>
Function symbol(void* library, const char* name) {
  return reinterpret_cast<Function>(::dlsym(library, name));
}

/// In the child alone: "" when a context was made. Tells at once that there is a display, since drivers may
/// end the process.
std::string_view probe(int pipe) {
  void* x11 = ::dlopen("libX11.so.6", RTLD_NOW);
  if (x11 == nullptr) return "The library libX11.so.6 is not installed.";
  const auto open = symbol<Display* (*)(const char*)>(x11, "XOpenDisplay");
  const auto set_handler = symbol<ErrorHandler (*)(ErrorHandler)>(x11, "XSetErrorHandler");
  const auto screen_of = symbol<int (*)(Display*)>(x11, "XDefaultScreen");
  const auto sync = symbol<int (*)(Display*, int)>(x11, "XSync");
  if (!open || !set_handler || !screen_of || !sync) return "The library libX11.so.6 is damaged.";
  Display* display = open(nullptr);
  if (display == nullptr) return "There is no X display to open a window on (is DISPLAY set?).";
  tell(pipe, {&display_there, 1});
  void* gl = ::dlopen("libGL.so.1", RTLD_NOW);
  if (gl == nullptr) return "The library libGL.so.1 is not installed.";
  const auto choose = symbol<Config* (*)(Display*, int, const int*, int*)>(gl, "glXChooseFBConfig");
  const auto address = symbol<void (*(*)(const unsigned char*))()>(gl, "glXGetProcAddressARB");
  if (!choose || !address) return "The installed OpenGL library has no GLX.";
  set_handler([](Display*, void*) { return 0; });
  const std::array<int, 5> wanted{glx_render_type, glx_rgba_bit, glx_drawable_type, glx_window_bit, 0};
  int count = 0;
  Config* configs = choose(display, screen_of(display), wanted.data(), &count);
  if (configs == nullptr || count == 0) return "The display offers no OpenGL.";
  using Create = Context (*)(Display*, Config, Context, int, const int*);
  const auto create =
      reinterpret_cast<Create>(address(reinterpret_cast<const unsigned char*>("glXCreateContextAttribsARB")));
  if (create == nullptr) return "The display's OpenGL is older than 3.0.";
  const std::array<int, 7> attributes{glx_major, 3, glx_minor, 2, glx_profile, glx_core_bit, 0};
  Context context = create(display, configs[0], nullptr, 1, attributes.data());
  sync(display, 0);
  if (context == nullptr) return "The display's OpenGL is older than 3.2.";
  return "";
}

/// What the child says, until it ends or the time is up.
std::string read_all(int pipe, std::chrono::milliseconds patience, bool& in_time) {
  const auto until = std::chrono::steady_clock::now() + patience;
  std::string text;
  std::array<char, 256> buffer{};
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    pollfd waiting{pipe, POLLIN, 0};
    const int ready = left.count() > 0 ? ::poll(&waiting, 1, static_cast<int>(left.count())) : 0;
    if (ready < 0 && errno == EINTR) continue;
    in_time = ready > 0;
    if (!in_time) return text;
    const ssize_t got = ::read(pipe, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

[[noreturn]] void answer_as_child(int pipe) {
  const std::string_view said = probe(pipe);
  tell(pipe, said.empty() ? std::string_view(&all_well, 1) : said);
  ::_exit(0);
}

/// Of what the child said: nothing where all is well.
std::optional<OpenGlTrouble> trouble_of(std::string said, bool in_time) {
  OpenGlTrouble trouble;
  trouble.way_out = way_out;
  trouble.has_display = !said.empty() && said.front() == display_there;
  if (trouble.has_display) said.erase(0, 1);
  if (!said.empty() && said.front() == all_well) return {};
  if (!in_time)
    trouble.reason =
        trouble.has_display ? "The graphics driver does not answer." : "The display does not answer.";
  else if (said.empty())
    trouble.reason = "The graphics driver failed when it was asked for a window.";
  else
    trouble.reason = said;
  return trouble;
}

}  // namespace

std::optional<OpenGlTrouble> check_opengl() {
  std::array<int, 2> ends{-1, -1};
  if (::pipe(ends.data()) != 0)
    return OpenGlTrouble{"No pipe can be made to ask the display.", "Too many files are open.", false};
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    answer_as_child(ends[1]);
  }
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    return OpenGlTrouble{"No process can be made to ask the display.",
                         "The system's limit of processes is reached.", false};
  }
  bool in_time = true;
  const std::string answer = read_all(ends[0], std::chrono::seconds(10), in_time);
  ::close(ends[0]);
  if (!in_time) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return trouble_of(answer, in_time);
}

}  // namespace ostia::view
