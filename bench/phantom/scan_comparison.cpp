// Real images and the phantom's, measured with the same instruments, as tables, plots and pictures
// (docs/experiments/scans.md).
//   scan_comparison SHARED_DATA OUTPUT_FOLDER
// What is not in SHARED_DATA is named and left out. side-by-side.png shows a patient: look at the image's
// licence before passing it on.

#include "picture.h"

#include "ostia/core/text.h"
#include "ostia/evaluation/image_quality.h"
#include "ostia/figure/plot.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/image_file.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/reformat/plane_image.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace ostia;
using geometry::Vec3;
using imaging::ImageVolume;
using imaging::MaskVolume;

/// An image and the range of its blood, HU.
struct Looked {
  std::string name;
  ImageVolume image;
  double blood_from = 0.0, blood_to = 0.0;
};

imaging::FloatVolume smooth(const ImageVolume& image, double sigma_mm) {
  imaging::FloatVolume values{image.geometry, std::vector<float>(image.voxels.begin(), image.voxels.end())};
  return imaging::gaussian_blurred(values, sigma_mm);
}

MaskVolume between(const imaging::FloatVolume& values, double low, double high) {
  MaskVolume mask{values.geometry, {}};
  for (const float v : values.voxels) mask.voxels.push_back(v > low && v < high);
  return mask;
}

std::string number(double value, int decimals) {
  return core::fixed_text(value, decimals);
}

/// Noise of one tissue: squares of about 8 mm.
std::optional<evaluation::NoisePower> noise_in(const Looked& looked, const imaging::FloatVolume& values,
                                               double low, double high,
                                               std::vector<evaluation::NoiseRegion>& squares, int& side) {
  side = std::max(8, static_cast<int>(std::lround(8.0 / looked.image.geometry.spacing.x())));
  squares = evaluation::noise_regions(between(values, low, high), side);
  if (squares.size() < 8) return std::nullopt;
  return evaluation::noise_power(looked.image, squares, side);
}

struct Tables {
  std::vector<std::vector<std::string>> noise, edges, tissues;
  std::vector<figure::Series> spectra, profiles, histograms;
};

void add_noise(const Looked& looked, const imaging::FloatVolume& values, Tables& tables) {
  const struct {
    const char* name;
    double low, high;
  } kinds[] = {{"blood", looked.blood_from, looked.blood_to},
               {"fat", -125.0, -75.0},
               {"muscle", 10.0, 90.0},
               {"air outside", -1015.0, -985.0}};
  for (const auto& kind : kinds) {
    std::vector<evaluation::NoiseRegion> squares;
    int side = 0;
    const auto power = noise_in(looked, values, kind.low, kind.high, squares, side);
    if (!power) continue;
    std::string alike;
    if (looked.image.geometry.size[2] > 3) {
      for (const double r : evaluation::noise_correlation_along_k(looked.image, squares, side, 2))
        alike += (alike.empty() ? "" : ", ") + number(r, 2);
    }
    tables.noise.push_back({looked.name, kind.name, std::to_string(squares.size()),
                            number(power->deviation_hu, 1), number(power->peak_per_mm, 2),
                            number(power->mean_per_mm, 2), number(power->anisotropy, 2),
                            number(power->streaks_deg, 0), alike});
    if (std::string(kind.name) == "blood") {
      figure::Series line{looked.name, power->frequency_per_mm, {}, {}, figure::LineStyle::solid, 2.0};
      for (const double p : power->power_hu2_mm2)
        line.y.push_back(p / (power->deviation_hu * power->deviation_hu));
      tables.spectra.push_back(line);
    }
  }
}

void add_edges(const Looked& looked, const imaging::FloatVolume& values, Tables& tables) {
  if (looked.blood_from < 100.0) return;  // no contrast
  const double half = 0.5 * looked.blood_from;
  evaluation::EdgeOptions options;
  options.half_length_mm = 4.0;
  const MaskVolume blood = between(values, std::max(half, 150.0), 1e6);
  options.direction = evaluation::EdgeDirection::in_plane;
  const auto plane = evaluation::edge_widths(looked.image, blood, options, 2000);
  const auto profile = evaluation::edge_profile(looked.image, blood, options, 2000);
  options.direction = evaluation::EdgeDirection::along_k;
  const auto along = evaluation::edge_widths(looked.image, blood, options, 2000);
  tables.edges.push_back({looked.name, std::to_string(profile.edges), number(plane.p25_mm, 2),
                          number(plane.median_mm, 2), number(along.p25_mm, 2), number(along.median_mm, 2),
                          number(100.0 * profile.undershoot, 1), number(100.0 * profile.overshoot, 1)});
  if (!profile.at_mm.empty())
    tables.profiles.push_back({looked.name, profile.at_mm, profile.level, {}, figure::LineStyle::solid, 2.0});
}

void add_tissues(const Looked& looked, const imaging::FloatVolume& values, Tables& tables) {
  const struct {
    const char* name;
    double low, high;
  } kinds[] = {{"lung", -950.0, -700.0},
               {"fat", -130.0, -70.0},
               {"muscle", 10.0, 90.0},
               {"blood", looked.blood_from, looked.blood_to},
               {"brighter than blood", looked.blood_to, 4000.0}};
  std::vector<std::string> row{looked.name};
  for (const auto& kind : kinds) {
    const MaskVolume mask = between(values, kind.low, kind.high);
    double inside = 0.0;
    for (const std::uint8_t v : mask.voxels) inside += v;
    if (inside < 100.0) {
      row.push_back("-");
      continue;
    }
    const auto hu = evaluation::hu_statistics(looked.image, mask);
    row.push_back(number(hu.median_hu, 0) + " (" + number(hu.p05_hu, 0) + " to " + number(hu.p95_hu, 0) +
                  ")");
  }
  tables.tissues.push_back(row);
  const auto histogram = evaluation::hu_histogram(looked.image, -1024.0, 1500.0, 20.0);
  figure::Series line{looked.name, {}, {}, {}, figure::LineStyle::solid, 2.0};
  for (std::size_t b = 0; b < histogram.share.size(); ++b) {
    const double hu = histogram.from_hu + (static_cast<double>(b) + 0.5) * histogram.bin_hu;
    if (hu < -300.0 || hu > 1200.0) continue;
    line.x.push_back(hu);
    line.y.push_back(100.0 * histogram.share[b]);
  }
  tables.histograms.push_back(line);
}

Tables measured(const std::vector<Looked>& images) {
  Tables tables;
  for (const Looked& looked : images) {
    const imaging::FloatVolume values = smooth(looked.image, 1.5);
    add_noise(looked, values, tables);
    add_edges(looked, values, tables);
    add_tissues(looked, values, tables);
  }
  return tables;
}

void print(const std::string& title, const std::vector<std::string>& header,
           const std::vector<std::vector<std::string>>& rows) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string out = "|";
    for (const std::string& cell : cells) out += " " + cell + " |";
    std::puts(out.c_str());
  };
  std::printf("\n%s\n\n", title.c_str());
  line(header);
  line(std::vector<std::string>(header.size(), "---"));
  for (const auto& row : rows) line(row);
}

void report(const Tables& tables, const fs::path& folder) {
  print("Noise",
        {"image", "in", "squares", "deviation, HU", "peak, 1/mm", "mean, 1/mm", "anisotropy",
         "streaks along, deg", "alike 1, 2 slices apart"},
        tables.noise);
  print("Edges of the blood",
        {"image", "edges", "in plane: quartile, mm", "median", "along z: quartile, mm", "median",
         "undershoot, %", "overshoot, %"},
        tables.edges);
  print("CT numbers, HU", {"image", "lung", "fat", "muscle", "blood", "brighter than blood"}, tables.tissues);
  figure::PlotOptions how;
  how.title = "Noise power in the blood, over its variance";
  how.x_label = "cycles a mm";
  how.y_label = "mm^2";
  how.x_range = {0.0, 1.2};
  figure::line_plot(tables.spectra, how).write_png(folder / "spectra.png");
  how = {};
  how.title = "The edge of the blood in the plane";
  how.x_label = "mm";
  how.y_label = "share of its height";
  figure::line_plot(tables.profiles, how).write_png(folder / "profiles.png");
  how = {};
  how.title = "CT numbers";
  how.x_label = "HU";
  how.y_label = "% of the voxels in 20 HU";
  how.y_range = {0.0, 6.0};
  figure::line_plot(tables.histograms, how).write_png(folder / "histograms.png");
}

/// The window of the pictures, and a slice in it.
figure::Picture panel(const ImageVolume& image, std::int64_t slice, const std::string& title,
                      int width_px = 512) {
  figure::SliceFigureOptions how;
  how.title = title;
  how.level_hu = 150.0;
  how.window_hu = 700.0;
  how.image_width_px = width_px;
  how.rulers = how.scale_bar = how.patient_letters = how.plane_name = false;
  const auto& size = image.geometry.size;
  const Vec3 at =
      image.geometry.world(Vec3(0.5 * static_cast<double>(size[0] - 1),
                                0.5 * static_cast<double>(size[1] - 1), static_cast<double>(slice)));
  return figure::slice_figure(
      reformat::slice(image, reformat::axial_plane(image.geometry, at), imaging::Interpolation::nearest), {},
      {}, how);
}

imaging::Geometry grid_about(const Vec3& centre, const std::array<std::int64_t, 3>& size,
                             const Vec3& spacing) {
  imaging::Geometry grid;
  grid.size = size;
  grid.spacing = spacing;
  for (int axis = 0; axis < 3; ++axis)
    grid.origin[axis] =
        centre[axis] - 0.5 * spacing[axis] * static_cast<double>(size[static_cast<std::size_t>(axis)] - 1);
  return grid;
}

/// A patient on another grid, with another scanner.
ImageVolume scanned(const phantom::ScanOptions& scan, const phantom::CaseVariant& variant,
                    const imaging::Geometry& grid) {
  phantom::CaseOptions options;
  options.seed = 3;
  options.preset = phantom::Preset::small;
  options.variant = variant;
  options.scan = scan;
  phantom::CasePlan plan = phantom::plan_case(options);
  plan.options.scan.grid = grid;
  return phantom::scan_case(plan).image;
}

/// Where and how the slab was scanned: above the ostia, 204 mm wide.
const Vec3 slab_centre(3.0, -8.0, 50.0);
imaging::Geometry slab_grid() {
  return grid_about(slab_centre, {512, 512, 25}, {0.398, 0.398, 0.33});
}
constexpr double slab_contrast_hu = 520.0;

phantom::CaseVariant like_the_slab() {
  phantom::CaseVariant variant;
  variant.contrast_hu = slab_contrast_hu;
  return variant;
}

/// One option after the other, in one patient.
figure::Picture options_picture() {
  const auto grid = [](double z) { return grid_about({3.0, -20.0, z}, {400, 400, 3}, {0.45, 0.45, 0.45}); };
  phantom::ScanOptions ideal, real = phantom::measured_scan();
  const auto shown = [&](const std::string& title, double z, phantom::ScanOptions scan,
                         const std::function<void(phantom::ScanRealism&)>& change = {},
                         phantom::CaseVariant variant = {}) {
    if (change) change(scan.realism);
    return panel(scanned(scan, variant, grid(z)), 1, title, 400);
  };
  using R = phantom::ScanRealism;
  figure::GridOptions how;
  how.columns = 4;
  how.title = "One patient, one scanner option after the other";
  return figure::grid({shown("the ideal scanner", 46.0, ideal), shown("as measured", 46.0, real),
                       shown("iterative 0.9", 46.0, real, [](R& r) { r.iterative = 0.9; }),
                       shown("undershoot 0.15", 46.0, real, [](R& r) { r.undershoot = 0.15; }),
                       shown("noise_structure 1", 10.0, real, [](R& r) { r.noise_structure = 1.0; }),
                       shown("half_scan_motion_mm 6", 10.0, real, [](R& r) { r.half_scan_motion_mm = 6.0; }),
                       shown("6 wires, 12 clips, graft, streaks 2", 46.0, real,
                             [](R& r) {
                               r.sternal_wires = 6;
                               r.clips = 12;
                               r.streaks = 2.0;
                             },
                             {.anatomy = phantom::Anatomy::bypass, .contrast_hu = {}}),
                       shown("pacemaker_leads 2", 10.0, real, [](R& r) { r.pacemaker_leads = 2; })},
                      how);
}

void make(const fs::path& data, const fs::path& folder) {
  fs::create_directories(folder);
  std::vector<Looked> images;
  const auto read = [&](const char* file, const char* name, double from, double to) {
    if (fs::exists(data / file))
      images.push_back({name, imaging::read_image(data / file).volume, from, to});
    else
      std::printf("not there: %s\n", (data / file).c_str());
  };
  read("cta/coronary-cta-slab/slab.nrrd", "coronary CTA", 420.0, 640.0);
  const bool with_slab = !images.empty();
  read("cta/rider-pilot-chest-pe-cta/heart-crop.nrrd", "chest CTA", 180.0, 320.0);
  read("ct/calcium-score/calcium-score.nrrd", "calcium score CT", 0.0, 1.0);
  const ImageVolume ideal = scanned({}, like_the_slab(), slab_grid());
  const ImageVolume real = scanned(phantom::measured_scan(), like_the_slab(), slab_grid());
  images.push_back({"phantom, ideal scanner", ideal, 420.0, 640.0});
  images.push_back({"phantom, measured scanner", real, 420.0, 640.0});
  report(measured(images), folder);
  std::vector<figure::Picture> panels;
  if (with_slab) panels.push_back(panel(images.front().image, 12, "a patient"));
  panels.push_back(panel(ideal, 12, "phantom, ideal scanner"));
  panels.push_back(panel(real, 12, "phantom, measured scanner"));
  figure::GridOptions how;
  how.columns = 3;
  figure::grid(panels, how).write_png(folder / "side-by-side.png");
  options_picture().write_png(folder / "options.png");
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(argc, argv, "SHARED_DATA OUTPUT_FOLDER", 2,
                                    [](const std::vector<std::string>& given) { make(given[0], given[1]); });
}
