#pragma once
/// \file The programs that draw the lit wall, and how it is coloured.

#include "gl_objects.h"

#include "ostia/glview/beating_scene.h"

#include <array>

namespace ostia::glview {

/// Each is compiled when a picture first needs it: that takes longer than a picture.
class LitPrograms {
 public:
  LitPrograms();
  /// Coloured by values or in one colour; of cut ends or of the wall.
  const GlObject& of(bool valued, bool cut_end);
  /// Lights and colours of one of them, which is in use.
  void set_look(const GlObject& program, bool valued, const Camera& camera, const SceneLook& look) const;

 private:
  std::array<GlObject, 4> programs_;  // valued, of a cut end: the two bits of their number
  GlObject sequential_, diverging_;
};

}  // namespace ostia::glview
