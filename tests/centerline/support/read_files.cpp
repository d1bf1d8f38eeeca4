#include "support/read_files.h"

#include "ostia/core/files.h"
#include "ostia/geometry/mesh_topology.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>

namespace ostia::testing {
namespace {

using geometry::Vec3;

template <class T>
T value_at(const std::string& bytes, std::size_t offset) {
  T value;
  if (offset + sizeof value > bytes.size()) throw std::runtime_error("test input cut short");
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

void add_triangle(geometry::TriMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

geometry::TriMesh read_binary_stl(const std::string& bytes) {
  geometry::TriMesh mesh;
  const auto count = value_at<std::uint32_t>(bytes, 80);
  for (std::uint32_t t = 0; t < count; ++t) {
    Vec3 corner[3];
    for (std::size_t k = 0; k < 9; ++k)
      corner[k / 3][static_cast<Eigen::Index>(k % 3)] = value_at<float>(bytes, 84 + 50 * t + 12 + 4 * k);
    add_triangle(mesh, corner[0], corner[1], corner[2]);
  }
  return mesh;
}

geometry::TriMesh read_ascii_stl(const std::string& bytes) {
  geometry::TriMesh mesh;
  std::istringstream stream(bytes);
  std::string word;
  std::vector<Vec3> corners;
  while (stream >> word) {
    if (word != "vertex") continue;
    Vec3 p;
    stream >> p.x() >> p.y() >> p.z();
    corners.push_back(p);
    if (corners.size() < 3) continue;
    add_triangle(mesh, corners[0], corners[1], corners[2]);
    corners.clear();
  }
  return mesh;
}

std::string from_base64(const std::string& text, std::size_t first, std::size_t characters) {
  std::string bytes;
  std::uint32_t group = 0;
  int digits = 0;
  for (std::size_t i = first; i < first + characters && i < text.size(); ++i) {
    static const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = alphabet.find(text[i]);
    group = group << 6 | static_cast<std::uint32_t>(digit == std::string::npos ? 0 : digit);
    if (++digits < 4) continue;
    const int bytes_here = text[i] != '=' ? 3 : text[i - 1] != '=' ? 2 : 1;
    for (int b = 0; b < bytes_here; ++b) bytes += static_cast<char>(group >> (16 - 8 * b) & 0xff);
    group = 0;
    digits = 0;
  }
  return bytes;
}

std::size_t base64_size(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

// One appended array: the header (blocks, block size, last block's size, compressed sizes), then the blocks.
std::string appended_array(const std::string& text, std::size_t offset) {
  const std::string start = from_base64(text, offset, 16);
  const auto blocks = value_at<std::uint32_t>(start, 0), block_size = value_at<std::uint32_t>(start, 4),
             last_size = value_at<std::uint32_t>(start, 8);
  const std::size_t header_bytes = 4 * (3 + blocks);
  const std::string header = from_base64(text, offset, base64_size(header_bytes));
  std::size_t compressed = 0;
  for (std::uint32_t b = 0; b < blocks; ++b) compressed += value_at<std::uint32_t>(header, 12 + 4 * b);
  const std::string data = from_base64(text, offset + base64_size(header_bytes), base64_size(compressed));
  std::string result;
  std::size_t at = 0;
  for (std::uint32_t b = 0; b < blocks; ++b) {
    uLongf size = b + 1 == blocks && last_size > 0 ? last_size : block_size;
    std::string block(size, '\0');
    const auto packed = value_at<std::uint32_t>(header, 12 + 4 * b);
    if (uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
                   reinterpret_cast<const Bytef*>(data.data()) + at, packed) != Z_OK)
      throw std::runtime_error("test input does not decompress");
    result += block;
    at += packed;
  }
  return result;
}

std::size_t offset_of(const std::string& xml, const std::string& name) {
  const std::size_t place = xml.find("offset=\"", xml.find("Name=\"" + name + "\""));
  return std::stoul(xml.substr(place + 8));
}

}  // namespace

geometry::TriMesh read_stl(const std::filesystem::path& path) {
  const std::string bytes = core::read_file(path);
  const bool binary = bytes.size() >= 84 && bytes.size() == 84 + 50ULL * value_at<std::uint32_t>(bytes, 80);
  return geometry::welded(binary ? read_binary_stl(bytes) : read_ascii_stl(bytes));
}

geometry::Centerline read_compressed_vtp_points(const std::filesystem::path& path) {
  const std::string xml = core::read_file(path);
  const std::size_t appended = xml.find('_', xml.find("<AppendedData")) + 1;
  const std::string points = appended_array(xml, appended + offset_of(xml, "Points"));
  const std::string radii = appended_array(xml, appended + offset_of(xml, "Radius"));
  geometry::Centerline line;
  for (std::size_t i = 0; 12 * i + 12 <= points.size(); ++i) {
    line.points.emplace_back(value_at<float>(points, 12 * i), value_at<float>(points, 12 * i + 4),
                             value_at<float>(points, 12 * i + 8));
    line.radius.push_back(value_at<double>(radii, 8 * i));
  }
  return line;
}

std::vector<geometry::Vec3> read_ascii_vtk_points(const std::filesystem::path& path) {
  std::istringstream stream(core::read_file(path));
  std::string word;
  while (stream >> word && word != "POINTS") {
  }
  std::size_t count = 0;
  stream >> count >> word;
  std::vector<geometry::Vec3> points(count);
  for (geometry::Vec3& p : points) stream >> p.x() >> p.y() >> p.z();
  return points;
}

}  // namespace ostia::testing
