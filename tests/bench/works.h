/* works.h - bench: what is drawn, by both sides, from the same floats. */
#ifndef ZR_BENCH_WORKS_H
#define ZR_BENCH_WORKS_H

#include "base/arena.h"
#include "bench/results.h"
#include "reference/drawing.h"

/* A face has one colour, that of its first vertex, or colours are interpolated, perspective-correct. */
enum work_shade { WORK_FLAT, WORK_GOURAUD, WORK_SHADES };

/* Nothing here needs clipping and culling at once, so that culling is exact, too (RULES.md, rule 11). */
enum work_culling { WORK_NOT_CULLED, WORK_BAR_IF_CULLED, WORK_BAR_ALWAYS };

struct work {
    char name[64];
    struct drawing drawing;
    enum work_culling culling;
    struct bar bars[WORK_SHADES]; /* with AVX-512 */

    /* The faces as triangles, as GL takes them: those of three corners as they are, others as fans (i-1, i, 0). */
    uint32_t *corners, corner_count;

    /* What both sides read of the drawing and the corners: where the service has the arrays of a request. */
    struct zr_arena arena;
};

/* One way to draw a work. */
struct variant {
    enum work_shade shade;
    bool culled;
};

enum works {
    WORK_FILL_BACK_FIRST,
    WORK_FILL_FRONT_FIRST,
    WORK_BUNNY,
    WORK_BUNNY_SMALL,
    WORK_DENSE,
    WORK_DENSE_SMALL,
    WORK_CUBE,
    WORK_POLYGONS,
    WORKS
};

/* What the meshes are made of: "bunny", where the directory of models has it, else "generated ball". */
const char *works_animal(const char *directory);

/* Without the models of `directory` there are generated ones of comparable size, and their names say so. False,
 * explained on stderr. works_free in any case. */
bool works_make(enum works number, const char *directory, struct work *work);
void works_free(struct work *work);

/* Looks at an animal in a window of another size. */
void works_look(struct work *work, uint32_t width, uint32_t height);

/* Culled ones first. */
enum { WORK_VARIANTS_MAX = 4 };
int works_variants(const struct work *work, struct variant variants[WORK_VARIANTS_MAX]);

/* Such as "bunny 69 k 1080p flat culled". */
void works_variant_name(const struct work *work, const struct variant *variant, char *name, size_t size);

/* What is to be reached with AVX-512, on any number of threads; 0, 0: nothing. */
struct bar works_bar(const struct work *work, const struct variant *variant);

#endif
