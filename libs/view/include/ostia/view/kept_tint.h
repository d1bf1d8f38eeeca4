#pragma once
/// \file Colours over a picture that are made when they are asked for, and kept.

#include "ostia/view/overlay.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace ostia::view {

class KeptTint {
 public:
  /// Numbers that are others whenever it has to be made anew.
  using MadeFrom = std::array<std::uint64_t, 3>;
  /// As `make()` made it last from these; null where that was null.
  template <class Make>
  const std::shared_ptr<const OverlayTint>& of(const MadeFrom& now, const Make& make) {
    if (from_ != now) {
      tint_ = make();
      from_ = now;
    }
    return tint_;
  }

 private:
  std::shared_ptr<const OverlayTint> tint_;
  std::optional<MadeFrom> from_;
};

}  // namespace ostia::view
