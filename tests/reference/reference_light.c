/* Lighting that the reference computes: a vertex program in the order of Mesa's own fixed functions. */
#include "reference/reference_gl.h"

/* RULES.md, rule 16. Sums are written out, since a compiler may choose the order of dot(). The fixed functions would
 * light in object space, through an inverse of their own, where the modelview matrix is not the identity: so it is a
 * program that lights. What ftransform() gives equals the fixed functions' position to the last bit: GL promises it.
 * The number of lights is a uniform also so that the loop stays one: Mesa's compiler would factor gl_Color out of a sum
 * that is written out (rule 18). GL itself clamps gl_FrontColor and gl_BackColor to 0..1, as it does after
 * fixed-function lighting. */
static const char *const source =
    "#version 120\n"
    "uniform vec3 ambient;\n"
    "uniform int light_count;\n"
    "uniform vec3 to_light[1024];\n"
    "uniform vec3 light_color[1024];\n"
    "uniform vec3 normal_rows[3];\n"
    "uniform int side;\n"
    "float sum_of_products(vec3 a, vec3 b)\n"
    "{\n"
    "    return (a.z * b.z + a.y * b.y) + a.x * b.x;\n"
    "}\n"
    /* Squares of lengths that a float holds badly: the vector is made shorter or longer first. */
    "vec3 unit(vec3 v)\n"
    "{\n"
    "    float square = sum_of_products(v, v);\n"
    "    if (!(square > 1e-30 && square < 1e30)) {\n"
    "        float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));\n"
    "        if (!(largest > 0.0)) return v;\n"
    "        v = v / largest;\n"
    "        square = sum_of_products(v, v);\n"
    "    }\n"
    "    return v * (1.0 / sqrt(square));\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec3 object_normal = unit(gl_Normal);\n"
    "    vec3 normal = unit(vec3(sum_of_products(normal_rows[0], object_normal),\n"
    "                            sum_of_products(normal_rows[1], object_normal),\n"
    "                            sum_of_products(normal_rows[2], object_normal)));\n"
    "    vec3 front = ambient * gl_Color.rgb, back = front;\n"
    "    for (int i = 0; i < light_count; i++) {\n"
    "        float facing = sum_of_products(normal, to_light[i]);\n"
    "        vec3 diffuse = light_color[i] * gl_Color.rgb;\n"
    "        if (facing > 0.0)\n"
    "            front += diffuse * facing;\n"
    "        else\n"
    "            back += diffuse * -facing;\n"
    "    }\n"
    "    gl_Position = ftransform();\n"
    "    gl_FrontColor = vec4(side == 2 ? back : front, gl_Color.a);\n"
    "    gl_BackColor = vec4(side == 1 ? front : back, gl_Color.a);\n"
    "}\n";

static bool make_lighter(struct reference_lighter *lighter, struct reference_error *error)
{
    GLuint program = lighter->program = reference_program(source, NULL, error);
    if (!program) return false;
    lighter->ambient = glGetUniformLocation(program, "ambient");
    lighter->light_count = glGetUniformLocation(program, "light_count");
    lighter->to_light = glGetUniformLocation(program, "to_light");
    lighter->light_color = glGetUniformLocation(program, "light_color");
    lighter->normal_rows = glGetUniformLocation(program, "normal_rows");
    lighter->side = glGetUniformLocation(program, "side");
    return true;
}

bool reference_light_begin(struct reference *reference, const struct reference_lighting *lighting,
                           struct reference_error *error)
{
    struct reference_lighter *lighter = &reference->lighter;
    if (lighting->count > REFERENCE_LIGHTS_MAX) return reference_failed(error, "too many lights");
    if (!lighter->program && !make_lighter(lighter, error)) return false;
    glUseProgram(lighter->program);
    glUniform3fv(lighter->ambient, 1, &lighting->ambient.x);
    glUniform1i(lighter->light_count, (GLint)lighting->count);
    if (lighting->count > 0) {
        glUniform3fv(lighter->to_light, (GLsizei)lighting->count, &lighting->to_light[0].x);
        glUniform3fv(lighter->light_color, (GLsizei)lighting->count, &lighting->colors[0].x);
    }
    return reference_gl_ok(error, "light");
}

void reference_light_batch(const struct reference *reference, const struct reference_batch *batch)
{
    static const GLint sides[] = {[REFERENCE_LIT] = 0, [REFERENCE_LIT_FRONT] = 1, [REFERENCE_LIT_BACK] = 2};
    const struct reference_lighter *lighter = &reference->lighter;
    if (batch->light == REFERENCE_UNLIT) {
        glUseProgram(0);
        return;
    }
    glUseProgram(lighter->program);
    glUniform3fv(lighter->normal_rows, 3, &batch->normal_rows[0].x);
    glUniform1i(lighter->side, sides[batch->light]);
}
