/* Lighting that the reference computes: a vertex program in the order of Mesa's own fixed functions. */
#include <stdio.h>
#include <string.h>

#include "reference/gl/glsl_unit.h"
#include "reference/gl/reference_gl.h"

/* lamp_at_point returns the unit vector to light i and the share of its colour that arrives: RULES.md, rule 32. The
 * share of a directional light is a constant 1, which changes no bit. */
#define LAMP                                                                                                           \
    "#ifdef PLACED\n"                                                                                                  \
    "uniform vec4 lamp_at[LIGHTS], lamp_axis[LIGHTS], lamp_fall[LIGHTS];\n"                                            \
    "vec4 lamp_at_point(int i, vec3 point)\n"                                                                          \
    "{\n"                                                                                                              \
    "    if (lamp_at[i].w == 0.0) return vec4(to_light[i], 1.0);\n"                                                    \
    "    precise vec3 way = lamp_at[i].xyz - point, l = unit(way);\n"                                                  \
    "    precise float q = sum_of_products(way, way), t = q * lamp_axis[i].w;\n"                                       \
    "    precise float window = clamp(1.0 - t * t, 0.0, 1.0);\n"                                                       \
    "    precise float cosine = sum_of_products(l, lamp_axis[i].xyz);\n"                                               \
    "    precise float cone = clamp(cosine * lamp_fall[i].x + lamp_fall[i].y, 0.0, 1.0);\n"                            \
    "    precise float fall = lamp_fall[i].z / max(q, lamp_fall[i].w);\n"                                              \
    "    precise float share = (fall * window) * (cone * cone);\n"                                                     \
    "    return vec4(l, share);\n"                                                                                     \
    "}\n"                                                                                                              \
    "#else\n"                                                                                                          \
    "vec4 lamp_at_point(int i, vec3 point) { return vec4(to_light[i], 1.0); }\n"                                       \
    "#endif\n"

/* RULES.md, rule 21: z is summed as the fixed functions of the Mesa at hand do. */
#define FOG_Z                                                                                                          \
    "#ifdef OLDER_MESA\n"                                                                                              \
    "#define FOG_Z(m) (((m)[3].z * gl_Vertex.w + (m)[2].z * gl_Vertex.z) + (m)[1].z * gl_Vertex.y) + (m)[0].z * "      \
    "gl_Vertex.x\n"                                                                                                    \
    "#else\n"                                                                                                          \
    "#define FOG_Z(m) (((m)[0].z * gl_Vertex.x + (m)[1].z * gl_Vertex.y) + (m)[2].z * gl_Vertex.z) + (m)[3].z * "      \
    "gl_Vertex.w\n"                                                                                                    \
    "#endif\n"

/* RULES.md, rule 16. The fixed functions would
 * light in object space, through an inverse of their own, where the modelview matrix is not the identity: so it is a
 * program that lights. What ftransform() gives equals the fixed functions' position to the last bit: GL promises it.
 * The number of lights is a uniform also so that the loop stays one: Mesa's compiler would factor gl_Color out of a sum
 * that is written out (rule 18). GL itself clamps gl_FrontColor and gl_BackColor to 0..1, as it does after
 * fixed-function lighting. */
static const char *const source = "uniform vec3 ambient;\n"
                                  "uniform int light_count;\n"
                                  "uniform vec3 to_light[LIGHTS];\n"
                                  "uniform vec3 light_color[LIGHTS];\n"
                                  "uniform vec3 normal_rows[3];\n"
                                  "uniform int side;\n" GLSL_UNIT LAMP FOG_Z "void main()\n"
                                  "{\n"
                                  "    vec3 object_normal = unit(gl_Normal);\n"
                                  "    vec3 normal = unit(vec3(sum_of_products(normal_rows[0], object_normal),\n"
                                  "                            sum_of_products(normal_rows[1], object_normal),\n"
                                  "                            sum_of_products(normal_rows[2], object_normal)));\n"
                                  "    precise vec3 front = ambient * gl_Color.rgb, back = front;\n"
                                  "    for (int i = 0; i < light_count; i++) {\n"
                                  "        precise vec4 lamp = lamp_at_point(i, gl_MultiTexCoord1.xyz);\n"
                                  "        precise float facing = sum_of_products(normal, lamp.xyz);\n"
                                  "        precise vec3 diffuse = light_color[i] * gl_Color.rgb;\n"
                                  "        if (facing > 0.0)\n"
                                  "            front += diffuse * (facing * lamp.w);\n"
                                  "        else\n"
                                  "            back += diffuse * (-facing * lamp.w);\n"
                                  "    }\n"
                                  "    gl_Position = ftransform();\n"
                                  "    mat4 m = gl_ModelViewMatrix;\n"
                                  "    gl_TexCoord[0] = gl_MultiTexCoord0;\n"
                                  "    precise float z = FOG_Z(m);\n"
                                  "    gl_FogFragCoord = abs(z);\n"
                                  "    gl_FrontColor = vec4(side == 2 ? back : front, gl_Color.a);\n"
                                  "    gl_BackColor = vec4(side == 1 ? front : back, gl_Color.a);\n"
                                  "}\n";

/* What is shaded pixel by pixel: its own colour, normal and point are varyings. The power has an exponent that the
 * compiler does not know. FIXED: see struct reference. */
static const char *const late_vertex =
    "uniform vec3 normal_rows[3];\n"
    "uniform vec4 to_eye[4], eye;\n" /* columns */
    "varying float depth, opacity;\n"
    "varying vec2 place;\n"
    "varying vec3 own_color, normal, point;\n" GLSL_UNIT FOG_Z "void main()\n"
    "{\n"
    "    place = gl_MultiTexCoord0.xy;\n"
    "    vec3 n = unit(gl_Normal);\n"
    "    normal = unit(vec3(sum_of_products(normal_rows[0], n), sum_of_products(normal_rows[1], n),\n"
    "                       sum_of_products(normal_rows[2], n)));\n"
    "    precise vec4 p = ((gl_Vertex.x * to_eye[0] + gl_Vertex.y * to_eye[1]) + gl_Vertex.z * to_eye[2]) +\n"
    "                     gl_Vertex.w * to_eye[3];\n"
    "    precise vec3 way = p.xyz - eye.xyz * p.w;\n"
    "    point = eye.w == 0.0 ? p.xyz : way;\n"
    "    own_color = gl_Color.rgb;\n"
    "    opacity = gl_Color.a;\n"
    "    precise float z = FOG_Z(to_eye);\n"
    "    depth = abs(z);\n"
    "    gl_Position = ftransform();\n"
    "}\n";

static const char *const late_fragment =
    "uniform vec3 ambient, specular;\n"
    "uniform float shininess;\n"
    "#ifndef FIXED\n"
    "uniform int light_count, side, model, in_fog;\n"
    "uniform bool textured;\n"
    "#endif\n"
    "uniform sampler2D image;\n"
    "varying vec2 place;\n"
    "varying float depth, opacity;\n"
    "uniform vec4 eye;\n"
    "uniform vec3 to_light[LIGHTS];\n"
    "uniform vec3 light_color[LIGHTS];\n"
    "varying vec3 own_color, normal, point;\n" GLSL_UNIT LAMP "void main()\n"
    "{\n"
    "    bool back = side == 0 ? !gl_FrontFacing : side == 2;\n"
    "    precise vec3 n = unit(back ? -normal : normal), sum;\n"
    "    if (model == 1) {\n"
    "        sum = n * 0.5 + 0.5;\n"
    "    } else {\n"
    "        precise vec3 base = textured ? own_color * texture2D(image, place).rgb : own_color;\n"
    "        vec3 to_viewer = eye.w == 0.0 ? eye.xyz : unit(-point);\n"
    "        sum = ambient * base;\n"
    "        for (int i = 0; i < light_count; i++) {\n"
    "            precise vec4 lamp = lamp_at_point(i, point);\n"
    "            precise float facing = sum_of_products(n, lamp.xyz), share = max(facing, 0.0) * lamp.w;\n"
    "            precise vec3 diffuse = light_color[i] * base, shine = light_color[i] * specular;\n"
    "            sum = sum + share * diffuse;\n"
    "            if (facing > 0.0) {\n"
    "                precise vec3 between = lamp.xyz + to_viewer;\n"
    "                float cosine = min(max(sum_of_products(n, unit(between)), 0.0), 1.0);\n"
    "                precise float power = (cosine > 0.0 ? pow(cosine, shininess) : 0.0) * lamp.w;\n"
    "                sum = sum + power * shine;\n"
    "            }\n"
    "        }\n"
    "    }\n"
    "    precise float slope = -1.0 / (gl_Fog.end - gl_Fog.start);\n"
    "    precise float own = clamp(depth * slope + gl_Fog.end * -slope, 0.0, 1.0);\n"
    "    precise vec3 fogged = gl_Fog.color.rgb * (1.0 - own) + clamp(sum, 0.0, 1.0) * own;\n"
    "    float through = textured ? texture2D(image, place).a : 1.0;\n"
    "    gl_FragColor = vec4(in_fog == 1 ? fogged : sum, opacity * through);\n"
    "}\n";

/* Drivers that know no `precise` do without: they are held to what rounding explains. Vertices that only directional
 * lights light have always done without. */
static bool make_lighter(const struct reference *reference, struct reference_lighter *lighter, const char *vertex,
                         const char *fragment, bool is_placed, struct reference_error *error)
{
    static const char *const versions[] = {"#version 400 compatibility\n", "#version 120\n#define precise\n"};
    static char whole_vertex[1 << 13], whole_fragment[1 << 13];
    const char *const older = reference->mesa_version < REFERENCE_CURRENT_MESA ? "#define OLDER_MESA\n" : "";
    const char *const fixed = fragment ? reference->fixed : NULL;
    const char *const lights = is_placed ? "#define PLACED\n#define LIGHTS 64\n" : "#define LIGHTS 1024\n";
    for (size_t i = fragment || is_placed ? 0 : 1; i < sizeof versions / sizeof versions[0]; i++) {
        snprintf(whole_vertex, sizeof whole_vertex, "%s%s%s%s", versions[i], lights, older, vertex);
        snprintf(whole_fragment, sizeof whole_fragment, "%s%s%s%s", versions[i], lights, fixed ? fixed : "",
                 fragment ? fragment : "");
        lighter->program = reference_program(whole_vertex, fragment ? whole_fragment : NULL, error);
        if (lighter->program) break;
    }
    if (!lighter->program) return false;
    const GLuint program = lighter->program;
    lighter->ambient = glGetUniformLocation(program, "ambient");
    lighter->light_count = glGetUniformLocation(program, "light_count");
    lighter->to_light = glGetUniformLocation(program, "to_light");
    lighter->light_color = glGetUniformLocation(program, "light_color");
    lighter->normal_rows = glGetUniformLocation(program, "normal_rows");
    lighter->side = glGetUniformLocation(program, "side");
    lighter->to_eye = glGetUniformLocation(program, "to_eye");
    lighter->model = glGetUniformLocation(program, "model");
    lighter->specular = glGetUniformLocation(program, "specular");
    lighter->shininess = glGetUniformLocation(program, "shininess");
    lighter->eye = glGetUniformLocation(program, "eye");
    lighter->in_fog = glGetUniformLocation(program, "in_fog");
    lighter->lamp_at = glGetUniformLocation(program, "lamp_at");
    lighter->lamp_axis = glGetUniformLocation(program, "lamp_axis");
    lighter->lamp_fall = glGetUniformLocation(program, "lamp_fall");
    lighter->textured = glGetUniformLocation(program, "textured");
    return true;
}
_Static_assert(REFERENCE_LIGHTS_MAX == 1024 && REFERENCE_PLACED_MAX == 64, "the programs have these numbers");

static void set_places(const struct reference_lighter *lighter, const struct reference_lighting *lighting)
{
    float at[REFERENCE_PLACED_MAX][4], axis[REFERENCE_PLACED_MAX][4], fall[REFERENCE_PLACED_MAX][4];
    for (uint32_t i = 0; i < lighting->count; i++) {
        const struct reference_place *place = &lighting->places[i];
        const float numbers[4] = {place->scale, place->offset, place->unit, place->least};
        memcpy(at[i], place->position, sizeof at[i]);
        memcpy(axis[i], place->axis, sizeof axis[i]);
        memcpy(fall[i], numbers, sizeof fall[i]);
    }
    glUniform4fv(lighter->lamp_at, (GLsizei)lighting->count, at[0]);
    glUniform4fv(lighter->lamp_axis, (GLsizei)lighting->count, axis[0]);
    glUniform4fv(lighter->lamp_fall, (GLsizei)lighting->count, fall[0]);
}

static void set_lights(const struct reference_lighter *lighter, const struct reference_lighting *lighting)
{
    glUseProgram(lighter->program);
    glUniform3fv(lighter->ambient, 1, &lighting->ambient.x);
    glUniform1i(lighter->light_count, (GLint)lighting->count);
    if (lighting->count == 0) return;
    glUniform3fv(lighter->to_light, (GLsizei)lighting->count, &lighting->to_light[0].x);
    glUniform3fv(lighter->light_color, (GLsizei)lighting->count, &lighting->colors[0].x);
    if (lighting->places) set_places(lighter, lighting);
}

static bool any_late(const struct reference_arrays *arrays)
{
    for (uint32_t i = 0; i < arrays->batch_count; i++)
        if (arrays->batches[i].late) return true;
    return false;
}

static struct reference_lighter *lighter_of(struct reference *reference, const struct reference_lighting *lighting,
                                            bool is_per_pixel)
{
    if (lighting->places) return is_per_pixel ? &reference->placed_late_lighter : &reference->placed_lighter;
    return is_per_pixel ? &reference->late_lighter : &reference->lighter;
}

bool reference_light_begin(struct reference *reference, const struct reference_arrays *arrays,
                           struct reference_error *error)
{
    const struct reference_lighting *lighting = arrays->lighting;
    const bool is_placed = lighting->places != NULL;
    struct reference_lighter *lighter = lighter_of(reference, lighting, false),
                             *late_lighter = lighter_of(reference, lighting, true);
    if (lighting->count > (is_placed ? REFERENCE_PLACED_MAX : REFERENCE_LIGHTS_MAX))
        return reference_failed(error, "too many lights");
    if (!lighter->program && !make_lighter(reference, lighter, source, NULL, is_placed, error)) return false;
    set_lights(lighter, lighting);
    if (any_late(arrays)) {
        if (!late_lighter->program &&
            !make_lighter(reference, late_lighter, late_vertex, late_fragment, is_placed, error))
            return false;
        set_lights(late_lighter, lighting);
    }
    return reference_gl_ok(error, "light");
}

void reference_light_batch(struct reference *reference, const struct reference_arrays *arrays,
                           const struct reference_batch *batch)
{
    static const GLint sides[] = {[REFERENCE_LIT] = 0, [REFERENCE_LIT_FRONT] = 1, [REFERENCE_LIT_BACK] = 2};
    if (batch->light == REFERENCE_UNLIT) {
        glUseProgram(0);
        return;
    }
    const struct reference_lighter *lighter = lighter_of(reference, arrays->lighting, batch->late);
    glUseProgram(lighter->program);
    glUniform3fv(lighter->normal_rows, 3, &batch->normal_rows[0].x);
    glUniform1i(lighter->side, sides[batch->light]);
    if (!batch->late) return;
    glUniform1i(lighter->in_fog, glIsEnabled(GL_FOG));
    glUniform1i(lighter->textured, batch->textured != NULL);
    glUniform4fv(lighter->to_eye, 4, batch->to_eye->m);
    glUniform1i(lighter->model, batch->late->shading == ZR_SHADING_NORMALS);
    glUniform3fv(lighter->specular, 1, &batch->late->specular.x);
    glUniform1f(lighter->shininess, batch->late->shininess);
    glUniform4fv(lighter->eye, 1, &batch->eye.x);
}
