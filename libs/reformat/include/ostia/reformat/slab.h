#pragma once
/// \file Pictures of a thick layer.

namespace ostia::reformat {

/// How the image across a view becomes one value: from the view alone, or of a layer about it.
enum class Slab { none, mean, maximum, minimum };

}  // namespace ostia::reformat
