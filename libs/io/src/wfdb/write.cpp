#include "wfdb/beats.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/io/wfdb_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ostia::io {
namespace {

constexpr int sample_step = 1000;  // steps a unit

std::filesystem::path with_extension(std::filesystem::path path, const char* extension) {
  return path.replace_extension(extension);
}

/// Samples of 16 bits of a lead among others, and what the header says of it.
std::string packed(const geometry::EcgLead& lead, std::size_t lead_index, std::size_t leads,
                   const std::string& name, std::string& bytes) {
  std::uint32_t sum = 0, first = 0;
  for (std::size_t i = 0; i < lead.values.size(); ++i) {
    const double v = lead.values[i];
    const long step = std::isnan(v) ? -32768 : std::lround(std::clamp(v, -32.0, 32.0) * sample_step);
    const auto sample = static_cast<std::uint32_t>(step);
    if (i == 0) first = sample;
    sum += sample;
    const std::size_t at = 2 * (i * leads + lead_index);
    bytes[at] = static_cast<char>(sample & 0xFF);
    bytes[at + 1] = static_cast<char>(sample >> 8 & 0xFF);
  }
  return name + ".dat 16 " + std::to_string(sample_step) + "/" + lead.unit + " 16 0 " +
         std::to_string(static_cast<int>(first)) + " " +
         std::to_string(static_cast<std::int16_t>(sum & 0xFFFF)) + " 0 " + lead.name + "\n";
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < ' ' || c == 127;
}

/// The header is lines of words: what would end one of them early.
void validate_texts(const std::filesystem::path& header, const geometry::EcgLead& lead) {
  if (std::ranges::any_of(lead.name, is_control))
    throw InvalidInput(header.string() + ": a lead's name has a control character, such as a line's end");
  if (std::ranges::any_of(lead.unit, [](char c) { return c == ' ' || is_control(c); }))
    throw InvalidInput(header.string() + ": the unit \"" + lead.unit + "\" of lead " + lead.name +
                       " is no word; write it without blanks");
}

void validate(const std::filesystem::path& header, const geometry::EcgRecord& record) {
  const std::string name = header.stem().string();
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  constexpr std::size_t longest_name = 100;
  if (name.empty() || name.size() > longest_name || !std::all_of(name.begin(), name.end(), allowed))
    throw InvalidInput(header.string() +
                       ": a WFDB record is named by at most 100 letters, digits, - and _ alone");
  if (record.samples() == 0 || !(record.samples_per_second > 0.0))
    throw InvalidInput(header.string() + ": an electrocardiogram without samples or rate cannot be written");
  for (const geometry::EcgLead& lead : record.leads) {
    validate_texts(header, lead);
    if (lead.values.size() != record.samples())
      throw InvalidInput(header.string() + ": lead " + lead.name + " has another number of samples");
  }
}

/// An earlier record's, which would be taken for this one's.
void remove_beats(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error) throw IoError("cannot remove the beats of an earlier record, " + file.string());
}

}  // namespace

void write_wfdb(const std::filesystem::path& header, const geometry::EcgRecord& record,
                const std::vector<geometry::EcgBeat>& beats) {
  validate(header, record);
  const std::string name = header.stem().string();
  const std::size_t leads = record.leads.size();
  std::string text = name + " " + std::to_string(leads) + " " +
                     core::significant_text(record.samples_per_second, 9) + " " +
                     std::to_string(record.samples()) + "\n",
              bytes(2 * leads * record.samples(), '\0');
  for (std::size_t s = 0; s < leads; ++s) text += packed(record.leads[s], s, leads, name, bytes);
  const std::string marks = beats.empty() ? std::string() : annotation_bytes(beats);
  core::write_file(with_extension(header, ".dat"), bytes);
  if (beats.empty())
    remove_beats(with_extension(header, ".atr"));
  else
    core::write_file(with_extension(header, ".atr"), marks);
  core::write_file(header, text);
}

}  // namespace ostia::io
