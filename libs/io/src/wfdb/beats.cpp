// MIT's format of annotations, as annot(5) of the WFDB Applications Guide has it.

#include "wfdb/beats.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/wfdb_file.h"

#include <cstdint>
#include <string_view>

namespace ostia::io {
namespace {

constexpr std::string_view codes = " NLRaVFJASEj/Q";  // PhysioNet's codes 1 to 13

/// Codes of beats above 13.
char late_beat(int code) {
  switch (code) {
    case 25:
      return 'B';
    case 30:
      return '?';
    case 34:
      return 'e';
    case 35:
      return 'n';
    case 38:
      return 'f';
    case 41:
      return 'r';
    default:
      return 0;
  }
}
char beat_of(int code) {
  return code >= 1 && code <= 13 ? codes[static_cast<std::size_t>(code)] : late_beat(code);
}

int code_of(char kind) {
  for (int code = 1; code < 50; ++code)
    if (beat_of(code) == kind) return code;
  throw InvalidInput(std::string("cannot write a beat of the kind ") + kind + ": WFDB does not know it");
}

/// Words of 16 bits, the upper six of which are a code.
enum Code { skip = 59, number = 60, subtype = 61, channel = 62, text = 63 };

void put(std::string& bytes, int code, std::uint32_t value) {
  const std::uint32_t word = static_cast<std::uint32_t>(code) << 10 | value;
  bytes += static_cast<char>(word & 0xFF);
  bytes += static_cast<char>(word >> 8);
}

}  // namespace

std::string annotation_bytes(const std::vector<geometry::EcgBeat>& beats) {
  std::string bytes;
  std::size_t last = 0;
  for (const geometry::EcgBeat& beat : beats) {
    if (beat.sample < last) throw InvalidInput("cannot write beats that are not in the order of time");
    std::size_t step = beat.sample - last;
    if (step > 1023) {
      put(bytes, skip, 0);
      for (const int shift : {16, 24, 0, 8}) bytes += static_cast<char>(step >> shift & 0xFF);
      step = 0;
    }
    put(bytes, code_of(beat.kind), static_cast<std::uint32_t>(step));
    last = beat.sample;
  }
  put(bytes, 0, 0);
  return bytes;
}

std::vector<geometry::EcgBeat> read_wfdb_beats(const std::filesystem::path& path) {
  const std::string bytes = core::read_file(path);
  const auto word = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i]) |
                                      static_cast<unsigned char>(bytes[i + 1]) << 8);
  };
  const auto refuse = [&](const std::string& why) {
    throw InvalidInput(path.string() + ": " + why + "; it should be an annotation file of WFDB (.atr)");
  };
  std::vector<geometry::EcgBeat> beats;
  std::int64_t time = 0;
  bool ended = false;
  for (std::size_t i = 0; i + 2 <= bytes.size();) {
    const int code = static_cast<int>(word(i) >> 10);
    const std::uint32_t value = word(i) & 1023;
    i += 2;
    if (code == 0 && value == 0) {
      ended = true;
      break;
    }
    if (code == skip) {
      if (i + 4 > bytes.size()) break;
      time += static_cast<std::int32_t>(word(i) << 16 | word(i + 2));
      i += 4;
    } else if (code == text) {
      i += value + value % 2;
    } else if (code < skip) {
      time += value;
      if (time < 0) refuse("has marks before its start");
      const char kind = beat_of(code);
      if (kind == 0) continue;
      if (!beats.empty() && static_cast<std::size_t>(time) < beats.back().sample)
        refuse("has beats that go backwards");
      beats.push_back({static_cast<std::size_t>(time), kind});
    }
  }
  if (!ended) refuse("ends early, after " + std::to_string(beats.size()) + " beats");
  return beats;
}

}  // namespace ostia::io
