#pragma once
/// \file How WFDB packs samples into bytes.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace ostia::io {

/// The least value of a format stands for a missing sample.
inline constexpr std::int32_t missing_sample = INT32_MIN;

/// All samples that the bytes hold, missing ones as `missing_sample`; nothing for a format that is not known.
/// A last group of bytes that is not whole is left out.
std::optional<std::vector<std::int32_t>> unpacked_samples(int format, std::string_view bytes);

}  // namespace ostia::io
