#include "mesher/mesher_job.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace ostia::meshing {

namespace {

constexpr std::string_view job_magic = "OSTIATJ3", result_magic = "OSTIATR2";

static_assert(sizeof(geometry::Vec3) == 3 * sizeof(double));

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class T>
void put(std::string& bytes, const std::vector<T>& values) {
  put(bytes, static_cast<std::uint64_t>(values.size()));
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <class Elements>
bool refer_to(std::size_t points, const Elements& elements) {
  for (const auto& element : elements)
    for (const std::int32_t v : element)
      if (v < 0 || static_cast<std::size_t>(v) >= points) return false;
  return true;
}

/// Takes values off the front of a file's bytes.
class Cursor {
 public:
  Cursor(const std::filesystem::path& path, std::string_view magic)
      : bytes_(core::read_file(path)), path_(path) {
    if (bytes_.substr(0, magic.size()) != magic) fail();
    at_ = magic.size();
  }
  template <class T>
  void get(T& value) {
    if (bytes_.size() - at_ < sizeof value) fail();
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  template <class T>
  void get(std::vector<T>& values) {
    std::uint64_t count = 0;
    get(count);
    if (count > (bytes_.size() - at_) / sizeof(T)) fail();
    values.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }

 private:
  [[noreturn]] void fail() const {
    throw InvalidInput(path_.string() + " is not a whole tetrahedralization file");
  }
  std::string bytes_;
  std::filesystem::path path_;
  std::size_t at_ = 0;
};

}  // namespace

void write_job(const MesherJob& job, const std::filesystem::path& path) {
  std::string bytes(job_magic);
  put(bytes, job.mesher);
  put(bytes, job.max_radius_edge_ratio);
  put(bytes, job.min_dihedral_deg);
  put(bytes, job.points);
  put(bytes, job.sizes);
  put(bytes, job.triangles);
  put(bytes, job.face_ids);
  put(bytes, job.field_points);
  put(bytes, job.field_sizes);
  put(bytes, job.field_gradation);
  core::write_file(path, bytes);
}

MesherJob read_job(const std::filesystem::path& path) {
  Cursor cursor(path, job_magic);
  MesherJob job;
  cursor.get(job.mesher);
  cursor.get(job.max_radius_edge_ratio);
  cursor.get(job.min_dihedral_deg);
  cursor.get(job.points);
  cursor.get(job.sizes);
  cursor.get(job.triangles);
  cursor.get(job.face_ids);
  cursor.get(job.field_points);
  cursor.get(job.field_sizes);
  cursor.get(job.field_gradation);
  if (job.field_sizes.size() != job.field_points.size())
    throw InvalidInput(path.string() + " has another number of lengths than of places inside");
  bool sound = job.sizes.size() == job.points.size() && job.face_ids.size() == job.triangles.size();
  sound = sound && refer_to(job.points.size(), job.triangles);
  if (!sound) throw InvalidInput(path.string() + " has a triangle whose corner does not exist");
  return job;
}

void write_result(const MesherResult& result, const std::filesystem::path& path) {
  std::string bytes(result_magic);
  put(bytes, result.points);
  put(bytes, result.tetrahedra);
  put(bytes, result.boundary);
  put(bytes, result.boundary_face_ids);
  core::write_file(path, bytes);
}

MesherResult read_result(const std::filesystem::path& path) {
  Cursor cursor(path, result_magic);
  MesherResult result;
  cursor.get(result.points);
  cursor.get(result.tetrahedra);
  cursor.get(result.boundary);
  cursor.get(result.boundary_face_ids);
  if (!refer_to(result.points.size(), result.tetrahedra) ||
      !refer_to(result.points.size(), result.boundary) ||
      result.boundary_face_ids.size() != result.boundary.size())
    throw InvalidInput(path.string() + " has an element whose corner does not exist");
  return result;
}

}  // namespace ostia::meshing
