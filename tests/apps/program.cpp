#include "program.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/phantom/builtin_case.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace ostia::testing {
namespace fs = std::filesystem;
namespace {

int exit_code(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string command_line(const std::vector<std::string>& arguments, const Setting& setting,
                         const fs::path& catcher) {
  std::string line = "cd " + quoted((setting.folder.empty() ? catcher : setting.folder).string()) + " && ";
  // Text of the shell's own has no program to hand over to.
  if (setting.before.find("ulimit") == std::string::npos && setting.before.find('=') == std::string::npos)
    line += "exec ";
  line += setting.before + " " + quoted(OSTIA_PROGRAM);
  for (const std::string& argument : arguments) line += " " + quoted(argument);
  return line;
}

Outcome collected(int code, const fs::path& catcher) {
  return {code, core::read_file(catcher / "out"), core::read_file(catcher / "err")};
}

std::string number(double value) {
  return std::to_string(value);
}

std::string point(const geometry::Vec3& p) {
  return number(p.x()) + "," + number(p.y()) + "," + number(p.z());
}

}  // namespace

std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

Outcome ostia(const std::vector<std::string>& arguments, const Setting& setting) {
  const fs::path catcher = temporary_folder("run");
  const std::string line = "( " + command_line(arguments, setting, catcher) + " ) >" +
                           quoted((catcher / "out").string()) + " 2>" + quoted((catcher / "err").string()) +
                           " </dev/null";
  return collected(exit_code(std::system(line.c_str())), catcher);
}

Outcome interrupted(const std::vector<std::string>& arguments, const Setting& setting, int signal,
                    double seconds, double& seconds_to_end) {
  const fs::path catcher = temporary_folder("run");
  const std::string line = "exec >" + quoted((catcher / "out").string()) + " 2>" +
                           quoted((catcher / "err").string()) + "; " +
                           command_line(arguments, setting, catcher);
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  ::kill(child, signal);
  const auto start = std::chrono::steady_clock::now();
  int status = 0;
  ::waitpid(child, &status, 0);
  seconds_to_end = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return collected(exit_code(status), catcher);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.push_back(fs::relative(entry.path(), folder).string());
  std::sort(names.begin(), names.end());
  return names;
}

SmallCase small_case(const std::string& image_name) {
  phantom::BuiltinOptions options;
  options.spacing_mm = 0.6;
  const phantom::BuiltinCase made = phantom::make_builtin_case(options);
  SmallCase out;
  out.folder = temporary_folder("case");
  out.image = out.folder / image_name;
  imaging::write_image(out.image, made.image);
  // Points well inside the vessels: a coarse image blurs their ends.
  const auto on_axis = [&](std::size_t tube, double part) {
    const auto& points = made.truth.tubes[tube].axis.points;
    return points[static_cast<std::size_t>(part * static_cast<double>(points.size() - 1))];
  };
  for (const std::size_t tube : {0u, 1u}) {
    const geometry::Vec3 from = on_axis(0, 0.06), to = on_axis(tube, 0.9);
    const auto ras = [](const geometry::Vec3& p) { return geometry::Vec3(-p.x(), -p.y(), p.z()); };
    const auto ijk = [&](const geometry::Vec3& p) { return made.image.geometry.index(p); };
    out.branch_arguments.insert(out.branch_arguments.end(), {"--branch", point(from) + ":" + point(to)});
    out.branch_arguments_ras.insert(out.branch_arguments_ras.end(),
                                    {"--branch", point(ras(from)) + ":" + point(ras(to))});
    out.branch_arguments_ijk.insert(out.branch_arguments_ijk.end(),
                                    {"--branch", point(ijk(from)) + ":" + point(ijk(to))});
  }
  return out;
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace ostia::testing
