#include "tetgen_job.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace ostia::meshing {

namespace {

constexpr std::string_view job_magic = "OSTIATJ1", result_magic = "OSTIATR1";

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

void write_job(const TetgenJob& job, const std::filesystem::path& path) {
  std::string bytes(job_magic);
  put(bytes, job.max_radius_edge_ratio);
  put(bytes, job.min_dihedral_deg);
  put(bytes, job.points);
  put(bytes, job.sizes);
  put(bytes, job.triangles);
  core::write_file(path, bytes);
}

TetgenJob read_job(const std::filesystem::path& path) {
  Cursor cursor(path, job_magic);
  TetgenJob job;
  cursor.get(job.max_radius_edge_ratio);
  cursor.get(job.min_dihedral_deg);
  cursor.get(job.points);
  cursor.get(job.sizes);
  cursor.get(job.triangles);
  const auto count = static_cast<std::int64_t>(job.points.size());
  bool sound = job.sizes.size() == job.points.size();
  for (const geometry::Triangle& t : job.triangles)
    for (const std::int32_t v : t) sound = sound && v >= 0 && v < count;
  if (!sound) throw InvalidInput(path.string() + " has a triangle whose corner does not exist");
  return job;
}

void write_result(const TetgenResult& result, const std::filesystem::path& path) {
  std::string bytes(result_magic);
  put(bytes, result.points);
  put(bytes, result.tetrahedra);
  core::write_file(path, bytes);
}

TetgenResult read_result(const std::filesystem::path& path) {
  Cursor cursor(path, result_magic);
  TetgenResult result;
  cursor.get(result.points);
  cursor.get(result.tetrahedra);
  const auto count = static_cast<std::int64_t>(result.points.size());
  for (const geometry::Tetrahedron& t : result.tetrahedra)
    for (const std::int32_t v : t)
      if (v < 0 || v >= count)
        throw InvalidInput(path.string() + " has a tetrahedron whose corner does not exist");
  return result;
}

}  // namespace ostia::meshing
