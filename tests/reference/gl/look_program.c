/* The surfaces of pictures in linear light, in GLSL. Each part is written from the definition of what it computes. */
#include <stdio.h>

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

/* What look_surfaces.c reads of samples. */
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
    "uniform float has[5], second[5];\n" /* second: coordinates 1 instead of 0 */
    "uniform float toe;\n"               /* less than 0: no tone mapping */
    "uniform float environment;\n"       /* the number of enum zr_environment_name */
    "uniform float lamp_count;\n"
    "uniform int shading;\n"
    "#endif\n"
    "uniform sampler2D base_map, roughness_map, normal_map, occlusion_map, emissive_map;\n"
    "uniform vec3 rows[10];\n"
    "uniform float normal_scale, occlusion_strength;\n"
    "float rough, metal, open;\n"
    "vec3 glow;\n"
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
    "vec3 mapped_normal(vec3 n)\n"
    "{\n"
    "    vec3 t = lean - n * dot(n, lean);\n"
    "    if (has[2] == 0.0 || dot(t, t) == 0.0) return n;\n"
    "    t = normalize(t);\n"
    "    vec3 b = cross(n, t) * hand, m = texel(normal_map, 2) * 2.0 - 1.0;\n"
    "    return normalize(t * (m.x * normal_scale) + b * (m.y * normal_scale) + n * m.z);\n"
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

static const char *const environments =
    "float step_of(float x, float w2)\n"
    "{\n"
    "    return 0.5 + 0.5 * x / sqrt(x * x + w2);\n"
    "}\n"
    "vec3 box(vec3 d, float b2, vec3 middle, float a, float h, float w0, vec3 c)\n"
    "{\n"
    "    vec3 m = normalize(middle), t = normalize(cross(vec3(0.0, 1.0, 0.0), m));\n"
    "    float u = dot(d, t), v = dot(d, cross(m, t)), w2 = w0 * w0 + b2;\n"
    "    return c * (step_of(u + a, w2) - step_of(u - a, w2)) * (step_of(v + h, w2) - step_of(v - h, w2)) *\n"
    "           step_of(dot(d, m), w2);\n"
    "}\n"
    "vec3 lobe(vec3 d, float b2, vec3 middle, float w0, vec3 c)\n"
    "{\n"
    "    float w2 = w0 * w0 + b2, s = 1.0 + 2.0 * (1.0 - dot(d, normalize(middle))) / w2;\n"
    "    return c * (w0 * w0 / w2) / (s * s);\n"
    "}\n"
    "vec3 sum_of(vec3 n, vec3 c0, vec3 x, vec3 y, vec3 z, vec3 xy, vec3 yz, vec3 zx, vec3 zz, vec3 xxyy)\n"
    "{\n"
    "    return max(c0 + x * n.x + y * n.y + z * n.z + xy * (n.x * n.y) + yz * (n.y * n.z) + zx * (n.z * n.x) +\n"
    "               zz * (3.0 * n.z * n.z - 1.0) + xxyy * (n.x * n.x - n.y * n.y), 0.0);\n"
    "}\n"
    "vec3 diffuse_light(vec3 n)\n"
    "{\n"
    "    if (environment == 1.0)\n"
    "        return sum_of(n, vec3(0.6508, 0.6444, 0.6363), vec3(-0.3456, -0.3359, -0.3224),\n"
    "                      vec3(0.4674, 0.4663, 0.4627), vec3(0.2497, 0.2438, 0.2353),\n"
    "                      vec3(-0.3651, -0.3581, -0.3471), vec3(0.2404, 0.2349, 0.2264),\n"
    "                      vec3(-0.2916, -0.2854, -0.2765), vec3(-0.0271, -0.0264, -0.0254),\n"
    "                      vec3(-0.0070, -0.0063, -0.0054));\n"
    "    if (environment == 2.0)\n"
    "        return sum_of(n, vec3(0.5474, 0.5441, 0.5408), vec3(-0.2297, -0.2217, -0.2114),\n"
    "                      vec3(0.3870, 0.3889, 0.3902), vec3(0.0977, 0.0938, 0.0886),\n"
    "                      vec3(-0.1540, -0.1522, -0.1482), vec3(0.0779, 0.0752, 0.0708),\n"
    "                      vec3(-0.1754, -0.1712, -0.1657), vec3(-0.0212, -0.0207, -0.0201),\n"
    "                      vec3(0.0010, 0.0008, 0.0011));\n"
    "    return sum_of(n, vec3(0.4636, 0.5276, 0.6439), vec3(-0.0262, -0.0249, -0.0223),\n"
    "                  vec3(0.0902, 0.1903, 0.3663), vec3(0.0268, 0.0255, 0.0228),\n"
    "                  vec3(-0.0232, -0.0220, -0.0197), vec3(0.0237, 0.0225, 0.0201),\n"
    "                  vec3(-0.0124, -0.0118, -0.0106), vec3(0.0097, 0.0087, 0.0072),\n"
    "                  vec3(0.0280, 0.0251, 0.0207));\n"
    "}\n";

/* L of each environment. */
static const char *const radiances =
    "vec3 studio_light(vec3 d, float b2)\n"
    "{\n"
    "    vec3 sky = 0.30 * vec3(0.98, 1.0, 1.03), ground = 0.115 * vec3(1.03, 1.0, 0.97);\n"
    "    return mix(ground, sky, step_of(d.y, 0.012 * 0.012 + b2)) +\n"
    "           box(d, b2, vec3(-0.60, 0.66, 0.46), 0.48, 0.36, 0.010, 5.5 * vec3(1.02, 1.0, 0.97)) +\n"
    "           box(d, b2, vec3(0.95, 0.10, 0.25), 0.07, 0.62, 0.008, 0.55 * vec3(0.95, 0.99, 1.05)) +\n"
    "           box(d, b2, vec3(0.35, 0.45, -0.85), 0.55, 0.13, 0.010, vec3(1.7)) +\n"
    "           box(d, b2, vec3(-0.85, -0.42, 0.25), 0.50, 0.30, 0.05, 0.42 * vec3(1.04, 1.0, 0.96)) +\n"
    "           lobe(d, b2, vec3(0.85, -0.25, 0.45), 0.52, 0.194 * vec3(0.96, 1.0, 1.04)) +\n"
    "           lobe(d, b2, vec3(0.10, -0.97, 0.22), 0.66, 0.305 * vec3(1.04, 1.0, 0.96));\n"
    "}\n"
    "vec3 metal_light(vec3 d, float b2)\n"
    "{\n"
    "    vec3 sky = 0.34 * vec3(0.98, 1.0, 1.03), ground = 0.10 * vec3(1.03, 1.0, 0.97);\n"
    "    return mix(ground, sky, step_of(d.y, 0.012 * 0.012 + b2)) +\n"
    "           box(d, b2, vec3(-0.55, 0.70, 0.46), 0.55, 0.42, 0.010, 2.3 * vec3(1.02, 1.0, 0.97)) +\n"
    "           box(d, b2, vec3(0.95, 0.10, 0.25), 0.07, 0.62, 0.008, 0.9 * vec3(0.95, 0.99, 1.05)) +\n"
    "           box(d, b2, vec3(-0.15, 0.80, -0.58), 0.55, 0.22, 0.010, vec3(0.95)) +\n"
    "           box(d, b2, vec3(0.35, 0.35, -0.87), 0.50, 0.10, 0.010, vec3(1.4)) +\n"
    "           box(d, b2, vec3(0.85, -0.15, -0.50), 0.30, 0.40, 0.03, vec3(0.28)) +\n"
    "           box(d, b2, vec3(-0.85, -0.42, 0.25), 0.50, 0.30, 0.03, 1.0 * vec3(1.04, 1.0, 0.96));\n"
    "}\n"
    "vec3 outdoor_light(vec3 d, float b2)\n"
    "{\n"
    "    vec3 sky = vec3(0.34, 0.52, 0.84), ground = vec3(0.30, 0.27, 0.22), haze = vec3(0.55, 0.50, 0.42);\n"
    "    return mix(ground, sky, step_of(d.y, 0.04 * 0.04 + b2)) +\n"
    "           box(d, b2, vec3(0.0, 0.18, -1.0), 1.2, 0.18, 0.15, haze) +\n"
    "           box(d, b2, vec3(0.0, 0.18, 1.0), 1.2, 0.18, 0.15, haze) +\n"
    "           lobe(d, b2, vec3(-0.42, 0.80, 0.43), 0.7, 0.45 * vec3(1.0, 0.95, 0.85));\n"
    "}\n"
    "vec3 mirrored_light(vec3 d, float alpha)\n"
    "{\n"
    "    float b = 2.0 * alpha / (1.0 + 2.2 * alpha);\n"
    "    vec3 sharp = environment == 1.0   ? studio_light(d, b * b)\n"
    "                 : environment == 2.0 ? metal_light(d, b * b)\n"
    "                                      : outdoor_light(d, b * b);\n"
    "    return mix(sharp, diffuse_light(d), clamp((alpha - 0.2) / 0.6, 0.0, 1.0));\n"
    "}\n"
    "vec3 turned(vec3 v)\n"
    "{\n"
    "    return vec3(dot(to_environment[0], v), dot(to_environment[1], v), dot(to_environment[2], v));\n"
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
    "    float once = pow(1.0 - vh, 5.0);\n"
    "    vec3 of_plastic = mix(reflectance, vec3(grazing), once), of_metal = mix(own, vec3(1.0), once);\n"
    "    vec3 plastic = (1.0 - mix(largest(reflectance), grazing, once)) * own / pi + of_plastic * D * V;\n"
    "    return pi * lamp_light(i) * mix(plastic, of_metal * D * V, metal) * nl;\n"
    "}\n"
    "vec3 pbr_of(vec3 n, vec3 v, vec3 own)\n"
    "{\n"
    "    float nv = clamp(dot(n, v), 1e-4, 1.0);\n"
    "    vec3 r = reflect(-v, n), E = ambient, L = ambient, lamps = emissive * glow;\n"
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
    "    vec3 metallic_color = (own * AB.x + AB.y) * L + several(own, 1.0, AB) * E;\n"
    "    float p = largest(reflectance), more = several(vec3(p), grazing, AB).r;\n"
    "    vec3 plastic = (reflectance * AB.x + grazing * AB.y) * L +\n"
    "                   (more + own * (1.0 - (p * AB.x + grazing * AB.y) - more)) * E;\n"
    "    return mix(plastic, metallic_color, metal) + lamps;\n"
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
    "    if (shading == 5) return mapped(pbr_of(n, v, own));\n"
    "    if (shading == 6) return gooch_of(n, own);\n"
    "    return mapped(classic_of(n, v, own));\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    bool back = side == 0.0 ? !gl_FrontFacing : side == 2.0;\n"
    "    vec3 n = normal / max(length(normal), 1e-30), v = viewer.w == 0.0 ? viewer.xyz : -normalize(way);\n"
    "    vec3 own = decode(clamp(base, 0.0, 1.0)), gloss = texel(roughness_map, 1);\n"
    "    rough = roughness * gloss.g;\n"
    "    metal = metallic * gloss.b;\n"
    "    glow = texel(emissive_map, 4);\n"
    "    open = 1.0 + occlusion_strength * has[3] * (texel(occlusion_map, 3).r - 1.0);\n"
    "    if (side != 3.0) {\n"
    "        own *= texel(base_map, 0);\n"
    "        n = mapped_normal(n);\n"
    "    }\n"
    "    float film = 1.0;\n"
    "    if (shading == 7 && side != 3.0) {\n"
    "        film = 0.11 + 0.56 * pow(1.0 - min(abs(dot(normal, v)) / length(normal), 1.0), 2.0);\n"
    "        film *= 1.0 - 0.5 * (dot(n, v) < 0.0 ? -n.x : n.x);\n"
    "    }\n"
    "    gl_FragColor = vec4(color_of(back ? -n : n, v, own), film);\n"
    "}\n";

static unsigned make(const char *of_vertices, const char *fixed, struct reference_error *error)
{
    static char fragment[1 << 15];
    snprintf(fragment, sizeof fragment, "%s%s%s%s%s%s%s%s%s", version, fixed, declarations, textures, tone,
             environments, radiances, pbr, surfaces);
    return reference_program(of_vertices, fragment, error);
}

_Static_assert(ZR_SHADING_UNLIT == 0 && ZR_SHADING_PHONG == 3 && ZR_SHADING_NORMALS == 4 && ZR_SHADING_PBR == 5 &&
                   ZR_SHADING_GOOCH == 6 && ZR_SHADING_XRAY == 7 && LOOK_LAMPS_MAX == 64 &&
                   ZR_ENVIRONMENT_STUDIO == 1 && ZR_ENVIRONMENT_METAL == 2 && ZR_ENVIRONMENT_OUTDOOR == 3,
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
