/* replay_parts.h - support: state and helpers shared by the players of a trace (replay.h). */
#ifndef ZR_TEST_REPLAY_PARTS_H
#define ZR_TEST_REPLAY_PARTS_H

#include <cjson/cJSON.h>

#include "support/pictures/replay.h"

enum { SIDE = REPLAY_SIDE_MAX, PRIMITIVES = 64, EDGES = 8192 };

struct primitive {
    uint32_t face_id, first_edge, edge_count;
    bool is_triangle, is_flat; /* is_flat: one plane has its depth */
};

/* Rows count from the bottom, as in the trace. */
struct replay_play {
    const char *name;
    int width, height, count;
    struct primitive primitives[PRIMITIVES + 1]; /* by id */
    int64_t edges[EDGES][4];                     /* in 1/256 */
    uint32_t edge_count;
    uint32_t shown[SIDE][SIDE]; /* ids */
    float depth[SIDE][SIDE];
    struct replay *out;
};
extern struct replay_play replay_play;

#define CHECK(condition, ...)                                                                                          \
    if (!(condition)) replay_fail(#condition, __VA_ARGS__)

/* Fails the running test. */
void replay_fail(const char *condition, const char *format, ...);

/* Returns true if the sample is inside the edges of a primitive, by the odd-even rule. */
bool replay_covers(const struct primitive *p, int x, int y);

/* ---- the painter ---- */

void replay_painter_begin(void);
void replay_painter(const cJSON *step);
void replay_painter_end(void);

/* ---- values ---- */

static inline const cJSON *member(const cJSON *object, const char *key)
{
    const cJSON *found = cJSON_GetObjectItemCaseSensitive(object, key);
    CHECK(found, "no %s", key);
    return found;
}

static inline double number_of(const cJSON *item)
{
    CHECK(cJSON_IsNumber(item), "no number");
    return item->valuedouble;
}

static inline int whole_of(const cJSON *item)
{
    const double value = number_of(item);
    CHECK(value == (double)(int)value, "%g is no integer", value);
    return (int)value;
}

static inline int whole(const cJSON *object, const char *key)
{
    return whole_of(member(object, key));
}

static inline int64_t long_of(const cJSON *item)
{
    return (int64_t)number_of(item);
}

static inline int64_t long_at(const cJSON *object, const char *key)
{
    return long_of(member(object, key));
}

static inline const cJSON *at(const cJSON *list, int place)
{
    const cJSON *item = cJSON_GetArrayItem(list, place);
    CHECK(item, "a list is shorter than %d", place + 1);
    return item;
}

static inline int length(const cJSON *list)
{
    CHECK(cJSON_IsArray(list), "no list");
    return cJSON_GetArraySize(list);
}

static inline bool has(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

static inline const struct primitive *primitive_of(int id)
{
    CHECK(id >= 1 && id <= replay_play.count, "primitive %d", id);
    return &replay_play.primitives[id];
}

#endif
