#include "kept_scan.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstring>
#include <ios>
#include <optional>
#include <sstream>
#include <string>

namespace ostia::testing {
namespace fs = std::filesystem;
namespace {

/// The libraries that scan, each with its size and time. Nothing where this program was linked before one of
/// them was built: it would keep what it makes under the name of what they make.
std::optional<std::string> makers() {
  std::istringstream list(OSTIA_SCANNING_LIBRARIES);
  const auto linked = fs::last_write_time(fs::read_symlink("/proc/self/exe"));
  std::ostringstream out;
  for (std::string library; std::getline(list, library, '|');) {
    const auto built = fs::last_write_time(library);
    if (built > linked) return std::nullopt;
    out << fs::file_size(library) << ' ' << built.time_since_epoch().count() << '\n';
  }
  return out.str();
}

std::string what_decides(const phantom::CasePlan& plan) {
  const phantom::ScanOptions& scan = plan.options.scan;
  const imaging::Geometry& grid = scan.grid;
  std::ostringstream out;
  out << phantom::parameters_json(plan.options) << '\n' << std::hexfloat;
  for (const std::int64_t size : grid.size) out << size << ' ';
  for (const double value :
       {scan.psf_fwhm_mm, scan.psf_fwhm_z_mm, scan.noise_hu, scan.noise_peak_per_mm, scan.noise_fwhm_z_mm,
        scan.stair_step_mm, scan.stair_block_mm, scan.motion_mm, scan.moving_radius_mm, scan.beam_hardening})
    out << value << ' ';
  for (const geometry::Vec3& of : {geometry::Vec3(grid.spacing), grid.origin, scan.moving_centre})
    out << of.x() << ' ' << of.y() << ' ' << of.z() << ' ';
  for (const double value : grid.direction.reshaped()) out << value << ' ';
  out << scan.supersampling << ' ' << scan.seed << '\n';
  return out.str();
}

/// One program makes a scan, the others wait for it.
class Alone {
 public:
  explicit Alone(const fs::path& file) : file_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0 || ::flock(file_, LOCK_EX) != 0) throw IoError("cannot lock " + file.string());
  }
  ~Alone() { ::close(file_); }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

 private:
  int file_;
};

template <class T>
std::size_t bytes_of(const imaging::Volume<T>& volume) {
  return volume.voxels.size() * sizeof(T);
}

std::string written(const std::string& key, const phantom::Scan& scan) {
  std::string bytes = key;
  bytes.append(reinterpret_cast<const char*>(scan.image.voxels.data()), bytes_of(scan.image));
  bytes.append(reinterpret_cast<const char*>(scan.labels.voxels.data()), bytes_of(scan.labels));
  return bytes;
}

std::optional<phantom::Scan> read(const fs::path& file, const std::string& key,
                                  const imaging::Geometry& grid) {
  if (!fs::exists(file)) return std::nullopt;
  const std::string bytes = core::read_file(file);
  phantom::Scan scan;
  scan.image.geometry = scan.labels.geometry = grid;
  scan.image.voxels.resize(static_cast<std::size_t>(grid.voxels()));
  scan.labels.voxels.resize(scan.image.voxels.size());
  if (bytes.size() != key.size() + bytes_of(scan.image) + bytes_of(scan.labels)) return std::nullopt;
  if (bytes.compare(0, key.size(), key) != 0) return std::nullopt;
  std::memcpy(scan.image.voxels.data(), bytes.data() + key.size(), bytes_of(scan.image));
  std::memcpy(scan.labels.voxels.data(), bytes.data() + key.size() + bytes_of(scan.image),
              bytes_of(scan.labels));
  return scan;
}

}  // namespace

phantom::Scan kept_scan(const phantom::CasePlan& plan) {
  return kept_scan(plan, OSTIA_KEPT_SCANS);
}

phantom::Scan kept_scan(const phantom::CasePlan& plan, const fs::path& folder) {
  const std::optional<std::string> by = makers();
  if (!by) return phantom::scan_case(plan);
  const std::string decides = what_decides(plan);
  const std::string key = *by + decides;
  fs::create_directories(folder);
  const fs::path file = folder / (core::sha256(decides).substr(0, 16) + ".scan");
  const Alone alone(file.string() + ".lock");
  if (std::optional<phantom::Scan> kept = read(file, key, plan.options.scan.grid)) return *std::move(kept);
  phantom::Scan scan = phantom::scan_case(plan);
  core::write_file(file, written(key, scan));
  return scan;
}

}  // namespace ostia::testing
