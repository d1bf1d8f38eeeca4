// Polygon files (Turk 1994), ASCII and binary of both byte orders.

#include "surface_formats.h"

#include "ostia/core/files.h"
#include "ostia/geometry/polygon.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

enum class Encoding { ascii, little, big };
enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

struct Property {
  std::string name;
  Type type = Type::f32;
  std::optional<Type> count_type;  // set for a list
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};
struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::string_view body;
};

std::optional<Type> type_of(std::string_view name) {
  static const std::vector<std::pair<std::string_view, Type>> names{
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const auto& [known, type] : names) {
    if (known == name) return type;
  }
  return std::nullopt;
}

std::size_t size_of(Type type) {
  switch (type) {
    case Type::i8:
    case Type::u8:
      return 1;
    case Type::i16:
    case Type::u16:
      return 2;
    case Type::i32:
    case Type::u32:
    case Type::f32:
      return 4;
    case Type::f64:
      break;
  }
  return 8;
}

Property read_property(Words& words, const fs::path& path) {
  Property property;
  std::string_view word = words.next();
  if (word == "list") {
    property.count_type = type_of(words.next());
    if (!property.count_type) refuse(path, "a list property has an unknown count type");
    word = words.next();
  }
  const auto type = type_of(word);
  if (!type) refuse(path, "property type \"" + std::string(word) + "\" is unknown");
  property.type = *type;
  property.name = words.next();
  return property;
}

Header read_header(std::string_view content, const fs::path& path) {
  Header header;
  Words lines(content);
  if (lines.line() != "ply") refuse(path, "it does not begin with \"ply\"");
  bool format = false;
  while (true) {
    if (lines.empty()) refuse(path, "its header does not end");
    Words words(lines.line());
    const std::string_view key = words.next();
    if (key == "end_header") break;
    if (key == "format") {
      const std::string_view name = words.next();
      format = true;
      if (name == "ascii")
        header.encoding = Encoding::ascii;
      else if (name == "binary_little_endian")
        header.encoding = Encoding::little;
      else if (name == "binary_big_endian")
        header.encoding = Encoding::big;
      else
        refuse(path, "format \"" + std::string(name) + "\" is unknown");
    } else if (key == "element") {
      Element element;
      element.name = words.next();
      const auto count = number<std::uint64_t>(words.next());
      if (!count || *count > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max())) {
        refuse(path, "element " + element.name + " has no proper count");
      }
      element.count = *count;
      header.elements.push_back(element);
    } else if (key == "property") {
      if (header.elements.empty()) refuse(path, "a property stands before any element");
      header.elements.back().properties.push_back(read_property(words, path));
    }
  }
  if (!format) refuse(path, "its header names no format");
  header.body = lines.rest();
  return header;
}

/// Takes values off the body one after another.
class Body {
 public:
  Body(const Header& header, const fs::path& path)
      : rest_(header.body), words_(header.body), encoding_(header.encoding), path_(path) {}
  double next(Type type) {
    if (encoding_ == Encoding::ascii) {
      const std::string_view word = words_.next();
      if (word.empty()) refuse(path_, "it is cut short");
      const auto value = number<double>(word);
      if (!value) refuse(path_, "\"" + std::string(word) + "\" is no number");
      return *value;
    }
    const std::size_t size = size_of(type);
    if (rest_.size() < size) refuse(path_, "it is cut short");
    std::array<char, 8> bytes{};
    std::memcpy(bytes.data(), rest_.data(), size);
    rest_.remove_prefix(size);
    if (encoding_ == Encoding::big)
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    return value_of(type, bytes.data());
  }

 private:
  template <class T>
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  static double value_of(Type type, const char* bytes) {
    switch (type) {
      case Type::i8:
        return as<std::int8_t>(bytes);
      case Type::u8:
        return as<std::uint8_t>(bytes);
      case Type::i16:
        return as<std::int16_t>(bytes);
      case Type::u16:
        return as<std::uint16_t>(bytes);
      case Type::i32:
        return as<std::int32_t>(bytes);
      case Type::u32:
        return as<std::uint32_t>(bytes);
      case Type::f32:
        return as<float>(bytes);
      case Type::f64:
        break;
    }
    return as<double>(bytes);
  }
  std::string_view rest_;
  Words words_;
  Encoding encoding_;
  const fs::path& path_;
};

void read_vertices(const Element& element, Body& body, geometry::TriMesh& mesh, const fs::path& path) {
  std::array<int, 3> where{-1, -1, -1};
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    if (property.count_type) refuse(path, "vertex property " + property.name + " is a list");
    if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
      where[static_cast<std::size_t>(property.name[0] - 'x')] = static_cast<int>(i);
    }
  }
  if (*std::min_element(where.begin(), where.end()) < 0) refuse(path, "its vertices have no x, y or z");
  for (std::uint64_t v = 0; v < element.count; ++v) {
    geometry::Vec3 point = geometry::Vec3::Zero();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const double value = body.next(element.properties[i].type);
      for (int axis = 0; axis < 3; ++axis) {
        if (where[static_cast<std::size_t>(axis)] == static_cast<int>(i)) point[axis] = value;
      }
    }
    mesh.points.push_back(point);
  }
}

std::size_t read_faces(const Element& element, Body& body, geometry::TriMesh& mesh, const fs::path& path) {
  std::size_t polygons = 0;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    for (const Property& property : element.properties) {
      if (!property.count_type) {
        body.next(property.type);
        continue;
      }
      const bool corners_here = property.name == "vertex_indices" || property.name == "vertex_index";
      const double count = body.next(*property.count_type);
      if (!(count >= 0 && count < 1e6))
        refuse(path, "face " + std::to_string(f) + " has an impossible number of corners");
      std::vector<std::int32_t> corners;
      for (int i = 0; i < static_cast<int>(count); ++i) {
        const double index = body.next(property.type);
        if (!(index >= 0 && index <= std::numeric_limits<std::int32_t>::max())) {
          if (corners_here) refuse(path, "face " + std::to_string(f) + " names a point out of range");
        } else {
          corners.push_back(static_cast<std::int32_t>(index));
        }
      }
      if (!corners_here) continue;
      if (corners.size() < 3) refuse(path, "face " + std::to_string(f) + " has fewer than three corners");
      polygons += corners.size() > 3;
      for (const geometry::Triangle& t : geometry::triangles_of_polygon(mesh.points, corners))
        mesh.triangles.push_back(t);
    }
  }
  return polygons;
}

void skip(const Element& element, Body& body) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      const double count = property.count_type ? body.next(*property.count_type) : 1.0;
      for (double k = 0; k < count; ++k) body.next(property.type);
    }
  }
}

}  // namespace

LoadedSurface read_ply(const fs::path& path) {
  const std::string content = core::read_file(path);
  const Header header = read_header(content, path);
  LoadedSurface loaded;
  Body body(header, path);
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.count > 0)
      refuse(path, "element " + element.name + " has no properties");
    if (element.name == "vertex") {
      read_vertices(element, body, loaded.surface.mesh, path);
    } else if (element.name == "face") {
      const std::size_t polygons = read_faces(element, body, loaded.surface.mesh, path);
      if (polygons > 0)
        loaded.warnings.push_back(std::to_string(polygons) + " polygons were split into triangles");
    } else {
      skip(element, body);
    }
  }
  return loaded;
}

std::string ply_text(const geometry::TriMesh& mesh) {
  std::string out =
      "ply\nformat binary_little_endian 1.0\ncomment Ostia surface, axes LPS, unit mm\nelement vertex " +
      std::to_string(mesh.points.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto append = [&out](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const geometry::Vec3& p : mesh.points) {
    for (const double value : p) append(value);
  }
  for (const geometry::Triangle& t : mesh.triangles) {
    append(std::uint8_t{3});
    for (const std::int32_t p : t) append(p);
  }
  return out;
}

}  // namespace ostia::io
