#pragma once
/// \file Which way an image's axes run in the patient, and images of which a person knows it better than
/// their files.

#include "ostia/imaging/volume.h"

#include <string>

namespace ostia::imaging {

/// Three letters: what i, j and k rise towards, L or R, P or A, S or I, each pair once. "LPS": to the left,
/// to the back, to the head. Of an oblique grid the nearest ones.
std::string axes_of(const Geometry& grid);
/// Throws InvalidInput for anything else than such letters.
void validate_axes(const std::string& axes);
/// Whether one of the two shows the patient as a mirror does the other. Throws InvalidInput.
bool mirrored(const std::string& a, const std::string& b);

/// How the voxels of an image lie. A grid is right-handed: where the letters are not, its slices are in the
/// other order in memory.
struct AxesGiven {
  Geometry grid;
  bool slices_reversed = false;
};
/// Of an image that its file says to lie on `as_read`, with axes that run as the letters say; empty: as it
/// was read. Its middle stays where it is, and what was oblique stays so by as much. Throws InvalidInput.
AxesGiven given_axes(const Geometry& as_read, const std::string& axes);
/// An image that lies as `from` says, laid as `to` says; both are of one image.
template <class T>
Volume<T> laid(const Volume<T>& image, const AxesGiven& from, const AxesGiven& to);
extern template ImageVolume laid(const ImageVolume&, const AxesGiven&, const AxesGiven&);
extern template MaskVolume laid(const MaskVolume&, const AxesGiven&, const AxesGiven&);
/// An image as it was read, with axes that run as the letters say. Throws InvalidInput.
ImageVolume with_axes(const ImageVolume& image, const std::string& axes);

}  // namespace ostia::imaging
