#include "foreign_source.h"

#include "image_data.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/private_folder.h"
#include "ostia/core/text.h"
#include "ostia/core/worker_program.h"
#include "ostia/imaging/foreign_image.h"

#include <array>
#include <csignal>
#include <cstdint>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

std::uint32_t big_endian_word(const std::string& head, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(head[at + i]);
  return value;
}

bool is_gipl(const std::string& head) {
  if (head.size() < 256) return false;
  const std::uint32_t mark = big_endian_word(head, 252);
  return mark == 719555000U || mark == 4026526128U;
}

/// Not where the same bytes are a DICOM file, too.
bool is_tiff(const std::string& head) {
  if (head.size() > 132 && head.compare(128, 4, "DICM") == 0) return false;
  for (const std::string_view mark : {std::string_view("II*\0", 4), std::string_view("MM\0*", 4),
                                      std::string_view("II+\0", 4), std::string_view("MM\0+", 4)})
    if (head.rfind(mark, 0) == 0) return true;
  return false;
}

bool is_vtk_image(const std::string& head) {
  return head.rfind("# vtk DataFile", 0) == 0 &&
         lower_case(head.substr(0, 4096)).find("structured_points") != std::string::npos;
}

/// A header of NIfTI's size without NIfTI's mark.
bool is_analyze(const std::string& head) {
  if (head.size() < 348) return false;
  const std::uint32_t size = big_endian_word(head, 0);
  return (size == 348U || size == 0x5c010000U) && head.compare(344, 2, "n+") != 0 &&
         head.compare(344, 2, "ni") != 0;
}

bool is_hdf5(const fs::path& path, const std::string& head) {
  const std::string end = lower_case(path.extension().string());
  return head.rfind("\x89HDF\r\n\x1a\n", 0) == 0 && (end == ".h5" || end == ".hdf5");
}

/// What the format leaves open.
std::string left_open(const std::string& format, const Mat3& step) {
  const auto mm = [&](int axis) { return core::significant_text(step.col(axis).norm(), 4) + " mm"; };
  if (format == "TIFF")
    return "a TIFF stack does not say how far apart its slices are, nor where it lies: 1 mm was taken, at 0, "
           "0, 0, and " +
           mm(0) + " x " + mm(1) + " for its pixels";
  if (format == "Analyze")
    return "an Analyze file does not say which side is left: its axes were taken as ITK takes them";
  if (format == "HDF5 image") return "";
  return "a " + format + " file does not say how its axes run: they were taken as left, posterior, superior";
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of("\r\n ");
  if (end == std::string::npos) return "";
  const std::size_t start = text.rfind('\n', end);
  return text.substr(start == std::string::npos ? 0 : start + 1,
                     end - (start == std::string::npos ? 0 : start + 1) + 1);
}

void check_reader(const core::ChildResult& result, const fs::path& path, const std::string& format) {
  if (result.ok()) return;
  const std::string start = path.string() + ": format: cannot read this " + format + " file: ";
  const std::string words = last_line(result.standard_error);
  if (result.out_of_time || result.signal == SIGKILL)
    throw ResourceError(start + "its reader " + result.describe());
  if (result.signal != 0) throw InvalidInput(start + "its reader " + result.describe());
  const std::string why = words.empty() ? result.describe() : words;
  if (result.exit_code == static_cast<int>(ExitCode::resources)) throw ResourceError(start + why);
  throw InvalidInput(start + why);
}

/// Parsed by our own code, whose refusals shall name the file that was given.
ImageSource parsed_as_given(const fs::path& made, const fs::path& given) {
  bool compressed = false;
  try {
    return parse_nrrd(made, file_head(made, max_header_bytes, compressed));
  } catch (const InvalidInput& error) {
    const std::string text = error.what(), name = made.string();
    throw InvalidInput(given.string() + (text.rfind(name, 0) == 0 ? text.substr(name.size()) : ": " + text));
  }
}

}  // namespace

std::string foreign_format_of(const fs::path& path, const std::string& head) {
  if (is_gipl(head)) return "GIPL";
  if (is_tiff(head)) return "TIFF";
  if (is_vtk_image(head)) return "VTK image";
  if (is_hdf5(path, head)) return "HDF5 image";
  if (is_analyze(head)) return "Analyze";
  return "";
}

std::string foreign_image_format(const fs::path& given) {
  fs::path path = given;
  if (lower_case(path.extension().string()) == ".img") path.replace_extension(".hdr");
  try {
    if (regular_file_size(path) == 0) return "";
    bool compressed = false;
    return foreign_format_of(path, file_head(path, 4096, compressed));
  } catch (const Error&) {
    return "";
  }
}

ImageSource read_foreign_source(const fs::path& path, const std::string& format) {
  const auto folder = std::make_shared<const core::PrivateFolder>();
  const fs::path made = folder->path() / "image.nrrd";
  core::ChildLimits limits;
  limits.memory_bytes = 8ULL << 30;
  check_reader(core::run_child(core::worker_program(),
                               {"read-image", fs::absolute(path).string(), made.string()}, limits),
               path, format);
  ImageSource source = parsed_as_given(made, path);
  source.kept = folder;
  source.format = format;
  source.header_path = path;
  if (const std::string open = left_open(format, source.step); !open.empty()) source.warnings.push_back(open);
  return source;
}

}  // namespace ostia::imaging
