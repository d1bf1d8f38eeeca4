#pragma once
/// \file What runs on the graphics card.

#include <string>

namespace ostia::glview {

/// Carries a vertex with its cell of the cage, turns its normal, computes its value.
std::string surface_vertex_shader();
std::string lit_fragment_shader();
/// The way of the ray to the surface, negative where it enters: their sum is the way inside.
std::string depth_fragment_shader();
/// A triangle over all of the picture, and what fills it.
std::string whole_vertex_shader();
std::string backdrop_fragment_shader();
std::string absorption_fragment_shader();

}  // namespace ostia::glview
