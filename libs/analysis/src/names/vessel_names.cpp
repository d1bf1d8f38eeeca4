#include "names/vessel_names.h"

#include "names/vessel_way.h"

#include "ostia/analysis/aha_segments.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <utility>

namespace ostia::analysis {
namespace {

constexpr std::array<VesselKind, 14> reading_order{
    VesselKind::rca, VesselKind::right,    VesselKind::acute,    VesselKind::pda,     VesselKind::plb,
    VesselKind::lm,  VesselKind::lad,      VesselKind::diagonal, VesselKind::septal,  VesselKind::ramus,
    VesselKind::lcx, VesselKind::marginal, VesselKind::left_pda, VesselKind::left_plb};

/// Whether a vessel begins at the ostium of the left coronary artery.
bool begins_left(const geometry::VesselTree& tree, const geometry::Vessel& vessel) {
  return std::any_of(tree.vessels.begin(), tree.vessels.end(), [&](const geometry::Vessel& other) {
    const VesselKind kind = parsed(other.name).kind;
    return (kind == VesselKind::lad || kind == VesselKind::lcx || kind == VesselKind::lm) &&
           !other.segments.empty() && !vessel.segments.empty() &&
           other.segments.front() == vessel.segments.front();
  });
}

/// The vessel that it leaves; null for one that begins at a root.
const geometry::Vessel* parent_of(const geometry::VesselTree& tree, const geometry::Vessel& vessel) {
  for (std::size_t i = vessel.segments.size(); i-- > 0;) {
    const geometry::Vessel& owner = owner_of_segment(tree, vessel.segments[i]);
    if (owner.id != vessel.id) return &owner;
  }
  return nullptr;
}

/// Its place in the reading order, and its number.
std::pair<std::size_t, std::size_t> kind_of(const geometry::VesselTree& tree,
                                            const geometry::Vessel& vessel) {
  const ParsedName name = parsed(vessel.name);
  VesselKind kind = name.kind;
  if (begins_left(tree, vessel)) {
    if (kind == VesselKind::pda) kind = VesselKind::left_pda;
    if (kind == VesselKind::plb) kind = VesselKind::left_plb;
  }
  const auto at = std::find(reading_order.begin(), reading_order.end(), kind);
  return {static_cast<std::size_t>(at - reading_order.begin()),
          static_cast<std::size_t>(std::max(name.number, 0))};
}

}  // namespace

ParsedName parsed(const std::string& name) {
  static const std::map<std::string, VesselKind> known{
      {"LM", VesselKind::lm},          {"LMCA", VesselKind::lm},           {"LEFTMAIN", VesselKind::lm},
      {"LAD", VesselKind::lad},        {"LCX", VesselKind::lcx},           {"CX", VesselKind::lcx},
      {"CIRCUMFLEX", VesselKind::lcx}, {"RCA", VesselKind::rca},           {"D", VesselKind::diagonal},
      {"DIAG", VesselKind::diagonal},  {"DIAGONAL", VesselKind::diagonal}, {"S", VesselKind::septal},
      {"SEPTAL", VesselKind::septal},  {"OM", VesselKind::marginal},       {"M", VesselKind::marginal},
      {"RI", VesselKind::ramus},       {"IM", VesselKind::ramus},          {"RAMUS", VesselKind::ramus},
      {"PDA", VesselKind::pda},        {"RPDA", VesselKind::pda},          {"PLB", VesselKind::plb},
      {"PL", VesselKind::plb},         {"PLV", VesselKind::plb},           {"RPLB", VesselKind::plb},
      {"RPL", VesselKind::plb},        {"LPDA", VesselKind::left_pda},     {"LPLB", VesselKind::left_plb},
      {"LPL", VesselKind::left_plb},   {"AM", VesselKind::acute},          {"CB", VesselKind::right},
      {"CONUS", VesselKind::right},    {"RV", VesselKind::right},
  };
  ParsedName result;
  std::string letters;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isdigit(byte) != 0 && result.number < 100) result.number = 10 * result.number + (c - '0');
    if (c == ' ' || c == '-' || c == '_' || c == '.' || std::isdigit(byte) != 0) continue;
    letters += static_cast<char>(std::toupper(byte));
  }
  const auto found = known.find(letters);
  if (found != known.end()) result.kind = found->second;
  return result;
}

std::string main_vessel_of(const std::string& vessel_name) {
  switch (parsed(vessel_name).kind) {
    case VesselKind::lm:
      return "LM";
    case VesselKind::lad:
    case VesselKind::diagonal:
    case VesselKind::septal:
      return "LAD";
    case VesselKind::lcx:
    case VesselKind::marginal:
    case VesselKind::ramus:
    case VesselKind::left_pda:
    case VesselKind::left_plb:
      return "LCX";
    case VesselKind::rca:
    case VesselKind::pda:
    case VesselKind::plb:
    case VesselKind::acute:
    case VesselKind::right:
      return "RCA";
    case VesselKind::unknown:
      break;
  }
  return "";
}

std::string usual_name(const std::string& vessel_name) {
  static const std::map<VesselKind, const char*> names{
      {VesselKind::lm, "LM"},       {VesselKind::lad, "LAD"},       {VesselKind::lcx, "LCX"},
      {VesselKind::rca, "RCA"},     {VesselKind::diagonal, "D"},    {VesselKind::septal, "S"},
      {VesselKind::marginal, "OM"}, {VesselKind::ramus, "RI"},      {VesselKind::pda, "PDA"},
      {VesselKind::plb, "PLB"},     {VesselKind::left_pda, "LPDA"}, {VesselKind::left_plb, "LPLB"},
      {VesselKind::acute, "AM"},    {VesselKind::right, "CB"},
  };
  const ParsedName name = parsed(vessel_name);
  const auto found = names.find(name.kind);
  if (found == names.end()) return "";
  const bool numbered = name.kind == VesselKind::diagonal || name.kind == VesselKind::septal ||
                        name.kind == VesselKind::marginal;
  const int number = numbered ? std::max(name.number, 1) : name.number;
  return found->second + (number > 0 ? std::to_string(number) : std::string());
}

std::vector<std::int32_t> vessels_in_reading_order(const geometry::VesselTree& tree) {
  using Place = std::array<std::size_t, 4>;  // kind, number, without a name of its own, place in the tree
  std::vector<std::pair<Place, std::int32_t>> places;
  for (std::size_t i = 0; i < tree.vessels.size(); ++i) {
    const geometry::Vessel& vessel = tree.vessels[i];
    const bool nameless = parsed(vessel.name).kind == VesselKind::unknown;
    const geometry::Vessel* parent = nameless ? parent_of(tree, vessel) : nullptr;
    const auto [kind, number] = kind_of(tree, parent ? *parent : vessel);
    places.push_back({{kind, number, nameless ? 1U : 0U, i}, vessel.id});
  }
  std::sort(places.begin(), places.end());
  std::vector<std::int32_t> ids;
  for (const auto& [place, id] : places) ids.push_back(id);
  return ids;
}

}  // namespace ostia::analysis
