/* The surfaces of pictures in linear light, in GLSL. Each part is written from the definition of what it computes. */
#include <stdio.h>

#include "reference/gl/look_environments.h"
#include "reference/gl/look_twin.h"
#include "scene/picture.h"

/* gl_Color is the surface's own colour, sRGB-encoded; its w tells which side is seen: 0 that which GL finds, 1 the
 * front, 2 the back; 3: it is a line, which has none. */
static const char *const vertex =
    "#version 400 compatibility\n"
    "uniform vec3 normal_rows[3];\n"
    "uniform vec4 viewer;\n"
    "in vec4 tangent, along_x, along_y, w_along;\n"
    "out vec4 place;\n"
    "out vec3 base, normal, way, lean;\n"
    "flat out float side, hand, corner;\n"
    "flat out vec4 step_x, step_y, step_w;\n"
    "void main()\n"
    "{\n"
    "    place = gl_MultiTexCoord0;\n"
    "    lean = (gl_ModelViewMatrix * vec4(tangent.xyz, 0.0)).xyz;\n"
    "    hand = tangent.w;\n"
    "    step_x = along_x;\n"
    "    step_y = along_y;\n"
    "    step_w = w_along;\n"
    "    vec3 n = gl_Normal / max(length(gl_Normal), 1e-30);\n"
    "    vec3 eye_n = vec3(dot(normal_rows[0], n), dot(normal_rows[1], n), dot(normal_rows[2], n));\n"
    "    vec4 p = gl_ModelViewMatrix * gl_Vertex;\n"
    "    normal = eye_n / max(length(eye_n), 1e-30);\n"
    "    way = p.xyz - viewer.xyz * p.w;\n"
    "    base = gl_Color.rgb;\n"
    "    side = gl_Color.w;\n"
    "    corner = float(gl_VertexID);\n"
    "    gl_Position = ftransform();\n"
    "}\n";

/* Values of samples for look_surfaces.c. */
static const char *const values = "#version 400 compatibility\n"
                                  "uniform float which;\n"
                                  "in vec3 base, normal, way;\n"
                                  "flat in float side, corner;\n"
                                  "void main()\n"
                                  "{\n"
                                  "    bool back = side == 0.0 ? !gl_FrontFacing : side == 2.0;\n"
                                  "    vec3 n = side == 3.0 ? vec3(0.0) : back ? -normal : normal;\n"
                                  "    gl_FragColor = which == 0.0   ? vec4(base, 1.0 + corner)\n"
                                  "                   : which == 1.0 ? vec4(n, side)\n"
                                  "                                  : vec4(way, gl_FragCoord.w);\n"
                                  "}\n";

/* A surface, whose values are known. Its coordinate 0 is the way from the eye. */
static const char *const surface_vertex = "#version 400 compatibility\n"
                                          "out vec4 place;\n"
                                          "out vec3 base, normal, way, lean;\n"
                                          "flat out float side, hand;\n"
                                          "flat out vec4 step_x, step_y, step_w;\n"
                                          "void main()\n"
                                          "{\n"
                                          "    place = step_x = step_y = step_w = vec4(0.0);\n"
                                          "    lean = vec3(0.0);\n"
                                          "    hand = 0.0;\n"
                                          "    base = gl_Color.rgb;\n"
                                          "    side = gl_Color.w;\n"
                                          "    normal = gl_Normal;\n"
                                          "    way = gl_MultiTexCoord0.xyz;\n"
                                          "    gl_Position = gl_Vertex;\n"
                                          "}\n";

static const char *const version = "#version 400 compatibility\n";

static const char *const declarations =
    "in vec4 place;\n"
    "in vec3 base, normal, way, lean;\n"
    "flat in float hand;\n"
    "flat in vec4 step_x, step_y, step_w;\n"
    "#ifndef FIXED\n"
    "flat in float side;\n"
    "uniform float has[14], second[14];\n" /* second: coordinates 1 instead of 0 */
    "uniform float toe;\n"                 /* less than 0: no tone mapping */
    "uniform float environment;\n"         /* the number of enum zr_environment_name */
    "uniform float lamp_count;\n"
    "uniform int shading;\n"
    "#endif\n"
    "uniform sampler2D base_map, roughness_map, normal_map, occlusion_map, emissive_map, coat_map, "
    "coat_roughness_map, coat_normal_map, sheen_map, film_map, film_thickness_map, transmission_map, thickness_map, "
    "brush_map;\n"
    "uniform sampler2D around_map;\n"
    "uniform vec3 around[9];\n"
    "uniform vec3 rows[28];\n"
    "uniform float normal_scale, coat_normal_scale, occlusion_strength, film_thinnest;\n"
    "uniform vec3 brush;\n" /* strength, cosine and sine of its angle to the tangent */
    "float rough, metal, open, bent;\n"
    "vec3 glow, of_plastic, of_metal, coat_n, grain;\n"
    "vec4 fuzz;\n"
    "vec2 layer;\n" /* film: share, nanometres */
    "uniform vec4 viewer;\n"
    "uniform vec3 ambient;\n"
    "uniform float exposure, intensity;\n"
    "uniform vec3 to_environment[3];\n" /* rows */
    "uniform vec4 middle;\n"            /* of the scene's bounds, from the eye; w: half their diagonal */
    "uniform vec2 gooch;\n"             /* least, rise */
    "uniform vec3 lamp_to[64], lamp_color[64], lamp_ground[64];\n"
    "uniform vec3 lamp_kind[64];\n"  /* a hemisphere; lights pbr; lights flat, gouraud and phong */
    "uniform vec4 lamp_place[64];\n" /* from the eye; w: 1 where the lamp has a place */
    "uniform vec4 lamp_spot[64];\n"  /* of a spot: the way of its light; w: cos of the outer angle, or -2: no spot */
    "uniform vec2 lamp_end[64];\n"   /* cos of the inner angle; range, or 0 */
    "uniform vec2 split[1024];\n"    /* rows of 32 columns: A, B */
    "uniform vec3 specular, emissive, cool;\n"
    "uniform float shininess, metallic, roughness, grazing;\n"
    "uniform vec3 reflectance;\n"
    "uniform vec2 coat;\n"         /* factor, roughness */
    "uniform vec4 sheen;\n"        /* colour, roughness */
    "uniform vec3 film;\n"         /* factor, index of refraction, nanometres */
    "uniform float fibres[256];\n" /* rows of 16 columns */
    "vec3 decode(vec3 c)\n"
    "{\n"
    "    vec3 curve = pow((c + 0.055) / 1.055, vec3(2.4)), line = c / 12.92;\n"
    "    return mix(curve, line, lessThanEqual(c, vec3(0.04045)));\n"
    "}\n"
    "vec3 lamp_way(int i)\n"
    "{\n"
    "    return lamp_place[i].w == 0.0 ? lamp_to[i] : normalize(lamp_place[i].xyz - way);\n"
    "}\n"
    /* KHR_lights_punctual. */
    "vec3 lamp_light(int i)\n"
    "{\n"
    "    if (lamp_place[i].w == 0.0) return lamp_color[i];\n"
    "    float d = length(lamp_place[i].xyz - way), share = 1.0 / (d * d), outer = lamp_spot[i].w;\n"
    "    if (lamp_end[i].y > 0.0) share *= max(min(1.0 - pow(d / lamp_end[i].y, 4.0), 1.0), 0.0);\n"
    "    float angle = dot(-lamp_way(i), lamp_spot[i].xyz);\n"
    "    float cone = clamp((angle - outer) / max(0.001, lamp_end[i].x - outer), 0.0, 1.0);\n"
    "    if (outer > -2.0) share *= cone * cone;\n"
    "    return lamp_color[i] * share;\n"
    "}\n"
    "vec3 hemisphere(int i, vec3 d)\n"
    "{\n"
    "    return mix(lamp_ground[i], lamp_color[i], 0.5 + 0.5 * dot(d, lamp_to[i]));\n"
    "}\n";

/* The level is that of the derivatives of the coordinates, which are those of coordinates over w and of 1/w. FIXED: the
 * plain call, whose level follows from differences between neighbours. */
static const char *const textures =
    "vec2 moved(int slot, vec4 p, float one)\n"
    "{\n"
    "    vec2 uv = second[slot] == 0.0 ? p.xy : p.zw;\n"
    "    vec3 a = rows[2 * slot], b = rows[2 * slot + 1];\n"
    "    return vec2((a.x * uv.x + a.y * uv.y) + a.z * one, (b.x * uv.x + b.y * uv.y) + b.z * one);\n"
    "}\n"
    "vec3 texel(sampler2D map, int slot)\n"
    "{\n"
    "    if (has[slot] == 0.0) return vec3(1.0);\n"
    "#ifdef FIXED\n"
    "    return texture2D(map, moved(slot, place, 1.0)).rgb;\n"
    "#else\n"
    "    vec4 x = (step_x - place * step_w.x) / gl_FragCoord.w, y = (step_y - place * step_w.y) / gl_FragCoord.w;\n"
    "    vec2 size = vec2(textureSize(map, 0)), u = moved(slot, x, 0.0) * size, v = moved(slot, y, 0.0) * size;\n"
    "    float lod = 0.5 * log2(clamp(max(dot(u, u), dot(v, v)), 1e-9, 1e18));\n"
    "    return textureLod(map, moved(slot, place, 1.0), lod).rgb;\n"
    "#endif\n"
    "}\n"
    "vec3 mapped_normal(vec3 n, sampler2D map, int slot, float size)\n"
    "{\n"
    "    vec3 t = lean - n * dot(n, lean);\n"
    "    if (has[slot] == 0.0 || dot(t, t) == 0.0) return n;\n"
    "    t = normalize(t);\n"
    "    vec3 b = cross(n, t) * hand, m = texel(map, slot) * 2.0 - 1.0;\n"
    "    return normalize(t * (m.x * size) + b * (m.y * size) + n * m.z);\n"
    "}\n"
    /* KHR_materials_anisotropy: sets the direction along which highlights are long, and their strength. */
    "void find_grain(vec3 n)\n"
    "{\n"
    "    vec3 t = lean - n * dot(n, lean), m = texel(brush_map, 13);\n"
    "    bent = dot(t, t) == 0.0 ? 0.0 : brush.x * m.z;\n"
    "    if (bent == 0.0) return;\n"
    "    vec2 d = has[13] == 0.0 ? vec2(1.0, 0.0) : m.xy * 2.0 - 1.0;\n"
    "    d = mat2(brush.y, brush.z, -brush.z, brush.y) * d;\n"
    "    t = normalize(t);\n"
    "    grain = normalize(t * d.x + cross(n, t) * hand * d.y);\n"
    "}\n";

/* Khronos PBR neutral; `toe` is its constant F90. */
static const char *const tone = "vec3 mapped(vec3 c)\n"
                                "{\n"
                                "    c *= exposure;\n"
                                "    if (toe < 0.0) return clamp(c, 0.0, 1.0);\n"
                                "    float x = min(c.r, min(c.g, c.b));\n"
                                "    c -= x < 2.0 * toe ? x - x * x / (4.0 * toe) : toe;\n"
                                "    float start = 0.8 - toe, peak = max(c.r, max(c.g, c.b)), d = 1.0 - start;\n"
                                "    if (peak < start) return clamp(c, 0.0, 1.0);\n"
                                "    float lower = 1.0 - d * d / (peak + d - start);\n"
                                "    float g = 1.0 - 1.0 / (0.15 * (peak - lower) + 1.0);\n"
                                "    return clamp(mix(c * (lower / peak), vec3(lower), g), 0.0, 1.0);\n"
                                "}\n";

/* KHR_materials_iridescence, with the numbers of its source. */
static const char *const films =
    "vec3 waves(float nm, vec3 turn)\n"
    "{\n"
    "    const float pi = 3.14159265358979;\n"
    "    float phase = 2.0 * pi * nm * 1e-9;\n"
    "    vec3 size = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13), at = vec3(1.6810e+06, 1.7953e+06, 2.2084e+06);\n"
    "    vec3 spread = vec3(4.3278e+09, 9.3046e+09, 6.6121e+09);\n"
    "    vec3 xyz = size * sqrt(2.0 * pi * spread) * cos(at * phase) * exp(-phase * phase * spread);\n"
    "    xyz.x += 9.7470e-14 * sqrt(2.0 * pi * 4.5282e+09) * cos(2.2399e+06 * phase) *\n"
    "             exp(-4.5282e+09 * phase * phase);\n"
    "    xyz /= 1.0685e-7;\n"
    "    return turn * vec3(dot(xyz, vec3(3.2404542, -1.5371385, -0.4985314)),\n"
    "                       dot(xyz, vec3(-0.9692660, 1.8760108, 0.0415560)),\n"
    "                       dot(xyz, vec3(0.0556434, -0.2040259, 1.0572252)));\n"
    "}\n"
    "vec3 filmed(vec3 f0, float nv)\n"
    "{\n"
    "    if (layer.x == 0.0) return f0;\n"
    "    float ior = film.y, c = sqrt(max(1.0 - (1.0 - nv * nv) / (ior * ior), 0.0)), five = pow(1.0 - nv, 5.0);\n"
    "    float up = mix(pow((ior - 1.0) / (ior + 1.0), 2.0), 1.0, five), nm = 2.0 * ior * layer.y * c;\n"
    "    vec3 s = sqrt(clamp(f0, 0.0, 0.9999)), below = (1.0 + s) / (1.0 - s);\n"
    "    vec3 low = mix(pow((below - ior) / (below + ior), vec3(2.0)), vec3(1.0), pow(1.0 - c, 5.0));\n"
    "    vec3 both = clamp(up * low, 1e-5, 0.9999), once = (1.0 - up) * (1.0 - up) * low / (1.0 - both);\n"
    "    vec3 turn = vec3(below.x < ior ? 1.0 : -1.0, below.y < ior ? 1.0 : -1.0, below.z < ior ? 1.0 : -1.0);\n"
    "    vec3 sum = up + once + 2.0 * (once - (1.0 - up)) *\n"
    "               (sqrt(both) * waves(nm, turn) + both * waves(2.0 * nm, vec3(1.0)));\n"
    "    return mix(f0, clamp((clamp(sum, 0.0, 1.0) - five) / max(1.0 - five, 1e-4), 0.0, 1.0), layer.x);\n"
    "}\n";

/* glTF 2.0, appendix B, of lamps whose irradiance is pi times their colour; and the split sum with what is reflected
 * more than once. */
static const char *const pbr =
    "vec2 split_at(float facing)\n"
    "{\n"
    "    float row = rough * 31.0, column = sqrt(facing) * 31.0;\n"
    "    int i = int(min(floor(row), 30.0)), j = int(min(floor(column), 30.0)), at = 32 * i + j;\n"
    "    float y = row - float(i), x = column - float(j);\n"
    "    return mix(mix(split[at], split[at + 1], x), mix(split[at + 32], split[at + 33], x), y);\n"
    "}\n"
    "float largest(vec3 c)\n"
    "{\n"
    "    return max(c.r, max(c.g, c.b));\n"
    "}\n"
    "vec3 several(vec3 f0, float f90, vec2 AB)\n"
    "{\n"
    "    float Ems = 1.0 - AB.x - AB.y;\n"
    "    vec3 Favg = f0 + (f90 - f0) / 21.0;\n"
    "    return (f0 * AB.x + f90 * AB.y) * Favg / (1.0 - Ems * Favg) * Ems;\n"
    "}\n"
    "vec3 lamp_at(int i, vec3 n, vec3 v, float nv, vec3 own)\n"
    "{\n"
    "    const float pi = 3.14159265358979;\n"
    "    float alpha = max(rough * rough, 0.06), a2 = alpha * alpha;\n"
    "    vec3 l = lamp_way(i), h = normalize(l + v);\n"
    "    float nl = dot(n, l);\n"
    "    if (nl <= 0.0) return vec3(0.0);\n"
    "    float nh = clamp(dot(n, h), 0.0, 1.0), vh = clamp(dot(v, h), 0.0, 1.0);\n"
    "    vec3 sine = cross(n, h);\n"
    "    float s = dot(sine, sine) + nh * nh * a2, D = nh > 0.0 ? a2 / (pi * s * s) : 0.0;\n"
    "    float V = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));\n"
    "    if (bent > 0.0) {\n"
    "        vec3 b = normalize(cross(n, grain));\n"
    "        float x = max(mix(rough * rough, 1.0, bent * bent), 0.06), y = alpha;\n"
    "        D = dot(vec3(dot(grain, h) / x, dot(b, h) / y, nh), vec3(dot(grain, h) / x, dot(b, h) / y, nh));\n"
    "        D = nh > 0.0 ? 1.0 / (pi * x * y * D * D) : 0.0;\n"
    "        V = 0.5 / (nl * length(vec3(x * dot(grain, v), y * dot(b, v), nv)) +\n"
    "                   nv * length(vec3(x * dot(grain, l), y * dot(b, l), nl)));\n"
    "    }\n"
    "    float once = pow(1.0 - vh, 5.0);\n"
    "    vec3 F_plastic = mix(of_plastic, vec3(grazing), once), F_metal = mix(of_metal, vec3(1.0), once);\n"
    "    vec3 plastic = (1.0 - mix(largest(of_plastic), grazing, once)) * own / pi + F_plastic * D * V;\n"
    "    return pi * lamp_light(i) * mix(plastic, F_metal * D * V, metal) * nl;\n"
    "}\n"
    "vec3 pbr_of(vec3 n, vec3 v, vec3 own)\n"
    "{\n"
    "    float nv = clamp(dot(n, v), 1e-4, 1.0);\n"
    "    of_plastic = filmed(reflectance, nv);\n"
    "    of_metal = filmed(own, nv);\n"
    "    vec3 turned_n = n;\n"
    "    if (bent > 0.0) {\n"
    "        vec3 b = normalize(cross(n, grain));\n"
    "        turned_n = normalize(mix(normalize(v - b * dot(b, v)), n, pow(1.0 - bent * (1.0 - rough), 4.0)));\n"
    "    }\n"
    "    vec3 r = reflect(-v, turned_n), E = ambient, L = ambient, lamps = emissive * glow;\n"
    "    if (environment > 0.0) {\n"
    "        float k = environment == 1.0 ? 0.4 : environment == 2.0 ? 0.5 : 0.0;\n"
    "        vec3 q = (way - middle.xyz) / middle.w;\n"
    "        E += intensity * diffuse_light(turned(normalize(n + 0.5 * k * q)));\n"
    "        L += intensity * mirrored_light(turned(normalize(r + k * q)), rough * rough);\n"
    "    }\n"
    "    for (int i = 0; i < int(lamp_count); i++) {\n"
    "        if (lamp_kind[i].y == 0.0) continue;\n"
    "        if (lamp_kind[i].x != 0.0) {\n"
    "            E += hemisphere(i, n);\n"
    "            L += hemisphere(i, r);\n"
    "        } else {\n"
    "            lamps += lamp_at(i, n, v, nv, own);\n"
    "        }\n"
    "    }\n"
    "    E *= open;\n"
    "    L *= open;\n"
    "    vec2 AB = split_at(nv);\n"
    "    vec3 metallic_color = (of_metal * AB.x + AB.y) * L + several(of_metal, 1.0, AB) * E;\n"
    "    float p = largest(of_plastic), more = several(vec3(p), grazing, AB).r;\n"
    "    vec3 plastic = (of_plastic * AB.x + grazing * AB.y) * L +\n"
    "                   (more + own * (1.0 - (p * AB.x + grazing * AB.y) - more)) * E;\n"
    "    return mix(plastic, metallic_color, metal) + lamps;\n"
    "}\n";

static const char *const finishes =
    /* Without its Fresnel term. */
    "vec3 lobe_at(int i, vec3 n, vec3 v, float nv, float r)\n"
    "{\n"
    "    float alpha = max(r * r, 0.06), a2 = alpha * alpha;\n"
    "    vec3 l = lamp_way(i), h = normalize(l + v), sine = cross(n, h);\n"
    "    float nl = dot(n, l), nh = clamp(dot(n, h), 0.0, 1.0), s = dot(sine, sine) + nh * nh * a2;\n"
    "    if (nl <= 0.0 || nh <= 0.0) return vec3(0.0);\n"
    "    float V = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));\n"
    "    return lamp_light(i) * (a2 / (s * s) * V * nl);\n"
    "}\n"
    /* KHR_materials_sheen. */
    "vec3 fibrous(vec3 n, vec3 v, vec3 below)\n"
    "{\n"
    "    const float pi = 3.14159265358979;\n"
    "    float nv = clamp(dot(n, v), 1e-4, 1.0), row = sheen.w * 15.0, column = sqrt(nv) * 15.0;\n"
    "    int i = int(min(floor(row), 14.0)), j = int(min(floor(column), 14.0)), at = 16 * i + j;\n"
    "    float y = row - float(i), x = column - float(j), alpha = pow(max(sheen.w, 0.07), 2.0);\n"
    "    float T = mix(mix(fibres[at], fibres[at + 1], x), mix(fibres[at + 16], fibres[at + 17], x), y);\n"
    "    float k = environment == 1.0 ? 0.4 : environment == 2.0 ? 0.5 : 0.0;\n"
    "    vec3 E = ambient, lamps = vec3(0.0), q = (way - middle.xyz) / middle.w;\n"
    "    if (environment > 0.0) E += intensity * diffuse_light(turned(normalize(n + 0.5 * k * q)));\n"
    "    for (int i = 0; i < int(lamp_count); i++) {\n"
    "        if (lamp_kind[i].y == 0.0) continue;\n"
    "        if (lamp_kind[i].x != 0.0) {\n"
    "            E += hemisphere(i, n);\n"
    "            continue;\n"
    "        }\n"
    "        vec3 l = lamp_way(i), sine = cross(n, normalize(l + v));\n"
    "        float nl = clamp(dot(n, l), 0.0, 1.0), s = min(length(sine), 1.0);\n"
    "        float D = s > 0.0 ? (2.0 + 1.0 / alpha) * pow(s, 1.0 / alpha) / (2.0 * pi) : 0.0;\n"
    "        lamps += pi * lamp_light(i) * D * nl / (4.0 * (nl + nv - nl * nv));\n"
    "    }\n"
    "    return fuzz.rgb * (T * open * E + lamps) + (1.0 - largest(fuzz.rgb) * T) * below;\n"
    "}\n"
    /* KHR_materials_clearcoat; n: without the normal map. */
    "vec3 coated(vec3 n, vec3 v, vec3 below)\n"
    "{\n"
    "    float nv = clamp(dot(n, v), 1e-4, 1.0), r = coat.y * texel(coat_roughness_map, 6).g;\n"
    "    vec3 d = reflect(-v, n), around = ambient, lamps = vec3(0.0);\n"
    "    float k = environment == 1.0 ? 0.4 : environment == 2.0 ? 0.5 : 0.0;\n"
    "    vec3 q = (way - middle.xyz) / middle.w;\n"
    "    if (environment > 0.0) around += intensity * mirrored_light(turned(normalize(d + k * q)), r * r);\n"
    "    for (int i = 0; i < int(lamp_count); i++) {\n"
    "        if (lamp_kind[i].y == 0.0) continue;\n"
    "        if (lamp_kind[i].x != 0.0)\n"
    "            around += hemisphere(i, d);\n"
    "        else\n"
    "            lamps += lobe_at(i, n, v, nv, r);\n"
    "    }\n"
    "    float share = coat.x * texel(coat_map, 5).r * mix(0.04, 1.0, pow(1.0 - nv, 5.0));\n"
    "    return mix(below, around * open + lamps, share);\n"
    "}\n";

/* Numbers of shadings are those of enum zr_shading. */
static const char *const surfaces =
    "vec3 classic_of(vec3 n, vec3 v, vec3 own)\n"
    "{\n"
    "    vec3 around = ambient, E = vec3(0.0), shine = vec3(0.0);\n"
    "    for (int i = 0; i < int(lamp_count); i++) {\n"
    "        if (lamp_kind[i].z == 0.0) continue;\n"
    "        if (lamp_kind[i].x != 0.0) {\n"
    "            around += hemisphere(i, n);\n"
    "            continue;\n"
    "        }\n"
    "        vec3 l = lamp_way(i), light = lamp_light(i);\n"
    "        float facing = dot(n, l);\n"
    "        if (facing <= 0.0) continue;\n"
    "        E += facing * light;\n"
    "        float cosine = clamp(dot(n, normalize(l + v)), 0.0, 1.0);\n"
    "        if (shading == 3 && cosine > 0.0) shine += light * specular * pow(cosine, shininess);\n"
    "    }\n"
    "    return own * (around * open + E) + shine;\n"
    "}\n"
    "vec3 gooch_of(vec3 n, vec3 own)\n"
    "{\n"
    "    float facing = 0.5 + 0.5 * dot(n, normalize(vec3(-0.45, 0.65, 0.61)));\n"
    "    return mix(decode(cool) * own, own, pow(clamp(facing, 0.0, 1.0), 1.5)) * (gooch.x + gooch.y * open);\n"
    "}\n"
    "vec3 color_of(vec3 n, vec3 v, vec3 own)\n"
    "{\n"
    "    if (side == 3.0 || shading == 0 || shading == 7) return own;\n"
    "    if (shading == 4) return decode(n * 0.5 + 0.5);\n"
    "    if (shading == 5) return mapped(coated(coat_n, v, fibrous(n, v, pbr_of(n, v, own))));\n"
    "    if (shading == 6) return gooch_of(n, own);\n"
    "    return mapped(classic_of(n, v, own));\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    bool back = side == 0.0 ? !gl_FrontFacing : side == 2.0;\n"
    "    vec3 n = normal / max(length(normal), 1e-30), v = viewer.w == 0.0 ? viewer.xyz : "
    "-normalize(way);\n"
    "    vec3 own = decode(clamp(base, 0.0, 1.0)), gloss = texel(roughness_map, 1);\n"
    "    rough = roughness * gloss.g;\n"
    "    metal = metallic * gloss.b;\n"
    "    glow = texel(emissive_map, 4);\n"
    "    open = 1.0 + occlusion_strength * has[3] * (texel(occlusion_map, 3).r - 1.0);\n"
    "    if (side != 3.0) {\n"
    "        own *= texel(base_map, 0);\n"
    "        find_grain(n);\n"
    "        coat_n = mapped_normal(n, coat_normal_map, 7, coat_normal_scale);\n"
    "        n = mapped_normal(n, normal_map, 2, normal_scale);\n"
    "        if (back) coat_n = -coat_n;\n"
    "    }\n"
    "    fuzz = vec4(sheen.rgb * texel(sheen_map, 8), sheen.w);\n"
    "    layer = vec2(film.x * texel(film_map, 9).r, mix(film_thinnest, film.z, texel(film_thickness_map, 10).g));\n"
    "    float cover = 1.0;\n"
    "    if (shading == 7 && side != 3.0) {\n"
    "        cover = 0.15 + 0.76 * pow(1.0 - min(abs(dot(normal, v)) / length(normal), 1.0), 2.0);\n"
    "        cover = clamp(cover * (1.0 - 0.4 * (dot(n, v) < 0.0 ? -n.x : n.x)), 0.0, 1.0);\n"
    "    }\n"
    "    gl_FragColor = vec4(color_of(back ? -n : n, v, own), cover);\n"
    "}\n";

static unsigned make(const char *of_vertices, const char *fixed, struct reference_error *error)
{
    static char fragment[1 << 16];
    snprintf(fragment, sizeof fragment, "%s%s%s%s%s%s%s%s%s%s%s", version, fixed, declarations, textures, tone,
             look_environments, look_radiances, films, pbr, finishes, surfaces);
    return reference_program(of_vertices, fragment, error);
}

_Static_assert(ZR_SHADING_UNLIT == 0 && ZR_SHADING_PHONG == 3 && ZR_SHADING_NORMALS == 4 && ZR_SHADING_PBR == 5 &&
                   ZR_SHADING_GOOCH == 6 && ZR_SHADING_XRAY == 7 && LOOK_LAMPS_MAX == 64 &&
                   ZR_ENVIRONMENT_STUDIO == 1 && ZR_ENVIRONMENT_METAL == 2 && ZR_ENVIRONMENT_OUTDOOR == 3 &&
                   ZR_ENVIRONMENT_IMAGE == 4,
               "the program has these numbers");

unsigned look_program_fixed(const char *fixed, struct reference_error *error)
{
    return make(vertex, fixed, error);
}

unsigned look_program(struct look_programs *programs, enum look_program which, struct reference_error *error)
{
    unsigned *own = &programs->of[which];
    if (*own) return *own;
    if (which == LOOK_PROGRAM_VALUES) return *own = reference_program(vertex, values, error);
    return *own = make(which == LOOK_PROGRAM_SURFACES ? surface_vertex : vertex, "", error);
}
