#include "shaders.h"

namespace ostia::glview {

namespace {

constexpr const char* version = "#version 330 core\n";

}  // namespace

std::string surface_vertex_shader(bool valued) {
  return std::string(version) + (valued ? "#define VALUED\n" : "") + R"(
layout(location = 0) in int corner;
layout(location = 1) in vec3 local;
layout(location = 2) in vec3 rest;
layout(location = 3) in vec3 normal;
layout(location = 4) in vec3 along;
uniform samplerBuffer control_points, control_rates, bending;
uniform int side;             // control points along each axis
uniform vec3 cell_mm, low, high;
uniform mat4 clip_of_world;
uniform int value_kind;       // SurfaceValue
uniform vec2 value_range;
uniform float interval_s;
uniform int bending_from, bending_to;
uniform float bending_share;
out vec3 place, shown_normal;
#ifdef VALUED
out float value;
#endif

vec3 blend(vec3 c[8]) {
  vec4 f = vec4((1.0 - local.y) * (1.0 - local.z), local.y * (1.0 - local.z), (1.0 - local.y) * local.z,
                local.y * local.z);
  return f.x * mix(c[0], c[1], local.x) + f.y * mix(c[2], c[3], local.x) + f.z * mix(c[4], c[5], local.x) +
         f.w * mix(c[6], c[7], local.x);
}

void main() {
  vec3 c[8];
  for (int k = 0; k < 8; ++k)
    c[k] = texelFetch(control_points, corner + (k & 1) + side * ((k >> 1 & 1) + side * (k >> 2))).xyz;
  // What is outside of the cage goes as its nearest place in the cage does.
  place = blend(c) + (rest - clamp(rest, low, high));
  vec3 u = local;
  vec3 dx = mix(mix(c[1] - c[0], c[3] - c[2], u.y), mix(c[5] - c[4], c[7] - c[6], u.y), u.z) / cell_mm.x;
  vec3 dy = mix(mix(c[2] - c[0], c[3] - c[1], u.x), mix(c[6] - c[4], c[7] - c[5], u.x), u.z) / cell_mm.y;
  vec3 dz = mix(mix(c[4] - c[0], c[5] - c[1], u.x), mix(c[6] - c[2], c[7] - c[3], u.x), u.y) / cell_mm.z;
  // Normals go with the cofactors of the gradient, whose columns are dx, dy, dz.
  shown_normal = normal.x * cross(dy, dz) + normal.y * cross(dz, dx) + normal.z * cross(dx, dy);
#ifdef VALUED
  float v = 0.0;
  if (value_kind == 1) {
    v = length(place - rest);
  } else if (value_kind == 2) {
    for (int k = 0; k < 8; ++k)
      c[k] = texelFetch(control_rates, corner + (k & 1) + side * ((k >> 1 & 1) + side * (k >> 2))).xyz;
    v = length(blend(c)) / interval_s;
  } else if (value_kind == 3) {
    v = 100.0 * (length(along.x * dx + along.y * dy + along.z * dz) - 1.0);
  } else if (value_kind == 4) {
    v = 10.0 * mix(texelFetch(bending, bending_from + gl_VertexID).x,
                   texelFetch(bending, bending_to + gl_VertexID).x, bending_share);
  }
  value = (v - value_range.x) / (value_range.y - value_range.x);
#endif
  gl_Position = clip_of_world * vec4(place, 1.0);
}
)";
}

std::string lit_fragment_shader(bool valued, bool cut_end) {
  // A headlight, a softer light from the upper left, a sky that is brighter than the ground: the lights of
  // figure::render, as directions, since the eye is far away. Colours are mixed as light, and end as sRGB. A
  // software renderer runs this for each pixel, so powers are products, and what one surface alone needs is
  // compiled for that one.
  return std::string(version) + (valued ? "#define VALUED\n" : "") + (cut_end ? "#define CUT_END\n" : "") +
         R"(
in vec3 place, shown_normal;
#ifdef VALUED
in float value;
uniform sampler1D colors;
uniform int shaded;
#endif
uniform vec3 plain, to_eye, key, half_way, up;
out vec4 pixel;

void main() {
#ifdef CUT_END
  vec3 n = normalize(cross(dFdx(place), dFdy(place)));
#else
  vec3 n = normalize(shown_normal);
#endif
  bool inner = !gl_FrontFacing;
  if (inner) n = -n;
#ifdef VALUED
  vec3 albedo = texture(colors, clamp(value, 0.0, 1.0) * (255.0 / 256.0) + 0.5 / 256.0).rgb;
  if (shaded == 0) {
    pixel = vec4(albedo, 1.0);
    return;
  }
#else
  vec3 albedo = plain;
#endif
  albedo *= albedo;
#ifdef CUT_END
  albedo *= 0.45;
#endif
  if (inner) albedo = mix(albedo, vec3(dot(albedo, vec3(0.33))), 0.6) * 0.5;
  float facing = max(dot(n, to_eye), 0.0);
  float from_key = max(dot(n, key), 0.0);
  float sky = 0.5 + 0.5 * dot(n, up);
  float bright = 0.12 + 0.16 * sky + 0.45 * facing + 0.42 * from_key;
  float shine = inner ? 0.0 : max(dot(n, half_way), 0.0);  // to the power of 48
  shine *= shine * shine;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  float off = 1.0 - facing;
  vec3 light = albedo * bright + 0.22 * shine + 0.10 * off * off * off * vec3(0.5, 0.6, 0.8);
  pixel = vec4(sqrt(clamp(light, 0.0, 1.0)), 1.0);
}
)";
}

std::string depth_fragment_shader() {
  return R"(#version 330 core
in vec3 place, shown_normal;
uniform vec3 eye;
uniform float isocentre_mm;
uniform float entering;  // the sign of faces that are seen as front faces
out float way;

void main() {
  // Less the way to the isocentre, which cancels, so that single precision is enough.
  float mm = distance(place, eye) - isocentre_mm;
  way = gl_FrontFacing ? entering * mm : -entering * mm;
}
)";
}

std::string whole_vertex_shader() {
  return R"(#version 330 core
out vec2 at;
void main() {
  at = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(2.0 * at - 1.0, 0.0, 1.0);
}
)";
}

std::string absorption_fragment_shader() {
  return R"(#version 330 core
in vec2 at;
uniform sampler2D ways;
uniform float per_mm;
out vec4 pixel;
void main() {
  float mm = max(texture(ways, at).x, 0.0);
  // Lambert and Beer behind tissue of one thickness; the field is a little darker towards its border.
  vec2 off = at - 0.5;
  float field = 0.74 - 0.22 * dot(off, off);
  float grain = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  pixel = vec4(vec3(0.05 + (field - 0.05) * exp(-per_mm * mm) + grain / 255.0), 1.0);
}
)";
}

}  // namespace ostia::glview
