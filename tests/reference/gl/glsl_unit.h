/* glsl_unit.h - reference: what programs of GLSL share that must not be rewritten by a compiler: a sum of three
 * products, and a vector's unit vector, as rule 16 of RULES.md has them.
 */
#ifndef ZR_TEST_GLSL_UNIT_H
#define ZR_TEST_GLSL_UNIT_H

/* Sums are written out, since a compiler may choose the order of dot(). Squares of lengths that a float holds badly:
 * the vector is made shorter or longer first. `precise`: Mesa's compiler may not rewrite what follows (rule 18). */
#define GLSL_UNIT                                                                                                      \
    "float sum_of_products(vec3 a, vec3 b)\n"                                                                          \
    "{\n"                                                                                                              \
    "    precise float sum = (a.z * b.z + a.y * b.y) + a.x * b.x;\n"                                                   \
    "    return sum;\n"                                                                                                \
    "}\n"                                                                                                              \
    "vec3 unit(vec3 v)\n"                                                                                              \
    "{\n"                                                                                                              \
    "    precise vec3 u = v;\n"                                                                                        \
    "    float square = sum_of_products(u, u);\n"                                                                      \
    "    if (!(square > 1e-30 && square < 1e30)) {\n"                                                                  \
    "        float largest = max(max(abs(u.x), abs(u.y)), abs(u.z));\n"                                                \
    "        if (!(largest > 0.0)) return u;\n"                                                                        \
    "        u = u / largest;\n"                                                                                       \
    "        square = sum_of_products(u, u);\n"                                                                        \
    "    }\n"                                                                                                          \
    "    u = u * (1.0 / sqrt(square));\n"                                                                              \
    "    return u;\n"                                                                                                  \
    "}\n"

#endif
