#include "ostia/phantom/hard_suite.h"

#include "ostia/core/error.h"
#include "ostia/core/quasi_random.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ostia::phantom {
namespace {

constexpr std::uint64_t hard_stream = 0x68617264ULL;

struct HardRow {
  HardQuantity quantity;
  double& (*place)(HardDraw&) = nullptr;     // where its value goes
  double HardStrength::*strength = nullptr;  // what its middle is multiplied by
};

const std::vector<HardRow>& hard_rows() {
  static const std::vector<HardRow> rows{
      {{"contrast", "HU", 1.0, 0.0, Spread::normal, 420.0, 90.0, 220.0, 700.0,
        "426 HU in the left main of one scanner's patients, 586 HU of another's (Int. J. Cardiovasc. "
        "Imaging, "
        "PMC5963691)"},
       [](HardDraw& d) -> double& { return d.contrast_hu; }},
      {{"venous contrast", "of the arterial", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.1, 0.9,
        "veins and right heart beside what they have anyway: from a saline chaser to none; the great veins "
        "are seen in every coronary scan (339 of 339, Diagn. Interv. Radiol. dir.2013.012)"},
       [](HardDraw& d) -> double& { return d.venous; },
       &HardStrength::venous},
      {{"noise", "HU", 1.0, 0.0, Spread::log_normal, 35.0, 0.3, 15.0, 80.0,
        "32 and 52 HU there, by the same; scans are set to 33 or 51 HU elsewhere (Di Cesare et al. 2018)"},
       [](HardDraw& d) -> double& { return d.noise_hu; },
       &HardStrength::noise},
      {{"peak of the noise's spectrum", "cycles a mm", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.12, 0.28,
        "smooth to sharp kernels"},
       [](HardDraw& d) -> double& { return d.noise_peak_per_mm; }},
      {{"blur in the plane", "mm", 1.0, 0.0, Spread::normal, 0.8, 0.12, 0.55, 1.6,
        "full width at half maximum; smooth cardiac kernels have 0.7 to 0.9 mm"},
       [](HardDraw& d) -> double& { return d.psf_fwhm_mm; },
       &HardStrength::blur},
      {{"slice", "mm", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.6, 1.2,
        "thickness; 0.6 to 0.75 mm usually, 1 mm and more of older scanners and heavy patients"},
       [](HardDraw& d) -> double& { return d.slice_mm; }},
      {{"motion during the exposure", "mm", 1.0, 0.0, Spread::log_normal, 0.7, 0.7, 0.0, 4.0,
        "arteries move at 22 to 109 mm/s (Mao et al. 2000), at rest less than 1 mm for 65 to 112 ms in the "
        "mean "
        "(PMC2396325); an exposure takes 66 to 165 ms"},
       [](HardDraw& d) -> double& { return d.motion_mm; },
       &HardStrength::motion},
      {{"step between blocks of slices", "mm", 0.25, 0.0, Spread::uniform, 0.0, 0.0, 0.5, 2.0,
        "beats that are not alike, breath that is not held"},
       [](HardDraw& d) -> double& { return d.stair_step_mm; },
       &HardStrength::motion},
      {{"beam hardening", "", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.3, 1.5, "1 is usual"},
       [](HardDraw& d) -> double& { return d.beam_hardening; }},
      {{"disease", "", 1.0, 0.0, Spread::log_normal, 1.0, 0.5, 0.2, 3.0, "number of lesions over the usual"},
       [](HardDraw& d) -> double& { return d.disease; }},
      {{"calcium", "", 0.48, 0.0, Spread::log_normal, 1.5, 0.6, 1.0, 10.0,
        "none in 52 % of 2,730 who were scanned (Mittal et al. 2017)"},
       [](HardDraw& d) -> double& { return d.calcium; }},
      {{"stent", "mm", 0.06, 0.0, Spread::uniform, 0.0, 0.0, 12.0, 28.0,
        "few of those who are scanned have one"},
       [](HardDraw& d) -> double& { return d.stent_mm; }},
      {{"noise along thick parts", "", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.2, 0.7,
        "1: without a bowtie and tube current modulation"},
       [](HardDraw& d) -> double& { return d.realism.noise_structure; }},
      {{"iterative reconstruction", "", 0.6, 0.0, Spread::uniform, 0.0, 0.0, 0.2, 0.7,
        "share of noise it takes out"},
       [](HardDraw& d) -> double& { return d.realism.iterative; }},
      {{"undershoot", "of the edge", 0.4, 0.0, Spread::uniform, 0.0, 0.0, 0.02, 0.1, "sharp kernels"},
       [](HardDraw& d) -> double& { return d.realism.undershoot; }},
      {{"tails of the blur", "", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.05, 0.25, "blooming"},
       [](HardDraw& d) -> double& { return d.realism.tail; }},
      {{"streaks", "", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.2, 1.5, "1 is usual beside a bright cava"},
       [](HardDraw& d) -> double& { return d.realism.streaks; }},
      {{"bad mixing", "", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.2, 0.9,
        "of contrast in cava and right heart"},
       [](HardDraw& d) -> double& { return d.realism.mixing; }},
      {{"superior cava", "HU", 0.5, 0.0, Spread::uniform, 0.0, 0.0, 500.0, 1500.0, "undiluted contrast"},
       [](HardDraw& d) -> double& { return d.realism.cava_hu; }},
      {{"calibre", "of the usual", 1.0, 0.0, Spread::normal, 0.95, 0.1, 0.7, 1.15,
        "half of them women, whose arteries are 9 % thinner than men's (Dodge et al. 1992)"},
       [](HardDraw& d) -> double& { return d.obstacles.calibre; }},
      {{"contrast lost along 100 mm", "of that above blood", 1.0, 0.0, Spread::normal, 0.3, 0.15, 0.05, 0.6,
        "a median of 11 HU each 10 mm of arteries without and 21 HU of those with a stenosis that matters "
        "(Wong et al. 2013), 2 to 13 HU of another scanner's (Choi et al. 2011)"},
       [](HardDraw& d) -> double& { return d.obstacles.contrast_fall; },
       &HardStrength::fall},
      {{"nearness of veins", "", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.6, 1.0,
        "0: 1.6 mm of fat between them and the arteries' walls; 1: none"},
       [](HardDraw& d) -> double& { return d.obstacles.vein_closeness; },
       &HardStrength::contact},
      {{"lobes that touch an artery", "of the places", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.2, 1.0,
        "of auricles, atria and pulmonary trunk, at nine places"},
       [](HardDraw& d) -> double& { return d.obstacles.lobes; },
       &HardStrength::contact},
      {{"fat in the grooves", "of the usual", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.6, 1.0,
        "lean and stout patients"},
       [](HardDraw& d) -> double& { return d.obstacles.groove_fat; }},
      {{"long calcium", "mm", 0.6, 0.0, Spread::log_normal, 40.0, 0.8, 8.0, 180.0,
        "in stretches of 8 to 38 mm beside the lumen, 700 to 1,500 HU"},
       [](HardDraw& d) -> double& { return d.obstacles.calcified_mm; },
       &HardStrength::calcium},
      {{"closed stretches", "", 0.1, 0.0, Spread::uniform, 0.0, 0.0, 0.5, 2.0,
        "rounded; 1.4 % of 23,745 who were scanned, 6.2 % of those with a stenosis (Opolski et al. 2015), 10 "
        "to 20 % of those with a catheter; 6 to 25 mm long, what lies behind is filled from elsewhere"},
       [](HardDraw& d) -> double& { return d.obstacles.closed; },
       &HardStrength::closed},
      {{"contrast behind them", "of the usual", 1.0, 0.0, Spread::uniform, 0.0, 0.0, 0.4, 0.85,
        "by collaterals"},
       [](HardDraw& d) -> double& { return d.obstacles.filling; }},
  };
  return rows;
}

/// Shares of all cases; what is left is usual. Origins: Erol and Seker 2011, 2,096 patients.
constexpr std::array<std::pair<Anatomy, double>, 5> rare_anatomies{{{Anatomy::bypass, 0.03},
                                                                    {Anatomy::lcx_from_right, 0.0043},
                                                                    {Anatomy::rca_from_left, 0.0043},
                                                                    {Anatomy::left_ostium_closed, 0.005},
                                                                    {Anatomy::right_ostium_closed, 0.01}}};
constexpr double operated_share = 0.04, paced_share = 0.04;
constexpr std::size_t anatomy_row = 100, metal_row = 101;

/// Uniform in (0, 1), of seed and row.
double hard_uniform(std::uint64_t seed, std::size_t row, std::uint64_t which = 0) {
  return uniform(seed, hard_stream + 8 * row + which);
}

double drawn_value(const HardQuantity& row, double p, double factor) {
  double value = row.least + p * (row.most - row.least);
  if (row.spread == Spread::normal) value = row.middle + row.width * core::normal_quantile(p);
  if (row.spread == Spread::log_normal) value = row.middle * std::exp(row.width * core::normal_quantile(p));
  // A factor of 0 takes the quantity away, whatever its least value.
  return factor == 0.0 ? 0.0 : std::clamp(factor * value, row.least, row.most);
}

Anatomy drawn_anatomy(double p) {
  for (const auto& [anatomy, share] : rare_anatomies) {
    if (p < share) return anatomy;
    p -= share;
  }
  return Anatomy::usual;
}

double in_plane_mm(Preset preset) {
  switch (preset) {
    case Preset::tiny:
      return 0.5;
    case Preset::small:
      return 0.7;
    case Preset::full:
      break;
  }
  return 0.35;
}

/// What operations and devices leave behind.
void give_metal(std::uint64_t seed, bool grafted, ScanRealism& realism) {
  const double p = hard_uniform(seed, metal_row);
  realism.ecg_leads = 3;
  realism.stent_struts = true;
  if (grafted || p < operated_share) {
    realism.sternal_wires = 4 + static_cast<int>(3.0 * hard_uniform(seed, metal_row, 1));
    realism.clips = 4 + static_cast<int>(12.0 * hard_uniform(seed, metal_row, 2));
  } else if (p < operated_share + paced_share) {
    realism.pacemaker_leads = hard_uniform(seed, metal_row, 1) < 0.3 ? 1 : 2;
  }
}

}  // namespace

const char* word(Spread spread) {
  switch (spread) {
    case Spread::normal:
      return "normal";
    case Spread::log_normal:
      return "log-normal";
    case Spread::uniform:
      break;
  }
  return "uniform";
}

void validate(const HardStrength& strength) {
  for (const auto& [name, value] :
       {std::pair("noise", strength.noise), std::pair("blur", strength.blur),
        std::pair("motion", strength.motion), std::pair("venous contrast", strength.venous),
        std::pair("contact", strength.contact), std::pair("calcium", strength.calcium),
        std::pair("contrast lost", strength.fall), std::pair("closed stretches", strength.closed)})
    if (!(value >= 0.0 && value <= 5.0))
      throw InvalidInput(std::string("suite hard: the strength of ") + name + " must be 0 to 5");
}

std::vector<HardQuantity> hard_quantities() {
  std::vector<HardQuantity> out;
  for (const HardRow& row : hard_rows()) out.push_back(row.quantity);
  return out;
}

HardDraw draw_hard(std::uint64_t seed, const HardStrength& strength) {
  validate(strength);
  HardDraw draw;
  const std::vector<HardRow>& rows = hard_rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HardQuantity& row = rows[i].quantity;
    const bool has = hard_uniform(seed, i) < row.share;
    const double factor = rows[i].strength ? strength.*rows[i].strength : 1.0;
    rows[i].place(draw) = has ? drawn_value(row, hard_uniform(seed, i, 1), factor) : row.without;
  }
  draw.anatomy = drawn_anatomy(hard_uniform(seed, anatomy_row));
  give_metal(seed, draw.anatomy == Anatomy::bypass, draw.realism);
  return draw;
}

std::vector<double> values_of(const HardDraw& draw) {
  HardDraw own = draw;
  std::vector<double> out;
  for (const HardRow& row : hard_rows()) out.push_back(row.place(own));
  return out;
}

CaseOptions hard_case(const CaseOptions& usual, const HardStrength& strength) {
  const HardDraw draw = draw_hard(usual.seed, strength);
  CaseOptions out = usual;
  out.disease = draw.disease;
  out.variant = {out.patient ? Anatomy::usual : draw.anatomy, draw.calcium, draw.stent_mm, draw.contrast_hu,
                 draw.venous};
  out.obstacles = draw.obstacles;
  // Who has long calcium has that of plaques, too.
  if (draw.obstacles.calcified_mm > 0.0) out.variant.calcium = std::max(out.variant.calcium, 1.0);
  ScanOptions& scan = out.scan;
  scan.noise_hu = draw.noise_hu;
  constexpr double most_cycles_a_voxel = 0.17;
  scan.noise_peak_per_mm = std::min(draw.noise_peak_per_mm, most_cycles_a_voxel / in_plane_mm(usual.preset));
  scan.psf_fwhm_mm = draw.psf_fwhm_mm;
  scan.psf_fwhm_z_mm = scan.noise_fwhm_z_mm = draw.slice_mm;
  scan.motion_mm = draw.motion_mm;
  scan.stair_step_mm = draw.stair_step_mm;
  scan.beam_hardening = draw.beam_hardening;
  scan.realism = draw.realism;
  return out;
}

}  // namespace ostia::phantom
