#include "output/standard_streams.h"

#include "ostia/core/error.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

/// Options that name a result; the argument after any other is an input.
constexpr std::array<std::string_view, 7> results{"-o",         "--output", "--levelset", "--canal",
                                                  "--sections", "--case",   "--lines"};

bool names_result(const std::string& option) {
  return std::find(results.begin(), results.end(), option) != results.end();
}

/// Options that every command has, and that may stand before it, take a value; the first word else is it.
std::size_t place_of_command(const std::vector<std::string>& arguments) {
  constexpr std::array<std::string_view, 4> with_value{"--threads", "--seed", "--log", "--progress"};
  std::size_t i = 0;
  while (i < arguments.size() && arguments[i].starts_with("-"))
    i += std::find(with_value.begin(), with_value.end(), arguments[i]) == with_value.end() ? 1 : 2;
  return std::min(i, arguments.size());
}

/// What a command writes when nobody says as what; "" for a folder.
std::string usual_output(const std::string& command, const std::vector<std::string>& arguments) {
  static const std::map<std::string, std::string> usual{
      {"import", ".nrrd"},  {"segment", ".vtp"},    {"centerline", ".vtp"}, {"skeleton", ".vtp"},
      {"lumen", ".vtp"},    {"convert", ".vtp"},    {"grow", ".vtp"},       {"extract", ".ostia"},
      {"replay", ".ostia"}, {"reconstruct", ".vtp"}};
  if (command == "segment" && std::find(arguments.begin(), arguments.end(), "--aorta") != arguments.end())
    return ".nrrd";
  const auto found = usual.find(command);
  return found == usual.end() ? "" : found->second;
}

/// "--output=-" as "--output=" and "-".
void split(const std::string& argument, std::string& option, std::string& value) {
  const std::size_t equals = argument.starts_with("--") ? argument.find('=') : std::string::npos;
  option = equals == std::string::npos ? "" : argument.substr(0, equals + 1);
  value = equals == std::string::npos ? argument : argument.substr(equals + 1);
}

bool is_stream(const std::string& value) {
  return value == "-" ||
         (value.size() > 2 && value.starts_with("-.") &&
          std::none_of(value.begin() + 2, value.end(), [](unsigned char c) { return std::isdigit(c) != 0; }));
}

[[noreturn]] void fail_write(const fs::path& file) {
  const std::string why = std::strerror(errno);
  if (errno == ENOSPC) throw ResourceError("the disk is full: " + file.string());
  throw IoError("cannot write " + file.string() + ": " + why);
}

bool is_image(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".nrrd" || extension == ".mha" || extension == ".nii" || extension == ".gz";
}

bool holds(const std::string& head, std::size_t at, std::string_view text) {
  return head.size() >= at + text.size() && std::string_view(head).substr(at, text.size()) == text;
}

}  // namespace

std::string extension_of_content(const std::string& head, std::uintmax_t size) {
  using namespace std::string_view_literals;
  if (holds(head, 0, "NRRD0")) return ".nrrd";
  if (holds(head, 0, "ObjectType") || holds(head, 0, "NDims")) return ".mha";
  if (holds(head, 0, "SQLite format 3")) return ".ostia";
  if (holds(head, 0, "# vtk DataFile")) return ".vtk";
  if (holds(head, 0, "ply")) return ".ply";
  if (holds(head, 0, "PK\x03\x04")) return ".zip";
  if (holds(head, 0, "\x1f\x8b")) return ".nii.gz";
  if (holds(head, 344, "n+1\0"sv) || holds(head, 344, "ni1\0"sv)) return ".nii";
  if (holds(head, 128, "DICM")) return ".dcm";
  if (head.find("<VTKFile") != std::string::npos)
    return head.find("UnstructuredGrid") != std::string::npos ? ".vtu" : ".vtp";
  if (head.size() >= 84) {
    std::uint32_t triangles = 0;
    std::memcpy(&triangles, head.data() + 80, sizeof triangles);
    if (size == 84 + std::uintmax_t{50} * triangles) return ".stl";
  }
  if (holds(head, 0, "solid")) return ".stl";
  if (holds(head, 0, "v ") || head.find("\nv ") != std::string::npos) return ".obj";
  const bool rows = head.find(',') != std::string::npos && head.find('\0') == std::string::npos;
  return rows ? ".csv" : "";
}

StandardStreams::StandardStreams(std::vector<std::string> arguments) : arguments_(std::move(arguments)) {
  const std::size_t command_at = place_of_command(arguments_);
  if (command_at == arguments_.size()) return;
  const std::string command = arguments_[command_at];
  for (std::size_t i = command_at + 1; i < arguments_.size(); ++i) {
    std::string option, value;
    split(arguments_[i], option, value);
    if (!is_stream(value)) continue;
    const std::string before = option.empty() ? arguments_[i - 1] : option.substr(0, option.size() - 1);
    if (before == "--edits") continue;  // reads the stream itself, and may find nothing there
    // `convert` has both names without an option: what stands first is the input.
    const bool result = command == "convert" ? i != command_at + 1 : names_result(before);
    take(result ? output_ : input_, i, option, value, result);
  }
  if (!used()) return;
  const std::string usual = usual_output(command, arguments_);
  if (output_.at != 0 && usual.empty())
    throw UsageError("`ostia " + command + "` writes a folder, which standard output cannot hold; name one");
  folder_ = std::make_unique<core::PrivateFolder>();
  keeps_kind_ = command == "convert" && output_.file == "-";
  if (output_.at != 0) {
    const std::string as = output_.file == "-" ? usual : output_.file.string().substr(1);
    name(output_, folder_->path() / ("standard_output" + as));
  }
  if (input_.at != 0) name(input_, folder_->path() / "standard_input");
}

void StandardStreams::take(Stream& stream, std::size_t at, const std::string& option,
                           const std::string& value, bool result) {
  if (stream.at != 0)
    throw UsageError(std::string("`-` is there twice, and there is one standard ") +
                     (result ? "output" : "input"));
  if (!result && value != "-")
    throw UsageError("`" + value + "` is no name of an input: what `-` brings is told by its first bytes");
  stream = {at, option, value};
}

void StandardStreams::name(Stream& stream, const fs::path& file) {
  stream.file = file;
  arguments_[stream.at] = stream.option + file.string();
}

StandardStreams::~StandardStreams() {
  if (standard_output_ >= 0) {
    std::fflush(stdout);
    ::dup2(standard_output_, STDOUT_FILENO);
    ::close(standard_output_);
  }
}

void StandardStreams::spool_input() {
  if (::isatty(STDIN_FILENO) != 0)
    throw UsageError("`-` reads standard input, and that is the keyboard: join a command or a file to it");
  std::ofstream file(input_.file, std::ios::binary);
  std::vector<char> block(1 << 20);
  std::string head;
  std::uintmax_t size = 0;
  while (true) {
    const ssize_t n = ::read(STDIN_FILENO, block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw IoError(std::string("cannot read standard input: ") + std::strerror(errno));
    if (n == 0) break;
    if (head.size() < 4096) head.append(block.data(), std::min<std::size_t>(n, 4096 - head.size()));
    size += static_cast<std::uintmax_t>(n);
    if (!file.write(block.data(), n)) fail_write(input_.file);
  }
  file.close();
  if (!file) fail_write(input_.file);
  if (size == 0) throw InvalidInput("standard input is empty: the command before it gave nothing");
  const std::string extension = extension_of_content(head, size);
  if (extension.empty())
    throw InvalidInput("standard input holds nothing that is known by its first bytes; name a file instead");
  const fs::path named = input_.file.string() + extension;
  fs::rename(input_.file, named);
  name(input_, named);
}

void StandardStreams::open() {
  if (input_.at != 0) spool_input();
  if (keeps_kind_ && is_image(input_.file)) name(output_, folder_->path() / "standard_output.nrrd");
  if (output_.at == 0) return;
  std::fflush(stdout);
  standard_output_ = ::dup(STDOUT_FILENO);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

void StandardStreams::deliver() {
  if (output_.at == 0) return;
  std::fflush(stdout);
  std::ifstream file(output_.file, std::ios::binary);
  std::vector<char> block(1 << 20);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    for (std::streamsize done = 0; done < file.gcount();) {
      const ssize_t n = ::write(standard_output_, block.data() + done, file.gcount() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) throw IoError(std::string("cannot write standard output: ") + std::strerror(errno));
      done += n;
    }
  }
}

}  // namespace ostia::app
