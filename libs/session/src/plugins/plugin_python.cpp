#include "plugins/plugin_python.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"

#include <charconv>
#include <cstdlib>
#include <fstream>
#include <future>
#include <sstream>
#include <system_error>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

constexpr auto look_again = std::chrono::milliseconds(50);

fs::path python_program() {
  if (const char* given = std::getenv("OSTIA_PYTHON"); given && *given) return given;
  if (fs::exists("/usr/bin/python3")) return "/usr/bin/python3";
  return core::program_on_path("python3").value_or(fs::path());
}

/// That of the tree that the running program belongs to, else of $PYTHONPATH.
fs::path package_folder() {
  std::error_code ignored;
  const fs::path above = fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
  std::vector<fs::path> places{above / "python", above / "lib" / "python3" / "dist-packages"};
  const char* more = std::getenv("PYTHONPATH");
  std::istringstream folders(more ? more : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty()) places.push_back(fs::absolute(folder, ignored));
  for (const fs::path& place : places)
    if (fs::exists(place / "ostia" / "plugin.py", ignored)) return place;
  return {};
}

void follow_progress(const fs::path& file, const core::TaskContext& task) {
  std::ifstream in(file);
  std::string number, stage;
  if (!std::getline(in, number)) return;
  double fraction = 0.0;
  if (std::from_chars(number.data(), number.data() + number.size(), fraction).ec == std::errc())
    task.set_progress(fraction);
  if (std::getline(in, stage) && !stage.empty()) task.set_stage(stage);
}

}  // namespace

PluginPython plugin_python() {
  PluginPython python{python_program(), package_folder()};
  std::error_code ignored;
  if (!fs::exists(python.program, ignored))
    throw IoError(python.program.empty()
                      ? "plug-ins need Python 3, which is not there; install python3-ostia, which brings it"
                      : "plug-ins need Python 3, and the one that OSTIA_PYTHON names (" +
                            python.program.string() + ") is not there");
  if (python.package.empty())
    throw IoError(
        "plug-ins need Ostia's package for Python, which is not there; install python3-ostia, or "
        "build ostia_python");
  return python;
}

PythonRun run_python(const PluginPython& python, const std::vector<std::string>& words,
                     std::chrono::seconds limit, const fs::path& folder, const core::TaskContext& task) {
  core::ChildLimits limits;
  limits.memory_bytes = std::uint64_t{1} << 46;  // address space: graphics cards' libraries take much of it
  limits.cpu_time = std::chrono::hours(240);     // of all threads together; `limit` is the clock's
  const core::TaskContext own;
  const auto began = std::chrono::steady_clock::now();
  std::future<core::ChildResult> child =
      std::async(std::launch::async, [&] { return core::run_child(python.program, words, limits, own); });
  bool late = false;
  while (child.wait_for(look_again) != std::future_status::ready) {
    late = late || std::chrono::steady_clock::now() - began > limit;
    if (late || task.cancelled()) own.cancel();
    follow_progress(folder / "progress", task);
  }
  try {
    const core::ChildResult result = child.get();
    return {result.standard_error, result.ok() ? "" : result.describe()};
  } catch (const Cancelled&) {
    task.throw_if_cancelled();
    throw ResourceError("it took longer than " + std::to_string(limit.count()) +
                        " s and was ended; give it more time, or less to do");
  }
}

}  // namespace ostia::session
