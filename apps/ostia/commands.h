#pragma once
/// \file What each command is told, and what it does. Returns the exit code; throws ostia::Error.

#include "flow/case_options.h"

#include "ostia/core/error.h"
#include "ostia/core/task_context.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::app {

/// Options that every command has.
struct CommonOptions {
  int threads = 0;
  std::uint64_t seed = 1;
  std::string log = "text";
  std::string progress = "auto";
  bool quiet = false;
};

/// How an input is to be read.
struct InputOptions {
  std::filesystem::path input;
  std::string series;
  bool resample = false;
  std::optional<double> pixel_spacing_mm, slice_spacing_mm;
  std::string units;           ///< "", "m", "cm", "mm"
  bool strict = false;         ///< a surface with faults is refused instead of mended
  std::string coords = "lps";  ///< of points on the command line: lps, ras, ijk
};

struct InfoOptions {
  InputOptions input;
  bool json = false;
  std::filesystem::path preview;
  std::string position;
  int preview_slices = 12;
};
ExitCode run_info(const InfoOptions& options, const core::TaskContext& task);

struct ImportOptions {
  InputOptions input;
  std::filesystem::path output;
  bool json = false;
};
ExitCode run_import(const ImportOptions& options, const core::TaskContext& task);

/// How a lumen is found in an image.
struct LumenOptions {
  std::vector<std::string> branches;
  std::optional<double> lower_hu, upper_hu;
  std::string feature = "edges";        ///< edges, upwind, centred, gaussian
  double gaussian_sigma_mm = 0.0;       ///< 0: the least spacing
  std::string curvature_term = "mean";  ///< mean, minimal
  bool balloon = false;
  double balloon_tau = 0.2;
  std::optional<double> balloon_mean_hu, balloon_sigma_hu;
  std::string denoise;  ///< "", flux, gradient, curvature
  int denoise_iterations = -1;
  double denoise_contrast = 0.0;
  std::vector<std::string> remove;                              ///< bone, calcium, skin
  double curvature = -1.0, inflation = -1.0, advection = -1.0;  ///< negative: the library's default
  int iterations = -1;
  bool whole_volume = false;
  bool bright_is_lumen = false;
  int smooth = 0;  ///< Taubin iterations
};

struct SegmentCommand {
  InputOptions input;
  std::filesystem::path keep;  ///< for what was made when it fails
  LumenOptions lumen;
  std::filesystem::path output, level_set;
  bool aorta = false;  ///< instead of the vessels between seed points
  bool json = false;
};
ExitCode run_segment(const SegmentCommand& options, const core::TaskContext& task);

struct EndOptions {
  std::string source;
  std::vector<std::string> targets;
  std::string seed_units;  ///< of these places: "" (the input's own), m, cm, mm
  double step_mm = 0.0;    ///< 0: the library's default
};

struct CenterlineCommand {
  InputOptions input;
  EndOptions ends;
  std::filesystem::path output, canal;
  bool json = false;
};
ExitCode run_centerline(const CenterlineCommand& options, const core::TaskContext& task);

struct MeshOptions {
  double edge_ratio = 0.0;  ///< 0: the library's default
  std::string size = "distance";
  double min_edge_mm = 0.0, max_edge_mm = 0.0;
  std::optional<double> most_distance_radii, curvature_ratio, stenosis_share;
  double size_factor = 0.0;
  double inset_radii = -1.0;         ///< negative: the library's default
  std::optional<double> extensions;  ///< in diameters
  int layers = 0;
  std::optional<double> layer_thickness, layer_growth;  ///< nothing: the library's default
  bool split_prisms = false;
  int order = 1;
  std::vector<std::string> formats;      ///< besides mesh.vtu
  std::vector<std::string> planes;       ///< [END=]x,y,z:nx,ny,nz
  std::filesystem::path planes_file;     ///< the same as a table
  std::string ends = "flat";             ///< flat, as-they-are, round
  std::string side_branches = "closed";  ///< of those that no target lies on: closed, axes, stubs
  std::string size_array;                ///< of the input's points
  std::string with_case;                 ///< empty: none; else the solver
  CaseOptions solver_case;
};

/// Which labels of a mask are coronary arteries.
struct MaskOptions {
  bool mask = false;            ///< the input is a mask, whatever its values look like
  std::vector<int> labels;      ///< that are vessels; empty: all but 0
  std::filesystem::path image;  ///< the CT that it was drawn on; empty: none
};

struct MeshCommand {
  InputOptions input;
  MaskOptions of_mask;
  std::filesystem::path keep;  ///< for what was made when it fails
  EndOptions ends;
  MeshOptions mesh;
  std::filesystem::path output, centerline, check;
  std::filesystem::path refine_from;                                       ///< a solver's result; empty: none
  std::string refine_by;                                                   ///< its field
  std::optional<double> refine_error, refine_elements, refine_coarsening;  ///< nothing: the library's default
  bool forecast = false;
  bool json = false;
};
ExitCode run_mesh(const MeshCommand& options, const core::TaskContext& task);

/// How a tree of vessels is to be read.
struct TreeInputOptions {
  bool repair = false;
  std::vector<std::string> roots;  ///< x,y,z, or files of points
  double merge_mm = 0.0;           ///< points no further apart are one
  std::string radius_units;        ///< empty: as the places
  bool keep_directions = false;
};

struct ConvertCommand {
  InputOptions input;
  std::filesystem::path output;
  TreeInputOptions tree;       ///< its `repair` is for surfaces, too
  double fill_holes_mm = 0.0;  ///< 0: none
  bool keep_parts = false, largest_part = false;
  int smooth = 0;              ///< Taubin iterations
  int subdivide = 0;           ///< levels
  std::string format;          ///< of a volume mesh; empty: by the output's extension
  bool landmarks = false;      ///< as markups: the places where vessels begin, divide and end
  std::filesystem::path grid;  ///< of labels of a case: the CT; empty: none are asked for
  std::string labels;          ///< "" (lumen), lumen, segments, wall, plaque
  bool json = false;
};
ExitCode run_convert(const ConvertCommand& options, const core::TaskContext& task);

struct ModelCommand {
  InputOptions input;
  MaskOptions of_mask;
  std::filesystem::path keep;  ///< for what was made when it fails
  LumenOptions lumen;
  EndOptions ends;
  MeshOptions mesh;
  std::filesystem::path output;
  bool builtin = false;
  bool json = false;
  std::uint64_t seed = 1;
};
ExitCode run_model(const ModelCommand& options, const core::TaskContext& task);

struct PhantomCommand {
  std::filesystem::path output;
  std::string preset = "full";
  std::string suite = "usual";  ///< "hard": each case's patient and scan are drawn
  int cases = 1, phases = 1;
  bool truth_only = false, no_report = false;
  std::vector<std::string> formats;  ///< mhd, nrrd, dicom; none: all
  double disease = 1.0, calcium = 1.0, stent_mm = 0.0, venous = 0.0;
  std::string anatomy = "usual";
  std::filesystem::path tree;         ///< a patient's, as mask or case; empty: drawn
  std::optional<double> tree_rim_mm;  ///< of each radius, that is no lumen
  std::optional<double> contrast_hu;
  std::string scanner = "ideal";     ///< or "measured"
  std::vector<std::string> realism;  ///< name=value of phantom::ScanRealism
  std::optional<double> noise_hu, blur_mm, blur_z_mm, motion_mm, stair_step_mm, beam_hardening;
  std::optional<double> contour_spacing_mm, surface_spacing_mm;
  int contour_points = 0;  ///< 0: the library's default
  bool json = false;
  std::uint64_t seed = 1;
};
ExitCode run_phantom(const PhantomCommand& options, const core::TaskContext& task);

}  // namespace ostia::app
