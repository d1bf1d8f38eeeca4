#include "image_data.h"
#include "image_source.h"

#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

// The format: ITK's MetaIO, itk.org/Wiki/ITK/MetaIO/Documentation. Each row of TransformMatrix is the
// direction of one axis.

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

struct MetaType {
  const char* name;
  PixelType type;
};
constexpr MetaType meta_types[] = {{"met_char", PixelType::int8},       {"met_uchar", PixelType::uint8},
                                   {"met_short", PixelType::int16},     {"met_ushort", PixelType::uint16},
                                   {"met_int", PixelType::int32},       {"met_uint", PixelType::uint32},
                                   {"met_long", PixelType::int32},      {"met_ulong", PixelType::uint32},
                                   {"met_long_long", PixelType::int64}, {"met_ulong_long", PixelType::uint64},
                                   {"met_float", PixelType::float32},   {"met_double", PixelType::float64}};

/// The fields up to ElementDataFile, which is the last; returns where the line after it begins.
std::size_t split_header(const fs::path& path, const std::string& head, HeaderFields& fields) {
  std::size_t at = 0;
  while (at < head.size()) {
    const std::size_t stop = std::min(head.find('\n', at), head.size());
    const std::string_view line = trimmed(std::string_view(head).substr(at, stop - at));
    at = std::min(stop + 1, head.size());
    if (line.empty() || line.front() == '#') continue;
    const std::size_t sign = line.find('=');
    if (sign == std::string_view::npos)
      refuse(path, "header", "the line '" + std::string(line.substr(0, 60)) + "' has no '='");
    const std::string_view name = trimmed(line.substr(0, sign));
    fields.add(name, trimmed(line.substr(sign + 1)));
    if (lower_case(name) == "elementdatafile") return at;
  }
  refuse(path, "ElementDataFile",
         "missing from the header (of at most " + std::to_string(max_header_bytes) + " bytes)");
}

/// The first of the names under which MetaImage files carry one thing.
std::string present(const HeaderFields& fields, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (fields.find(name)) return name;
  return {};
}

PixelType meta_pixel_type(const fs::path& path, const HeaderFields& fields) {
  const std::string name = lower_case(fields.require("ElementType"));
  for (const MetaType& known : meta_types)
    if (name == known.name) return known.type;
  refuse(path, "ElementType",
         "'" + fields.require("ElementType") + "' is not a scalar type that can be read");
}

double unit_mm(const fs::path& path, const HeaderFields& fields, std::vector<std::string>& warnings) {
  const std::string* unit = fields.find("DistanceUnits");
  if (!unit || *unit == "mm" || *unit == "?") return 1.0;
  if (*unit != "cm" && *unit != "um")
    refuse(path, "DistanceUnits", "'" + *unit + "' is not read; mm, cm and um are");
  warnings.push_back("DistanceUnits " + *unit + ": converted to mm");
  return *unit == "cm" ? 10.0 : 1e-3;
}

void set_meta_axes(const fs::path& path, const HeaderFields& fields, std::size_t dimension,
                   ImageSource& source) {
  const std::vector<std::int64_t> sizes = fields.integers("DimSize", dimension);
  if (dimension == 4 && sizes[3] != 1)
    refuse(path, "DimSize", "a fourth dimension of " + std::to_string(sizes[3]) + "; one volume is read");
  for (std::size_t i = 0; i < 3; ++i) source.size[i] = sizes[i];
  check_sizes(path, "DimSize", source.size);

  const std::string spacing_name = present(fields, {"ElementSpacing", "ElementSize"});
  if (spacing_name.empty()) refuse(path, "ElementSpacing", "missing, so the size of a voxel is unknown");
  const std::vector<double> spacing = fields.numbers(spacing_name, dimension);
  const double mm = unit_mm(path, fields, source.warnings);
  const std::string matrix_name = present(fields, {"TransformMatrix", "Rotation", "Orientation"});
  const std::vector<double> matrix =
      matrix_name.empty() ? std::vector<double>{} : fields.numbers(matrix_name, dimension * dimension);
  source.axes_field = matrix_name.empty() ? spacing_name : matrix_name;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    check_spacing(path, spacing_name, spacing[axis]);
    Vec3 direction = Vec3::Unit(static_cast<int>(axis));
    if (!matrix.empty())
      direction = Vec3(matrix[axis * dimension], matrix[axis * dimension + 1], matrix[axis * dimension + 2]);
    const double length = direction.norm();
    if (!(std::abs(length - 1.0) <= 0.01))
      refuse(path, matrix_name,
             "singular or not made of directions: row " + std::to_string(axis) + " has a length of " +
                 core::shortest_text(length) + " where 1 is needed");
    source.step.col(static_cast<int>(axis)) =
        direction * (std::abs(length - 1.0) < 1e-15 ? 1.0 : 1.0 / length) * spacing[axis] * mm;
  }
  const std::string origin_name = present(fields, {"Offset", "Position", "Origin"});
  if (origin_name.empty()) {
    source.warnings.push_back("no field 'Offset': the first voxel is taken to lie at 0, 0, 0");
    return;
  }
  const std::vector<double> origin = fields.numbers(origin_name, dimension);
  source.origin = Vec3(origin[0], origin[1], origin[2]) * mm;
  if (!source.origin.allFinite()) refuse(path, origin_name, "not finite");
}

void set_scale(const fs::path& path, const HeaderFields& fields, ImageSource& source) {
  const char *slope = "ElementToIntensityFunctionSlope", *offset = "ElementToIntensityFunctionOffset";
  if (fields.find(slope)) source.slope = fields.numbers(slope, 1)[0];
  if (fields.find(offset)) source.intercept = fields.numbers(offset, 1)[0];
  if (!std::isfinite(source.slope) || source.slope == 0.0) refuse(path, slope, "must be finite and not 0");
  if (!std::isfinite(source.intercept)) refuse(path, offset, "must be finite");
}

void set_data(const fs::path& path, const HeaderFields& fields, std::size_t header_end, ImageSource& source) {
  if (fields.flag("CompressedData", false))
    source.encoding = Encoding::deflate;
  else if (!fields.flag("BinaryData", true))
    source.encoding = Encoding::text;
  source.big_endian = fields.flag(
      fields.find("BinaryDataByteOrderMSB") ? "BinaryDataByteOrderMSB" : "ElementByteOrderMSB", false);

  const std::string name = fields.require("ElementDataFile");
  const bool local = lower_case(name) == "local";
  if (local) {
    source.data_path = path;
    source.offset = header_end;
  } else {
    if (lower_case(name).rfind("list", 0) == 0 || name.find('%') != std::string::npos)
      refuse(path, "ElementDataFile", "'" + name + "': data in several files are not read");
    source.data_path = data_file(path, "ElementDataFile", name);
  }
  const std::int64_t skip = fields.find("HeaderSize") ? fields.integer("HeaderSize") : 0;
  if (skip < -1) refuse(path, "HeaderSize", "must be -1 or more");
  if (skip > 0) {
    if (local && static_cast<std::uint64_t>(skip) < header_end)
      refuse(path, "HeaderSize", "ends within the header");
    source.offset = static_cast<std::uint64_t>(skip);
  } else if (skip == -1) {
    if (source.encoding != Encoding::raw)
      refuse(path, "HeaderSize", "-1 goes with uncompressed binary data only");
    const std::uint64_t file = regular_file_size(source.data_path);
    if (file < source.offset || file - source.offset < source.bytes())
      refuse(source.data_path, "voxels",
             "the file is cut short: " + std::to_string(source.bytes()) +
                 " bytes of voxels are announced, the file has " + std::to_string(file));
    source.offset = file - source.bytes();
  }
}

}  // namespace

ImageSource parse_meta_image(const fs::path& path, const std::string& head) {
  HeaderFields fields(path);
  const std::size_t header_end = split_header(path, head, fields);
  ImageSource source;
  source.format = "MetaImage";
  source.header_path = path;
  if (const std::string* object = fields.find("ObjectType"); object && lower_case(*object) != "image")
    refuse(path, "ObjectType", "'" + *object + "' is not an image");
  const std::int64_t dimension = fields.integer("NDims");
  if (dimension != 3 && dimension != 4)
    refuse(path, "NDims", std::to_string(dimension) + "; 3 is read, or 4 with one sample in the fourth");
  if (fields.find("ElementNumberOfChannels") && fields.integer("ElementNumberOfChannels") != 1)
    refuse(path, "ElementNumberOfChannels", "one scalar a voxel is read");
  source.pixel_type = meta_pixel_type(path, fields);
  set_meta_axes(path, fields, static_cast<std::size_t>(dimension), source);
  set_scale(path, fields, source);
  set_data(path, fields, header_end, source);
  return source;
}

}  // namespace ostia::imaging
