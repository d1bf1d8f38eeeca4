#include "seam_files.h"

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::testing {
namespace fs = std::filesystem;
namespace {

using geometry::Vec3;

constexpr double trunk_mm = 2.4, branch_mm = 1.9, spacing_mm = 0.4, blur_mm = 0.5;
const Vec3 root(10, 7, 4), fork(10, 7, 18), left(4, 5, 32), right(16, 5, 32);

double distance_to(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - along * (b - a)).norm();
}

/// Depth below the wall of three round pieces, mm.
double depth(const Vec3& p) {
  return std::max({trunk_mm - distance_to(p, root, fork), branch_mm - distance_to(p, fork, left),
                   branch_mm - distance_to(p, fork, right)});
}

imaging::Geometry grid() {
  imaging::Geometry g;
  g.size = {51, 36, 90};
  g.spacing = Vec3::Constant(spacing_mm);
  return g;
}

void write_image_and_mask(const fs::path& folder) {
  imaging::ImageVolume image{grid(), {}};
  imaging::MaskVolume mask{grid(), {}};
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < image.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < image.geometry.size[0]; ++i) {
        const double in =
            depth(spacing_mm * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const auto noise = static_cast<double>((73856093 * i ^ 19349663 * j ^ 83492791 * k) % 31 - 15);
        image.voxels.push_back(
            static_cast<std::int16_t>(-60.0 + 210.0 * std::erfc(-in / (std::sqrt(2.0) * blur_mm)) + noise));
        mask.voxels.push_back(in > 0.0 ? 1 : 0);
      }
  imaging::write_image(folder / "image.nrrd", image);
  imaging::write_image(folder / "mask.nrrd", mask);
}

void write_trees(const fs::path& folder) {
  core::write_file(
      folder / "tree.swc",
      "1 2 10 7 4 2.4 -1\n2 2 10 7 11 2.4 1\n3 2 10 7 18 2.2 2\n4 2 7 6 25 1.9 3\n5 2 4 5 32 1.9 4\n"
      "6 2 13 6 25 1.9 3\n7 2 16 5 32 1.9 6\n");
  // Thin enough to be grown down to its capillaries in a moment.
  core::write_file(
      folder / "twig.swc",
      "1 2 0 0 0 0.03 -1\n2 2 0 0 0.35 0.03 1\n3 2 0.15 -0.1 0.8 0.02 2\n4 2 -0.15 -0.1 0.8 0.02 2\n"
      "5 2 0.05 0.15 0.75 0.02 2\n");
}

/// Two arteries with their names, as 3D Slicer has them.
void write_named_lines(const fs::path& folder) {
  const auto curve = [](const std::string& name, const std::string& bend, const std::string& end) {
    return R"({"type": "Curve", "name": ")" + name +
           R"(", "coordinateSystem": "LPS", "controlPoints": [{"position": [10, 7, 4]}, )"
           R"({"position": [10, 7, 11]}, {"position": [10, 7, 18]}, {"position": [)" +
           bend + R"(]}, {"position": [)" + end +
           R"(]}], "measurements": [{"name": "Radius", "enabled": true, )"
           R"("controlPointValues": [2.4, 2.4, 2.2, 1.9, 1.9]}]})";
  };
  core::write_file(folder / "named.mrk.json", R"({"markups": [)" + curve("LAD", "7, 6, 25", "4, 5, 32") +
                                                  ", " + curve("LCX", "13, 6, 25", "16, 5, 32") + "]}");
}

/// The way from the root to the left end, as the Rotterdam challenge has it.
void write_reference(const fs::path& folder) {
  std::string text;
  const auto add = [&](const Vec3& from, const Vec3& to, double radius_mm) {
    const auto steps = static_cast<int>((to - from).norm() / 0.1);
    for (int i = 0; i < steps; ++i) {
      const Vec3 p = from + (to - from) * i / steps;
      for (const double value : {p.x(), p.y(), p.z(), radius_mm}) text += std::to_string(value) + " ";
      text += "0.2\n";
    }
  };
  add(root, fork, trunk_mm);
  add(fork, left, branch_mm);
  core::write_file(folder / "reference.txt", text);
}

class Maker {
 public:
  Maker() : folder(temporary_folder("seams")) {
    write_image_and_mask(folder);
    write_trees(folder);
    write_reference(folder);
    write_named_lines(folder);
    from_images();
    from_the_tree();
    of_the_model();
    of_meshes();
    of_motion();
  }
  const fs::path folder;
  std::vector<SeamFile> files;
  std::vector<std::string> faults;

 private:
  /// Runs the command; what it makes is listed.
  void make(const std::vector<std::string>& command,
            const std::vector<std::pair<std::string, SeamKind>>& makes) {
    const Outcome done = ostia(command, {folder, ""});
    std::string words = "ostia";
    for (const std::string& word : command) words += " " + word;
    if (done.code != 0 && done.code != 4)
      faults.push_back(words + ": " + std::to_string(done.code) + ": " + done.err);
    for (const auto& [name, kind] : makes) {
      if (!fs::exists(folder / name)) {
        faults.push_back(words + " has not made " + name);
      } else {
        files.push_back({name, kind, command.front()});
      }
    }
  }

  /// The first file of a folder, at any depth, with this extension.
  void take_first_of(const std::string& made, const std::string& extension, SeamKind kind) {
    for (const std::string& name : names_in(folder / made)) {
      if (fs::path(name).extension() != extension) continue;
      files.push_back({made + "/" + name, kind, "motion"});
      return;
    }
    faults.push_back(made + " has no file " + extension);
  }

  void from_images() {
    using enum SeamKind;
    const std::vector<std::string> branches{"--branch", "10,7,5:4.4,5.1,31", "--branch",
                                            "10,7,5:15.6,5.1,31"};
    make({"import", "image.nrrd", "-o", "imported.mha"}, {{"imported.mha", image}});
    make({"filter", "image.nrrd", "-o", "filtered.nrrd", "--with", "gaussian:sigma_mm=0.5"},
         {{"filtered.nrrd", image}});
    make({"convert", "mask.nrrd", "mask.mhd"}, {{"mask.mhd", mask}});
    make(std::vector<std::string>{"segment", "image.nrrd", "-o", "segmented.vtp", "--levelset",
                                  "levels.nrrd"} +
             branches,
         {{"segmented.vtp", surface}});
    make({"segment", "mask.nrrd", "-o", "masked.stl"}, {{"masked.stl", surface}});
    make({"extract", "mask.nrrd", "-o", "extracted.ostia", "--lines", "extracted.vtp"},
         {{"extracted.ostia", model_case}, {"extracted.vtp", lines}});
    make({"calcium", "image.nrrd", "-o", "calcium"},
         {{"calcium", result}, {"calcium/calcium.json", calcium}});
    make({"skeleton", "mask.nrrd", "-o", "skeleton.vtp"}, {{"skeleton.vtp", lines}});
    make({"skeleton", "mask.nrrd", "-o", "skeleton.csv"}, {{"skeleton.csv", lines}});
    const std::vector<std::string> ends{"--source",   "10,7,5",   "--target",
                                        "4.4,5.1,31", "--target", "15.6,5.1,31"};
    make(std::vector<std::string>{"centerline", "segmented.vtp", "-o", "lines.vtp", "--canal", "canal.ply"} +
             ends,
         {{"lines.vtp", lines}, {"canal.ply", surface}});
    make(std::vector<std::string>{"centerline", "segmented.vtp", "-o", "lines.csv"} + ends,
         {{"lines.csv", lines}});
    make(std::vector<std::string>{"model", "image.nrrd", "-o", "model"} + branches,
         {{"model", result},
          {"model/lumen.vtp", surface},
          {"model/lumen.stl", surface},
          {"model/centerlines.vtp", lines},
          {"model/mesh.vtu", mesh}});
  }

  void from_the_tree() {
    using enum SeamKind;
    for (const char* name : {"tree.vtp", "tree.csv"}) make({"convert", "tree.swc", name}, {{name, lines}});
    make({"reconstruct", "tree.swc", "-o", "reconstructed.vtp", "--level", "1", "--sides", "4", "--hexahedra",
          "hexahedra.vtu"},
         {{"reconstructed.vtp", surface}, {"hexahedra.vtu", mesh}});
    make({"reconstruct", "tree.swc", "-o", "reconstructed.ply", "--level", "1", "--sides", "4", "--hexahedra",
          "hexahedra"},
         {{"reconstructed.ply", surface}, {"hexahedra", mesh}});
    for (const char* name : {"grown.vtp", "grown.csv", "grown.swc"})
      make({"grow", "twig.swc", "-o", name, "--wall", "0.2"}, {{name, network}});
  }

  void of_the_model() {
    using enum SeamKind;
    make({"lumen", "lines.vtp", "-o", "lumen.vtp", "--case", "case.ostia", "--lines", "lumen_lines.vtp"},
         {{"lumen.vtp", surface}, {"case.ostia", model_case}, {"lumen_lines.vtp", lines}});
    make({"replay", "case.ostia", "-o", "replayed.ostia"}, {{"replayed.ostia", model_case}});
    make({"replay", "case.ostia", "-o", "case.jsonl"}, {{"case.jsonl", journal}});
    for (const auto& [name, kind] : std::vector<std::pair<std::string, SeamKind>>{
             {"case.stl", surface}, {"case.vtp", lines}, {"case.csv", lines}, {"case.swc", lines}})
      make({"convert", "case.ostia", name}, {{name, kind}});
    make({"convert", "case.ostia", "labels.nrrd", "--grid", "image.nrrd"}, {{"labels.nrrd", mask}});
    make({"report", "case.ostia", "-o", "report"}, {{"report", result}});
    make({"measure", "case.ostia", "-o", "measures"}, {{"measures", result}});
    make({"ffr", "case.ostia", "-o", "ffr"},
         {{"ffr", result}, {"ffr/ffr.json", ffr}, {"ffr/wall.vtp", surface}});
    make({"lumen", "named.mrk.json", "-o", "named.vtp", "--case", "named.ostia"},
         {{"named.vtp", surface}, {"named.ostia", named_case}});
    make({"convert", "named.ostia", "named_out.mrk.json"}, {{"named_out.mrk.json", lines}});
    make({"replay", "named.ostia", "-o", "named_again.ostia"}, {{"named_again.ostia", named_case}});
    make({"carry", "named.ostia", "--old-image", "image.nrrd", "--new-image", "filtered.nrrd", "-o",
          "carried.ostia"},
         {{"carried.ostia", carried_case}});
    make({"compare", "named.ostia", "named_again.ostia", "-o", "compared"}, {{"compared", result}});
    make({"fat", "named.ostia", "--image", "image.nrrd", "-o", "fat"}, {{"fat", result}});
    make({"territories", "named.ostia", "--myocardium", "mask.nrrd", "-o", "territories"},
         {{"territories", result}});
    make({"dicom", "named.ostia", "--image", "image.nrrd", "-o", "objects"},
         {{"objects/segmentation.dcm", dicom_object},
          {"objects/segmentation.dcm", mask},
          {"objects/measurements.dcm", dicom_object}});
  }

  void of_meshes() {
    using enum SeamKind;
    make({"mesh", "segmented.vtp", "-o", "mesh", "--centerline", "lines.vtp", "--layers", "2", "--export",
          "openfoam,gmsh2,gmsh4,fluent,abaqus,xdmf,exodus,cgns"},
         {{"mesh", result},
          {"mesh/lumen.vtp", surface},
          {"mesh/lumen.stl", surface},
          {"mesh/mesh.vtu", mesh},
          {"mesh/openfoam", mesh},
          {"mesh/mesh-gmsh2.msh", mesh},
          {"mesh/mesh-gmsh4.msh", mesh},
          {"mesh/mesh-fluent.msh", mesh},
          {"mesh/mesh.inp", mesh},
          {"mesh/xdmf", mesh},
          {"mesh/mesh.exo", mesh},
          {"mesh/mesh.cgns", mesh}});
    make({"mesh", "case.ostia", "-o", "case_mesh"},
         {{"case_mesh", result}, {"case_mesh/mesh.vtu", mesh}, {"case_mesh/centerlines.vtp", lines}});
    make({"convert", "mesh/mesh.vtu", "boundary.vtp"}, {{"boundary.vtp", surface}});
    make({"case", "mesh/mesh.vtu", "-o", "flow"}, {{"flow/mesh.vtu", mesh}});
  }

  void of_motion() {
    using enum SeamKind;
    fs::create_directory(folder / "phases");
    for (const char* name : {"p0.vtp", "p30.vtp", "p75.vtp"})
      fs::copy_file(folder / "lumen.vtp", folder / "phases" / name);
    make({"motion", "fit", "phases", "-o", "beating", "--depth", "1"},
         {{"beating", motion}, {"beating/motion.json", motion}});
    make({"motion", "apply", "beating", "lumen.vtp", "-o", "carried.vtp", "--phase", "30"},
         {{"carried.vtp", surface}});
    make({"motion", "apply", "beating", "lines.vtp", "-o", "carried_lines.vtp", "--phase", "30"},
         {{"carried_lines.vtp", lines}});
    make({"motion", "apply", "beating", "lines.vtp", "-o", "carried_lines.csv", "--phase", "30"},
         {{"carried_lines.csv", lines}});
    make({"motion", "apply", "beating", "mesh/mesh.vtu", "-o", "carried.vtu", "--phase", "30"},
         {{"carried.vtu", mesh}});
    make({"motion", "export", "beating", "-o", "moving", "--mesh", "mesh/mesh.vtu", "--times", "3",
          "--format", "vtp,stl,vtu,openfoam,csv,json"},
         {{"moving", result}});
    take_first_of("moving", ".vtp", surface);
    take_first_of("moving", ".stl", surface);
    take_first_of("moving", ".vtu", mesh);
    make({"motion", "measure", "beating", "lines.vtp", "-o", "motion_measures", "--times", "4"},
         {{"motion_measures", result}});
  }
};

const Maker& maker() {
  static const Maker made;
  return made;
}

}  // namespace

const std::vector<SeamFile>& seam_files() {
  return maker().files;
}
const fs::path& seam_folder() {
  return maker().folder;
}
const std::vector<std::string>& seam_faults() {
  return maker().faults;
}

}  // namespace ostia::testing
