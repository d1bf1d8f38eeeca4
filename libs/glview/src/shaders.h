#pragma once
/// \file What runs on the graphics card.

#include <string>

namespace ostia::glview {

/// Carries a vertex with its cell of the cage, turns its normal, and, where it is `valued`, computes its
/// value.
std::string surface_vertex_shader(bool valued);
/// Coloured by values or in one colour; of a cut end, which is flat, or of the wall.
std::string lit_fragment_shader(bool valued, bool cut_end);
/// The way of the ray to the surface, negative where it enters: their sum is the way inside.
std::string depth_fragment_shader();
/// A triangle over all of the picture, and what fills it.
std::string whole_vertex_shader();
std::string absorption_fragment_shader();

}  // namespace ostia::glview
