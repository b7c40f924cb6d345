/* plates.h - unit: plates with holes and bosses as meshes of faces with rings, and spheres, cones and tori. */
#ifndef ZR_TEST_PLATES_H
#define ZR_TEST_PLATES_H

#include <math.h>

#include "base/trig.h"
#include "scene/scene.h"

enum { PLATE_POSITIONS = 1 << 15, PLATE_CORNERS = 1 << 18, PLATE_RINGS = 1 << 16 };

struct plate_point {
    double x, y, z;
};

/* A hole from the top, or a boss on it if `height` > 0. */
struct drill {
    double x, y, radius, depth; /* 0: through */
    uint32_t segments;
    double bore, bore_depth; /* counterbore; 0: none */
    double height;
    double cone; /* depth of a countersink of 45 degrees from the top; 0: none */
    double tip;  /* depth of a cone under a blind hole; 0: flat */
};

static struct plate {
    uint32_t positions, corners, rings, faces;
    zr_vec4 position[PLATE_POSITIONS];
    uint32_t index[PLATE_CORNERS], ring_offsets[PLATE_RINGS + 1], face_rings[PLATE_RINGS + 1],
        face_offsets[PLATE_RINGS + 1];
    double turn[9], move[3];
} plate;

static inline uint32_t plate_place(double x, double y, double z)
{
    const double *t = plate.turn, *m = plate.move;
    plate.position[plate.positions] =
        (zr_vec4){(float)(t[0] * x + t[1] * y + t[2] * z + m[0]), (float)(t[3] * x + t[4] * y + t[5] * z + m[1]),
                  (float)(t[6] * x + t[7] * y + t[8] * z + m[2]), 1.0f};
    return plate.positions++;
}

static inline void plate_begin(void)
{
    static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    plate.positions = plate.corners = plate.rings = plate.faces = 0;
    memcpy(plate.turn, unit, sizeof unit);
    plate.move[0] = plate.move[1] = plate.move[2] = 0.0;
}

/* Turns what follows around x, then around z, and moves it. */
static inline void plate_turn(double around_x, double around_z, double x, double y, double z)
{
    double s, c, sz, cz;
    zr_sine_cosine(around_x, &s, &c);
    zr_sine_cosine(around_z, &sz, &cz);
    const double turn[9] = {cz, 0.0 - sz * c, sz * s, sz, cz * c, 0.0 - cz * s, 0, s, c};
    memcpy(plate.turn, turn, sizeof turn);
    plate.move[0] = x;
    plate.move[1] = y;
    plate.move[2] = z;
}

static inline struct plate_point plate_direction(const double turn[9], struct plate_point p)
{
    return (struct plate_point){turn[0] * p.x + turn[1] * p.y + turn[2] * p.z,
                                turn[3] * p.x + turn[4] * p.y + turn[5] * p.z,
                                turn[6] * p.x + turn[7] * p.y + turn[8] * p.z};
}

static inline void plate_face(void)
{
    plate.face_rings[plate.faces] = plate.rings;
    plate.face_offsets[plate.faces++] = plate.corners;
}

/* Adds a ring of `count` successive places to the face, in reverse if `back`. */
static inline void plate_ring(uint32_t first, uint32_t count, bool back)
{
    plate.ring_offsets[plate.rings++] = plate.corners;
    for (uint32_t i = 0; i < count; i++)
        plate.index[plate.corners++] = first + (back ? count - 1 - i : i);
}

static inline void plate_triangle(uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t corners[3] = {a, b, c};
    plate_face();
    plate.ring_offsets[plate.rings++] = plate.corners;
    memcpy(&plate.index[plate.corners], corners, sizeof corners);
    plate.corners += 3;
}

static inline void plate_quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    plate_triangle(a, b, c);
    plate_triangle(a, c, d);
}

static inline uint32_t plate_circle(double x, double y, double z, double radius, uint32_t segments)
{
    const uint32_t first = plate.positions;
    double s, c;
    for (uint32_t i = 0; i < segments; i++) {
        zr_sine_cosine(360.0 * i / segments + 7.0, &s, &c);
        plate_place(x + radius * c, y + radius * s, z);
    }
    return first;
}

/* Joins two circles by a wall whose outside is away from the axis if `low` lies below `high`. */
static inline void plate_wall(uint32_t low, uint32_t high, uint32_t segments)
{
    for (uint32_t i = 0, k; i < segments; i++) {
        k = (i + 1) % segments;
        plate_quad(low + i, low + k, high + k, high + i);
    }
}

static inline void plate_annulus(uint32_t outer, uint32_t inner, uint32_t segments, bool down)
{
    plate_face();
    plate_ring(outer, segments, down);
    plate_ring(inner, segments, !down);
}

/* Makes a drill below the circle at the top. Returns its circle at the bottom of the plate; UINT32_MAX: none. */
static inline uint32_t plate_drill(const struct drill *d, double top, uint32_t mouth)
{
    uint32_t at = mouth;
    double z = top;
    if (d->height > 0.0) {
        const uint32_t high = plate_circle(d->x, d->y, top + d->height, d->radius, d->segments);
        plate_wall(mouth, high, d->segments);
        plate_face();
        plate_ring(high, d->segments, false);
        return UINT32_MAX;
    }
    if (d->bore > 0.0) {
        const uint32_t floor = plate_circle(d->x, d->y, z -= d->bore_depth, d->bore, d->segments);
        plate_wall(at, floor, d->segments);
        at = plate_circle(d->x, d->y, z, d->radius, d->segments);
        plate_annulus(floor, at, d->segments, false);
    } else if (d->cone > 0.0) {
        const uint32_t next = plate_circle(d->x, d->y, z -= d->cone, d->radius, d->segments);
        plate_wall(at, next, d->segments);
        at = next;
    }
    const uint32_t end = plate_circle(d->x, d->y, d->depth > 0.0 ? z - d->depth : 0.0, d->radius, d->segments);
    plate_wall(at, end, d->segments);
    if (d->depth <= 0.0) return end;
    if (d->tip > 0.0) {
        const uint32_t tip = plate_place(d->x, d->y, z - d->depth - d->tip);
        for (uint32_t i = 0; i < d->segments; i++)
            plate_triangle(tip, end + i, end + (i + 1) % d->segments);
    } else {
        plate_face();
        plate_ring(end, d->segments, false);
    }
    return UINT32_MAX;
}

/* Makes a plate from z = 0 to `height` around the middle, with at most 64 drills. */
static inline void plate_drilled(double width, double length, double height, const struct drill *drills, uint32_t count)
{
    uint32_t mouths[64], ends[64], box[2];
    for (int k = 0; k < 2; k++) {
        const double z = k ? height : 0.0, x = 0.5 * width, y = 0.5 * length;
        box[k] = plate_place(0.0 - x, 0.0 - y, z);
        plate_place(x, 0.0 - y, z);
        plate_place(x, y, z);
        plate_place(0.0 - x, y, z);
    }
    for (uint32_t i = 0; i < count; i++) {
        const struct drill *d = &drills[i];
        mouths[i] = plate_circle(d->x, d->y, height, d->bore > 0.0 ? d->bore : d->radius + d->cone, d->segments);
    }
    plate_face();
    plate_ring(box[1], 4, false);
    for (uint32_t i = 0; i < count; i++)
        plate_ring(mouths[i], drills[i].segments, true);
    plate_wall(box[0], box[1], 4);
    for (uint32_t i = 0; i < count; i++)
        ends[i] = plate_drill(&drills[i], height, mouths[i]);
    plate_face();
    plate_ring(box[0], 4, true);
    for (uint32_t i = 0; i < count; i++)
        if (ends[i] != UINT32_MAX) plate_ring(ends[i], drills[i].segments, false);
}

/* Makes a closed body of circles around z, from below; radius 0 is a point. The surface closes in a ring if `ring`. */
static inline void plate_turned(const double (*profile)[2], uint32_t count, uint32_t segments, bool ring)
{
    uint32_t first = 0, before = 0;
    for (uint32_t i = 0; i < count + ring; i++) {
        const double radius = profile[i % count][0], z = profile[i % count][1];
        const uint32_t at = i == count     ? first
                            : radius > 0.0 ? plate_circle(0, 0, z, radius, segments)
                                           : plate_place(0, 0, z);
        if (i == 0) first = at;
        for (uint32_t k = 0, n; i > 0 && k < segments; k++) {
            n = (k + 1) % segments;
            if (profile[i - 1][0] <= 0.0)
                plate_triangle(before, at + n, at + k);
            else if (radius <= 0.0)
                plate_triangle(before + k, before + n, at);
            else
                plate_quad(before + k, before + n, at + n, at + k);
        }
        before = at;
    }
}

static inline struct zr_mesh plate_mesh(void)
{
    plate.face_rings[plate.faces] = plate.rings;
    plate.ring_offsets[plate.rings] = plate.face_offsets[plate.faces] = plate.corners;
    return (struct zr_mesh){.name = "plate",
                            .position_count = plate.positions,
                            .positions = plate.position,
                            .face_count = plate.faces,
                            .face_offsets = plate.face_offsets,
                            .face_rings = plate.face_rings,
                            .ring_offsets = plate.ring_offsets,
                            .indices = plate.index};
}

#endif
