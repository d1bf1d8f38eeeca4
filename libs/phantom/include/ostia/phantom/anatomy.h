#pragma once
/// \file Where the coronary arteries leave the aorta: as usual, or not.

#include <string>
#include <vector>

namespace ostia::phantom {

/// How the arteries leave the aorta (docs/methods/phantom-variants.md).
enum class Anatomy {
  usual,
  left_ostium_closed,   ///< the left tree begins 6 mm beyond the aorta's wall
  right_ostium_closed,  ///< the same on the right
  rca_from_left,        ///< from the left sinus, between the aorta and the pulmonary trunk
  lcx_from_right,       ///< from the right sinus, behind the aorta; an ostium of its own
  bypass                ///< "SVG", from the ascending aorta to the middle of the LAD
};
const char* word(Anatomy anatomy);  ///< "usual", "left-ostium-closed", ...
/// Throws InvalidInput for a word that is none.
Anatomy anatomy_of(const std::string& word);
/// Of all of them, the usual one first.
std::vector<std::string> anatomy_words();

}  // namespace ostia::phantom
