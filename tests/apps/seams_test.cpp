// Our own output is our own input: every file that a command writes, read by every command that reads such
// files.

#include "program.h"
#include "seam_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

namespace ostia::testing {
namespace {

using enum SeamKind;

/// A command with "{}" for the file that it reads and "{out}" for what it makes.
struct Reader {
  std::string name;
  std::vector<SeamKind> kinds;
  std::vector<std::string> words;
};

const std::vector<Reader>& readers() {
  const std::vector<std::string> ends{"--source",   "10,7,5",   "--target",
                                      "4.4,5.1,31", "--target", "15.6,5.1,31"};
  static const std::vector<Reader> all{
      {"info",
       {image, mask, surface, lines, network, mesh, model_case, named_case, carried_case, motion, result},
       {"info", "{}", "--json"}},
      {"import", {image}, {"import", "{}", "-o", "{out}.nrrd"}},
      {"filter", {image, mask}, {"filter", "{}", "-o", "{out}.nrrd", "--with", "gaussian:sigma_mm=0.5"}},
      {"carry",
       {named_case},
       {"carry", "{}", "-o", "{out}.ostia", "--old-image", "image.nrrd", "--new-image", "filtered.nrrd"}},
      {"convert_image", {image, mask}, {"convert", "{}", "{out}.mha"}},
      {"segment", {image}, {"segment", "{}", "-o", "{out}.vtp", "--branch", "10,7,5:4.4,5.1,31"}},
      {"segment_mask", {mask}, {"segment", "{}", "-o", "{out}.vtp"}},
      {"skeleton", {mask}, {"skeleton", "{}", "-o", "{out}.vtp"}},
      {"extract", {mask}, {"extract", "{}", "-o", "{out}.ostia"}},
      {"convert_surface", {surface}, {"convert", "{}", "{out}.ply"}},
      {"repair", {surface}, {"convert", "{}", "{out}.vtp", "--repair"}},
      {"centerline", {surface}, std::vector<std::string>{"centerline", "{}", "-o", "{out}.vtp"} + ends},
      {"measure_surface", {surface}, std::vector<std::string>{"measure", "{}", "-o", "{out}"} + ends},
      {"mesh", {surface}, {"mesh", "{}", "-o", "{out}"}},
      {"model_surface", {surface}, {"model", "{}", "-o", "{out}"}},
      {"mesh_mask", {mask}, {"mesh", "{}", "-o", "{out}"}},
      {"model_mask", {mask}, {"model", "{}", "-o", "{out}"}},
      {"mesh_with_lines", {lines}, {"mesh", "segmented.vtp", "-o", "{out}", "--centerline", "{}"}},
      {"mesh_check", {surface, mesh}, {"mesh", "--check", "{}"}},
      {"lumen_surface", {surface}, {"lumen", "lines.vtp", "-o", "{out}.vtp", "--surface", "{}"}},
      {"evaluate_volume", {surface}, {"evaluate", "volume", "lumen.vtp", "{}", "--resolution", "1"}},
      {"evaluate_volume_of_mask", {mask}, {"evaluate", "volume", "mask.nrrd", "{}"}},
      {"evaluate_surface", {surface}, {"evaluate", "surface", "lumen.vtp", "{}", "--sample", "1"}},
      {"reconstruct_wall",
       {surface},
       {"reconstruct", "tree.swc", "-o", "{out}.vtp", "--level", "0", "--wall", "{}"}},
      {"motion_apply_surface",
       {surface},
       {"motion", "apply", "beating", "{}", "-o", "{out}.vtp", "--phase", "30"}},
      {"motion_export_surface",
       {surface},
       {"motion", "export", "beating", "-o", "{out}", "--surface", "{}", "--times", "2"}},
      {"convert_lines", {lines, network}, {"convert", "{}", "{out}.csv"}},
      {"convert_to_swc", {lines, network}, {"convert", "{}", "{out}.swc"}},
      {"measure", {lines, network, model_case, carried_case}, {"measure", "{}", "-o", "{out}"}},
      {"reconstruct", {lines, network}, {"reconstruct", "{}", "-o", "{out}.vtp", "--level", "0"}},
      {"lumen", {lines, model_case}, {"lumen", "{}", "-o", "{out}.stl"}},
      {"evaluate_centerline", {lines}, {"evaluate", "centerline", "reference.txt", "{}"}},
      {"motion_apply_lines",
       {lines},
       {"motion", "apply", "beating", "{}", "-o", "{out}.vtp", "--phase", "30"}},
      {"motion_measure",
       {lines, model_case},
       {"motion", "measure", "beating", "{}", "-o", "{out}", "--times", "3"}},
      {"grow", {network}, {"grow", "{}", "-o", "{out}.vtp", "--wall", "0.2"}},
      {"convert_mesh", {mesh}, {"convert", "{}", "{out}.msh"}},
      {"convert_to_openfoam", {mesh}, {"convert", "{}", "{out}"}},
      {"boundary", {mesh}, {"convert", "{}", "{out}.vtp"}},
      {"case", {mesh}, {"case", "{}", "-o", "{out}"}},
      {"motion_apply_mesh", {mesh}, {"motion", "apply", "beating", "{}", "-o", "{out}.vtu", "--phase", "30"}},
      {"motion_export_mesh",
       {mesh},
       {"motion", "export", "beating", "-o", "{out}", "--mesh", "{}", "--times", "2"}},
      {"mesh_case", {model_case, carried_case}, {"mesh", "{}", "-o", "{out}"}},
      {"convert_case", {model_case, carried_case}, {"convert", "{}", "{out}.stl"}},
      {"report", {model_case, carried_case}, {"report", "{}", "-o", "{out}"}},
      {"report_calcium", {calcium}, {"report", "case.ostia", "-o", "{out}", "--calcium", "{}"}},
      {"ffr", {lines, model_case}, {"ffr", "{}", "-o", "{out}"}},
      {"compare_former", {named_case, carried_case}, {"compare", "{}", "named.ostia", "-o", "{out}"}},
      {"compare_later", {named_case, carried_case}, {"compare", "named.ostia", "{}", "-o", "{out}"}},
      {"compare_images",
       {image},
       {"compare", "named.ostia", "named.ostia", "-o", "{out}", "--old-image", "{}", "--new-image", "{}"}},
      {"fat", {image}, {"fat", "named.ostia", "-o", "{out}", "--image", "{}"}},
      {"fat_of_case", {named_case}, {"fat", "{}", "-o", "{out}", "--image", "image.nrrd"}},
      {"territories",
       {lines, model_case, named_case, carried_case},
       {"territories", "{}", "-o", "{out}", "--myocardium", "mask.nrrd"}},
      {"territories_of_mask", {mask}, {"territories", "named.ostia", "-o", "{out}", "--myocardium", "{}"}},
      {"dicom",
       {model_case, named_case},
       {"dicom", "{}", "-o", "{out}", "--image", "image.nrrd", "--objects", "seg,sr"}},
      {"dicom_ffr",
       {ffr},
       {"dicom", "case.ostia", "-o", "{out}", "--image", "image.nrrd", "--objects", "sr", "--ffr", "{}"}},
      {"dicom_object", {dicom_object}, {"dicom", "{}"}},
      {"replay", {model_case, named_case, carried_case, journal}, {"replay", "{}", "-o", "{out}.ostia"}},
      {"motion_apply", {motion}, {"motion", "apply", "{}", "lines.vtp", "-o", "{out}.csv", "--phase", "50"}},
      {"motion_export", {motion}, {"motion", "export", "{}", "-o", "{out}", "--times", "2"}},
      {"motion_evaluate", {motion}, {"motion", "evaluate", "{}", "phases", "--sample", "1"}},
      {"motion_measure_motion",
       {motion},
       {"motion", "measure", "{}", "lines.vtp", "-o", "{out}", "--times", "3"}},
  };
  return all;
}

std::string replaced(std::string word, const std::string& what, const std::string& by) {
  const std::size_t at = word.find(what);
  return at == std::string::npos ? word : word.replace(at, what.size(), by);
}

/// Letters and digits alone, as a name of an output.
std::string plain(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return text;
}

class Seams : public ::testing::TestWithParam<Reader> {};

TEST(SeamFiles, AreAllMade) {
  for (const std::string& fault : seam_faults()) ADD_FAILURE() << fault;
  EXPECT_GT(seam_files().size(), 60u);
}

TEST_P(Seams, ReadsWhatOtherCommandsWrite) {
  const Reader& reader = GetParam();
  std::size_t read = 0;
  for (const SeamFile& file : seam_files()) {
    if (std::find(reader.kinds.begin(), reader.kinds.end(), file.kind) == reader.kinds.end()) continue;
    const std::string out = "out_" + reader.name + "_" + plain(file.name);
    std::vector<std::string> command;
    for (const std::string& word : reader.words)
      command.push_back(replaced(replaced(word, "{out}", out), "{}", file.name));
    const Outcome done = ostia(command, {seam_folder(), ""});
    // 4: done, and a person must look at it, which is no refusal.
    EXPECT_TRUE(done.code == 0 || done.code == 4)
        << file.name << " of `ostia " << file.by << "`: " << done.code << ": " << done.err;
    ++read;
  }
  EXPECT_GT(read, 0u) << "no command writes what this one reads";
}

INSTANTIATE_TEST_SUITE_P(Commands, Seams, ::testing::ValuesIn(readers()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace ostia::testing
