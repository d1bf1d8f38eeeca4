#include "ostia/lumen/surface_sample.h"

namespace ostia::lumen {

bool canonical_order(const SurfaceSample& a, const SurfaceSample& b) {
  return a.s_mm != b.s_mm ? a.s_mm < b.s_mm : a.id < b.id;
}

}  // namespace ostia::lumen
