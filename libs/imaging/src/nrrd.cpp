#include "image_data.h"
#include "image_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

// The format: "Definition of NRRD File Format", teem.sourceforge.net/nrrd/format.html.

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

struct NrrdType {
  const char* name;
  PixelType type;
};
constexpr NrrdType nrrd_types[] = {{"signed char", PixelType::int8},
                                   {"int8", PixelType::int8},
                                   {"int8_t", PixelType::int8},
                                   {"uchar", PixelType::uint8},
                                   {"unsigned char", PixelType::uint8},
                                   {"uint8", PixelType::uint8},
                                   {"uint8_t", PixelType::uint8},
                                   {"short", PixelType::int16},
                                   {"short int", PixelType::int16},
                                   {"signed short", PixelType::int16},
                                   {"signed short int", PixelType::int16},
                                   {"int16", PixelType::int16},
                                   {"int16_t", PixelType::int16},
                                   {"ushort", PixelType::uint16},
                                   {"unsigned short", PixelType::uint16},
                                   {"unsigned short int", PixelType::uint16},
                                   {"uint16", PixelType::uint16},
                                   {"uint16_t", PixelType::uint16},
                                   {"int", PixelType::int32},
                                   {"signed int", PixelType::int32},
                                   {"int32", PixelType::int32},
                                   {"int32_t", PixelType::int32},
                                   {"uint", PixelType::uint32},
                                   {"unsigned int", PixelType::uint32},
                                   {"uint32", PixelType::uint32},
                                   {"uint32_t", PixelType::uint32},
                                   {"longlong", PixelType::int64},
                                   {"long long", PixelType::int64},
                                   {"long long int", PixelType::int64},
                                   {"signed long long", PixelType::int64},
                                   {"signed long long int", PixelType::int64},
                                   {"int64", PixelType::int64},
                                   {"int64_t", PixelType::int64},
                                   {"ulonglong", PixelType::uint64},
                                   {"unsigned long long", PixelType::uint64},
                                   {"unsigned long long int", PixelType::uint64},
                                   {"uint64", PixelType::uint64},
                                   {"uint64_t", PixelType::uint64},
                                   {"float", PixelType::float32},
                                   {"double", PixelType::float64}};

/// The fields of the header and where the data begin in this file (its end where there is no blank line).
struct NrrdHeader {
  HeaderFields fields;
  std::size_t end = 0;
  bool blank_line = false;
};

NrrdHeader split_header(const fs::path& path, const std::string& head) {
  NrrdHeader header{HeaderFields(path)};
  std::size_t at = 0;
  for (bool first = true; at < head.size(); first = false) {
    const std::size_t stop = std::min(head.find('\n', at), head.size());
    std::string_view line = std::string_view(head).substr(at, stop - at);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at = std::min(stop + 1, head.size());
    if (first) {
      if (line.size() != 8 || line[4] != '0' || line[5] != '0' || line[6] != '0' || line[7] < '1' ||
          line[7] > '5')
        refuse(path, "magic",
               "'" + std::string(line.substr(0, 12)) + "' is not a NRRD version from NRRD0001 to NRRD0005");
      continue;
    }
    if (line.empty()) {
      header.blank_line = true;
      break;
    }
    if (line.front() == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos)
      refuse(path, "header", "the line '" + std::string(line.substr(0, 60)) + "' has no colon");
    if (line.substr(colon, 2) == ":=") continue;  // key and value: for people, not for readers
    header.fields.add(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
  }
  header.end = at;
  if (!header.blank_line && head.size() >= max_header_bytes)
    refuse(path, "header", "no blank line ends it within " + std::to_string(max_header_bytes) + " bytes");
  return header;
}

PixelType nrrd_pixel_type(const fs::path& path, const HeaderFields& fields) {
  const std::string name = lower_case(fields.require("type"));
  for (const NrrdType& known : nrrd_types)
    if (name == known.name) return known.type;
  refuse(path, "type", "'" + name + "' is not a scalar type that can be read");
}

/// Which of the file's axes are the three of space: all, or all but one of a single voxel.
std::vector<std::size_t> spatial_axes(const fs::path& path, const std::vector<std::int64_t>& sizes,
                                      const std::vector<std::optional<Vec3>>& directions) {
  std::vector<std::size_t> axes;
  if (!directions.empty()) {
    for (std::size_t axis = 0; axis < sizes.size(); ++axis)
      if (directions[axis])
        axes.push_back(axis);
      else if (sizes[axis] != 1)
        refuse(path, "space directions",
               "axis " + std::to_string(axis) + " has no direction and " + std::to_string(sizes[axis]) +
                   " samples a voxel; one scalar volume is read (of a segmentation with segments that "
                   "overlap, save a label map without overlap, or one segment at a time)");
    if (axes.size() != 3) refuse(path, "space directions", "three axes with a direction are needed");
    return axes;
  }
  for (std::size_t axis = 0; axis < sizes.size(); ++axis) axes.push_back(axis);
  if (axes.size() == 4) {
    if (sizes[3] == 1)
      axes.pop_back();
    else if (sizes[0] == 1)
      axes.erase(axes.begin());
    else
      refuse(path, "sizes",
             "four dimensions, none of them of size 1 at either end; one scalar volume is read");
  }
  return axes;
}

/// "(1,0,0) none (0,1,0) ...".
std::vector<std::optional<Vec3>> vectors(const fs::path& path, const std::string& field,
                                         const std::string& text, std::size_t count) {
  std::vector<std::optional<Vec3>> result;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \t", at)) != std::string::npos) {
    if (text[at] != '(') {
      const std::size_t end = std::min(text.find_first_of(" \t(", at), text.size());
      if (lower_case(text.substr(at, end - at)) != "none")
        refuse(path, field, "'" + text + "' is no list of vectors");
      result.emplace_back();
      at = end;
      continue;
    }
    const std::size_t close = text.find(')', at);
    if (close == std::string::npos) refuse(path, field, "'" + text + "' lacks a closing parenthesis");
    std::string inside = text.substr(at + 1, close - at - 1);
    const auto commas = std::count(inside.begin(), inside.end(), ',');
    std::replace(inside.begin(), inside.end(), ',', ' ');
    const auto parts = words(inside);
    if (parts.size() != 3 || commas != 2)
      refuse(path, field, "'" + text + "' is not made of vectors of three numbers");
    Vec3 v;
    for (int i = 0; i < 3; ++i) {
      const auto number = to_double(parts[static_cast<std::size_t>(i)]);
      if (!number)
        refuse(path, field, "'" + std::string(parts[static_cast<std::size_t>(i)]) + "' is not a number");
      v[i] = *number;
    }
    result.emplace_back(v);
    at = close + 1;
  }
  if (result.size() != count)
    refuse(path, field, "has " + std::to_string(result.size()) + " vectors, needs " + std::to_string(count));
  return result;
}

/// The signs that turn the file's space into LPS.
Vec3 to_lps(const fs::path& path, const HeaderFields& fields, std::vector<std::string>& warnings) {
  const std::string* given = fields.find("space");
  if (!given) {
    if (fields.find("space dimension") && fields.integer("space dimension") != 3)
      refuse(path, "space dimension", "must be 3");
    warnings.push_back("no field 'space': the axes are taken as left-posterior-superior");
    return Vec3::Ones();
  }
  const std::string space = lower_case(*given);
  if (space == "left-posterior-superior" || space == "lps") return Vec3::Ones();
  if (space == "right-anterior-superior" || space == "ras") return {-1.0, -1.0, 1.0};
  if (space == "left-anterior-superior" || space == "las") return {1.0, -1.0, 1.0};
  if (space == "scanner-xyz" || space == "3d-right-handed") {
    warnings.push_back("space '" + space +
                       "' does not say where the patient lies: taken as left-posterior-superior");
    return Vec3::Ones();
  }
  refuse(path, "space", "'" + *given + "' is not read; LPS, RAS, LAS, scanner-xyz and 3D-right-handed are");
}

/// Millimetres per unit of `"mm" "um" ...`; they must be the same for all axes.
double unit_mm(const fs::path& path, const HeaderFields& fields, const std::string& field) {
  const std::string* text = fields.find(field);
  if (!text) return 1.0;
  double result = 0.0;
  for (std::size_t open = text->find('"'); open != std::string::npos; open = text->find('"', open)) {
    const std::size_t close = text->find('"', open + 1);
    if (close == std::string::npos) refuse(path, field, "'" + *text + "' lacks a closing quote");
    const std::string unit = text->substr(open + 1, close - open - 1);
    open = close + 1;
    double mm = 0.0;
    if (unit == "mm" || unit == "millimeter" || unit == "millimetre")
      mm = 1.0;
    else if (unit == "cm")
      mm = 10.0;
    else if (unit == "m")
      mm = 1000.0;
    else if (unit == "um" || unit == "micron" || unit == "\xC2\xB5m")
      mm = 1e-3;
    else if (unit.empty() || unit == "none" || unit == "???")
      continue;
    else
      refuse(path, field, "the unit '" + unit + "' is not read; mm, cm, m and um are");
    if (result > 0.0 && result != mm) refuse(path, field, "the units differ from axis to axis");
    result = mm;
  }
  return result > 0.0 ? result : 1.0;
}

void set_nrrd_axes(const fs::path& path, const HeaderFields& fields, std::size_t dimension,
                   ImageSource& source) {
  const std::vector<std::int64_t> sizes = fields.integers("sizes", dimension);
  std::vector<std::optional<Vec3>> directions;
  if (const std::string* text = fields.find("space directions"))
    directions = vectors(path, "space directions", *text, dimension);
  const std::vector<std::size_t> axes = spatial_axes(path, sizes, directions);
  for (std::size_t i = 0; i < 3; ++i) source.size[i] = sizes[axes[i]];
  check_sizes(path, "sizes", source.size);

  if (const std::string* text = fields.find("kinds")) {
    const auto kinds = words(*text);
    if (kinds.size() != dimension) refuse(path, "kinds", "one kind an axis is needed");
    for (const std::size_t axis : axes) {
      const std::string kind = lower_case(kinds[axis]);
      if (kind != "domain" && kind != "space" && kind != "???" && kind != "none")
        refuse(path, "kinds",
               "axis " + std::to_string(axis) + " is '" + kind + "', not space; one scalar volume is read");
    }
  }

  const Vec3 signs = to_lps(path, fields, source.warnings);
  if (!directions.empty()) {
    source.axes_field = "space directions";
    for (std::size_t i = 0; i < 3; ++i) source.step.col(static_cast<int>(i)) = *directions[axes[i]];
    source.step *= unit_mm(path, fields, "space units");
  } else {
    source.axes_field = "spacings";
    if (!fields.find("spacings"))
      refuse(path, "spacings",
             "neither 'space directions' nor 'spacings' is given, so the size of a voxel is unknown");
    const std::vector<double> spacings = fields.numbers("spacings", dimension);
    source.step.setZero();
    for (std::size_t i = 0; i < 3; ++i) {
      check_spacing(path, "spacings", spacings[axes[i]]);
      source.step(static_cast<int>(i), static_cast<int>(i)) = spacings[axes[i]];
    }
    source.step *= unit_mm(path, fields, fields.find("space units") ? "space units" : "units");
  }
  source.step = signs.asDiagonal() * source.step;
  if (const std::string* text = fields.find("space origin")) {
    const auto origin = vectors(path, "space origin", *text, 1)[0];
    if (!origin) refuse(path, "space origin", "'none' is no point");
    source.origin = signs.cwiseProduct(*origin) * unit_mm(path, fields, "space units");
  } else {
    source.warnings.push_back("no field 'space origin': the first voxel is taken to lie at 0, 0, 0");
  }
}

/// The offset after `lines` line ends from `offset` on.
std::uint64_t after_lines(const fs::path& file, std::uint64_t offset, std::int64_t lines) {
  ByteStream in(file, offset, false);
  char block[4096];
  std::uint64_t at = offset;
  while (lines > 0) {
    const std::size_t got = in.read(block, sizeof block);
    if (got == 0) refuse(file, "line skip", "the file has fewer lines");
    for (std::size_t i = 0; i < got && lines > 0; ++i, ++at)
      if (block[i] == '\n') --lines;
  }
  return at;
}

void set_data(const fs::path& path, const NrrdHeader& header, ImageSource& source) {
  const HeaderFields& fields = header.fields;
  const std::string encoding = lower_case(fields.require("encoding"));
  if (encoding == "raw")
    source.encoding = Encoding::raw;
  else if (encoding == "gzip" || encoding == "gz")
    source.encoding = Encoding::deflate;
  else if (encoding == "ascii" || encoding == "text" || encoding == "txt")
    source.encoding = Encoding::text;
  else
    refuse(path, "encoding", "'" + encoding + "' is not read; raw, gzip and ascii are");

  if (bytes_of(source.pixel_type) > 1 && source.encoding != Encoding::text) {
    const std::string endian = lower_case(fields.require("endian"));
    if (endian != "little" && endian != "big")
      refuse(path, "endian", "'" + endian + "' is neither little nor big");
    source.big_endian = endian == "big";
  }
  if (const std::string* name = fields.find_any({"data file", "datafile"})) {
    if (lower_case(*name).rfind("list", 0) == 0 || name->find('%') != std::string::npos)
      refuse(path, "data file", "'" + *name + "': data in several files are not read");
    source.data_path = data_file(path, "data file", *name);
  } else {
    if (!header.blank_line)
      refuse(path, "header", "cut short: no blank line before the data, and no 'data file'");
    source.data_path = path;
    source.offset = header.end;
  }
  const auto skipped = [&](const char* name, const char* other) {
    return fields.find(name)    ? fields.integer(name)
           : fields.find(other) ? fields.integer(other)
                                : std::int64_t{0};
  };
  const std::int64_t lines = skipped("line skip", "lineskip"), bytes = skipped("byte skip", "byteskip");
  if (lines < 0) refuse(path, "line skip", "must not be negative");
  if (lines > 0) source.offset = after_lines(source.data_path, source.offset, lines);
  if (bytes < -1) refuse(path, "byte skip", "must be -1 or more");
  if (bytes >= 0) {
    source.skip = static_cast<std::uint64_t>(bytes);
  } else {
    if (source.encoding != Encoding::raw) refuse(path, "byte skip", "-1 goes with raw data only");
    const std::uint64_t file = regular_file_size(source.data_path);
    if (file < source.offset || file - source.offset < source.bytes())
      refuse(source.data_path, "voxels", "the file is cut short");
    source.offset = file - source.bytes();
  }
}

}  // namespace

ImageSource parse_nrrd(const fs::path& path, const std::string& head) {
  const NrrdHeader header = split_header(path, head);
  ImageSource source;
  source.format = "NRRD";
  source.header_path = path;
  const std::int64_t dimension = header.fields.integer("dimension");
  if (dimension != 3 && dimension != 4)
    refuse(path, "dimension",
           std::to_string(dimension) + "; 3 is read, or 4 with one axis of a single sample");
  source.pixel_type = nrrd_pixel_type(path, header.fields);
  set_nrrd_axes(path, header.fields, static_cast<std::size_t>(dimension), source);
  set_data(path, header, source);
  return source;
}

}  // namespace ostia::imaging
