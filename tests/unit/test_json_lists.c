/* The large lists of a scene, which are read from the text itself: in every spelling the same scene, for every
 * fault the pointer to it, and of any text the judgement that cJSON and the rules of the contract give. */
#include <cjson/cJSON.h>
#include <math.h>

#include "input/json_scan.h"
#include "json_check.h"

#define FACES   "\"faces\":[[0,1,2]]"
#define CORNERS "{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]"

/* ---- texts ---- */

struct text {
    char *bytes;
    size_t size, room;
};

static void put(struct text *text, const char *bytes, size_t size)
{
    if (text->size + size + 1 > text->room) {
        text->room = 2 * (text->size + size) + 4096;
        text->bytes = realloc(text->bytes, text->room);
        assert_non_null(text->bytes);
    }
    memcpy(text->bytes + text->size, bytes, size);
    text->size += size;
    text->bytes[text->size] = '\0';
}

static void add(struct text *text, const char *format, ...)
{
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    int size = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    put(text, line, (size_t)size);
}

static void drop(struct text *text)
{
    free(text->bytes);
    *text = (struct text){0};
}

static uint64_t seed = 88172645463325252u;

static size_t below(size_t count)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (size_t)((seed * 0x2545F4914F6CDD1Du) >> 33) % count;
}

static double any_place(void)
{
    return ((double)below(2000001) - 1e6) / (double)(below(3) ? 1000000 : 10);
}

/* ---- the same scene in other spellings ---- */

enum spelling { AS_IT_IS, SPACED, LINES, EXPONENTS, LONG, ESCAPED_KEYS, SPELLINGS };

static bool begins_number(const char *text, const char *at)
{
    bool is = (*at >= '0' && *at <= '9') || *at == '-';
    return is && at > text && (at[-1] == '[' || at[-1] == ',');
}

static void put_number(struct text *out, enum spelling spelling, double value)
{
    if (spelling == EXPONENTS && below(2))
        add(out, "%.17e", value);
    else if (spelling == EXPONENTS)
        add(out, "%.17E", value);
    else
        add(out, "%.17g", value);
}

/* The compact text without escapes, said otherwise. */
static struct text respell(const char *text, enum spelling spelling)
{
    struct text out = {0};
    for (const char *at = text; *at;) {
        if ((spelling == EXPONENTS || spelling == LONG) && begins_number(text, at)) {
            char *behind;
            put_number(&out, spelling, strtod(at, &behind));
            at = behind;
        } else if (spelling == ESCAPED_KEYS && *at == '"' && at[1] >= 'a' && at[1] <= 'z') {
            size_t length = strcspn(at + 1, "\""), place = 1 + below(length);
            bool is_key = at[length + 2] == ':';
            put(&out, at, is_key ? place : length + 2);
            if (is_key) {
                add(&out, below(2) ? "\\u%04x" : "\\u%04X", at[place]);
                put(&out, at + place + 1, length + 1 - place);
            }
            at += length + 2;
        } else {
            put(&out, at, 1);
            if (spelling == SPACED && (*at == ',' || *at == ':')) add(&out, " ");
            if (spelling == LINES && strchr("[]{},:", *at)) add(&out, "%s", below(2) ? "\r\n\t" : "\n  ");
            at++;
        }
    }
    return out;
}

static void assert_same_array(const void *a, const void *b, size_t count, size_t size)
{
    assert_int_equal(a == NULL, b == NULL);
    if (a) assert_memory_equal(a, b, count * size);
}

static void assert_same_mesh(const struct zr_mesh *a, const struct zr_mesh *b)
{
    size_t corners = a->face_offsets[a->face_count];
    assert_string_equal(a->name, b->name);
    assert_int_equal(a->position_count, b->position_count);
    assert_int_equal(a->face_count, b->face_count);
    assert_int_equal(a->line_count, b->line_count);
    assert_int_equal(a->normal_count, b->normal_count);
    assert_int_equal(a->material, b->material);
    assert_same_array(a->positions, b->positions, a->position_count, sizeof *a->positions);
    assert_same_array(a->face_offsets, b->face_offsets, a->face_count + 1, sizeof *a->face_offsets);
    assert_same_array(a->indices, b->indices, corners, sizeof *a->indices);
    assert_same_array(a->face_rings, b->face_rings, a->face_count + 1, sizeof *a->face_rings);
    if (a->face_rings)
        assert_same_array(a->ring_offsets, b->ring_offsets, a->face_rings[a->face_count] + 1, sizeof *a->ring_offsets);
    assert_same_array(a->lines, b->lines, a->line_count, 2 * sizeof *a->lines);
    assert_same_array(a->normals, b->normals, a->normal_count, sizeof *a->normals);
    assert_same_array(a->colors, b->colors, a->position_count, sizeof *a->colors);
    assert_same_array(a->face_colors, b->face_colors, a->face_count, sizeof *a->face_colors);
    assert_same_array(a->face_materials, b->face_materials, a->face_count, sizeof *a->face_materials);
}

static void assert_same_scene(const struct zr_scene *a, const struct zr_scene *b)
{
    assert_int_equal(a->mesh_count, b->mesh_count);
    assert_int_equal(a->material_count, b->material_count);
    assert_int_equal(a->warning_count, b->warning_count);
    for (uint32_t i = 0; i < a->mesh_count; i++)
        assert_same_mesh(&a->meshes[i], &b->meshes[i]);
}

static void add_places(struct text *text, size_t count, size_t most)
{
    for (size_t i = 0; i < count; i++) {
        add(text, "%s[%.9g,%.6g,%.*f", i ? "," : "", any_place(), any_place(), (int)below(17), any_place());
        for (size_t k = 3; k < most && below(2); k++)
            add(text, ",%.3g", 0.5 + (double)below(1000) / 100);
        add(text, "]");
    }
}

static void add_colors(struct text *text, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (below(3))
            add(text, "%s[%.7g,0,%.12g%s]", i ? "," : "", (double)below(1000) / 999, (double)below(9999) / 9998,
                below(2) ? "" : ",1");
        else
            add(text, "%s\"#%06zx%s\"", i ? "," : "", below(1u << 24), below(2) ? "" : "Ff");
}

static void add_mesh(struct text *text, size_t count)
{
    add(text, "{\"name\":\"part\",\"positions\":[");
    add_places(text, count, 4);
    add(text, "],\"normals\":[");
    add_places(text, count, 3);
    add(text, "],\"colors\":[");
    add_colors(text, count);
    add(text, "],\"faces\":[");
    for (size_t i = 0; i < count; i++) {
        add(text, "%s[%zu,%zu,%zu", i ? "," : "", below(count), below(count), below(count));
        for (size_t k = below(4); k > 0; k--)
            add(text, ",%zu", below(count));
        add(text, "]");
    }
    add(text, "],\"lines\":[");
    for (size_t i = 0; i < count; i++)
        add(text, "%s[%zu,%zu]", i ? "," : "", below(count), below(count));
    add(text, "],\"faceColors\":[");
    add_colors(text, count);
    add(text, "]}");
}

static void add_heights(struct text *text, size_t columns)
{
    add(text, "{\"heights\":{\"values\":[");
    for (size_t row = 0; row < 5; row++) {
        for (size_t column = 0; column < columns; column++)
            if (column % 8 == 7)
                add(text, "%snull", column ? "," : row ? ",[" : "[");
            else
                add(text, "%s%.8g", column ? "," : row ? ",[" : "[", any_place());
        add(text, "]");
    }
    add(text, "],\"x\":[-1,0.5]}}");
}

static void add_polygons(struct text *text, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        size_t vertices = 3 + below(3);
        add(text, "%s{\"vertices\":[", i ? "," : "");
        add_places(text, vertices, 4);
        add(text, "]");
        if (below(4) == 0) add(text, ",\"color\":%s", below(2) ? "[0,0.5,0.123]" : "\"#ff8000\"");
        if (below(6) == 0) {
            add(text, ",\"holes\":[[");
            add_places(text, 3, 3);
            add(text, "],[");
            vertices += 7;
            add_places(text, 4, 3);
            add(text, "]]");
        }
        if (below(4) == 0) {
            add(text, ",\"colors\":[");
            add_colors(text, vertices);
            add(text, "]");
        }
        if (below(3) == 0)
            add(text, ",\"material\":\"m%zu\",\"doubleSided\":%s", below(2), below(2) ? "true" : "false");
        if (below(4) == 0) {
            add(text, ",\"normals\":[");
            add_places(text, vertices, 3);
            add(text, "]");
        }
        add(text, "}");
    }
}

static struct text make_scene(size_t count)
{
    struct text text = {0};
    add(&text, "{\"materials\":[{\"name\":\"m0\"},{\"name\":\"m1\",\"shading\":\"unlit\"}],\"meshes\":[");
    add_mesh(&text, count);
    add(&text, ",");
    add_heights(&text, count + 2);
    add(&text, "],\"polygons\":[");
    add_polygons(&text, count);
    add(&text, "]}");
    return text;
}

static void every_spelling_gives_the_same_scene(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 2, 3, 30, 1000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        struct text text = make_scene(counts[i]);
        struct reading *first = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
        assert_read(first);
        for (enum spelling spelling = SPACED; spelling < SPELLINGS; spelling++) {
            struct text other = respell(text.bytes, spelling);
            struct reading *second = read_bytes(ZR_FORMAT_JSON, other.bytes, other.size);
            assert_read(second);
            assert_same_scene(first->scene, second->scene);
            reading_free(second);
            drop(&other);
        }
        reading_free(first);
        drop(&text);
    }
}

static void positions_are_the_floats_of_what_strtod_gives(void **state)
{
    (void)state;
    struct text text = {0};
    enum { COUNT = 5000 };
    add(&text, "{\"meshes\":[{\"faces\":[[0,1,2]],\"positions\":[");
    add_places(&text, COUNT, 3);
    add(&text, "]}]}");
    struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
    assert_read(reading);
    const zr_vec4 *position = reading->scene->meshes[0].positions;
    char *at = strstr(text.bytes, "positions") + strlen("positions\":");
    for (size_t i = 0; i < COUNT; i++, position++) {
        assert_true((float)strtod(at + 2 - (i > 0), &at) == position->x);
        assert_true((float)strtod(at + 1, &at) == position->y);
        assert_true((float)strtod(at + 1, &at) == position->z);
        at += 2;
    }
    reading_free(reading);
    drop(&text);
}

static void arrays_take_little_more_than_themselves(void **state)
{
    (void)state;
    struct text text = {0};
    enum { COUNT = 20000 };
    add(&text, "{\"polygons\":[");
    for (size_t i = 0; i < COUNT; i++) {
        add(&text, "%s{\"vertices\":[", i ? "," : "");
        add_places(&text, 3, 3);
        add(&text, "]}");
    }
    add(&text, "]}");
    struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
    assert_read(reading);
    size_t arrays = (size_t)COUNT * (3 * (sizeof(zr_vec4) + sizeof(uint32_t)) + 2 * sizeof(uint32_t));
    assert_true(reading->arena.used < arrays + arrays / 10);
    reading_free(reading);
    drop(&text);
}

/* A look that was seen before is not looked at again. What else is the same must be. */
static void polygons_written_alike_are_alike(void **state)
{
    (void)state;
    static const char *const rest[] = {
        "\"doubleSided\":true", "\"holes\":[[[0.1,0.1,0],[0.2,0.1,0],[0.1,0.2,0]]],\"doubleSided\":true",
        "\"material\":\"m\",\"holes\":[[[0.1,0.1,0],[0.2,0.1,0],[0.1,0.2,0]]],\"fill\":false",
        "\"outline\":[1,0,0],\"shading\":\"unlit\"", "\"material\":\"m\",\"color\":[1,0,0],\"fill\":false"};
    for (size_t i = 0; i < sizeof rest / sizeof *rest; i++) {
        struct text text = {0};
        add(&text, "{\"materials\":[{\"name\":\"m\"}],\"polygons\":[" CORNERS ",%s}", rest[i]);
        for (int k = 1; k < 5; k++)
            add(&text, k == 3 ? "," CORNERS "}" : "," CORNERS ",%s}", rest[i]);
        add(&text, "]}");
        struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
        assert_read(reading);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        bool has_hole = strstr(rest[i], "holes");
        for (uint32_t face = 0; face < 5; face++) {
            struct zr_rings rings = zr_mesh_rings(mesh, face);
            const struct zr_material *material = &reading->scene->materials[mesh->face_materials[face]],
                                     *first = &reading->scene->materials[mesh->face_materials[0]];
            assert_int_equal(rings.count, face != 3 && has_hole ? 2 : 1);
            if (face == 3) continue;
            assert_memory_equal(&material->base_color, &first->base_color, sizeof first->base_color);
            assert_int_equal(material->double_sided, first->double_sided);
            assert_int_equal(material->hollow, first->hollow);
            assert_int_equal(material->shading, first->shading);
            assert_int_equal(material->outline, first->outline);
            assert_int_equal(first->double_sided, strstr(rest[i], "doubleSided") != NULL);
            assert_int_equal(first->hollow, strstr(rest[i], "fill") != NULL);
        }
        reading_free(reading);
        drop(&text);
    }
}

/* Cubes, planes: a value that takes cJSON 64 bytes counts, one that is a float does not. */
static void numbers_in_large_lists_do_not_count_as_values(void **state)
{
    (void)state;
    struct text text = make_scene(100);
    struct zr_limits limits = zr_limits_default();
    limits.json_values_max = 300; /* more than a polygon has that takes the long way */
    struct reading *reading =
        read_request((struct zr_request){.format = ZR_FORMAT_JSON}, text.bytes, text.size, limits, (size_t)1 << 24);
    assert_read(reading);
    reading_free(reading);
    limits.json_values_max = 10;
    reading =
        read_request((struct zr_request){.format = ZR_FORMAT_JSON}, text.bytes, text.size, limits, (size_t)1 << 24);
    assert_complaint(reading, ZR_BAD_SCENE, "", "values in the text, more than the limit of 10");
    reading_free(reading);
    drop(&text);
}

static void lists_too_deep_for_the_limit_are_refused(void **state)
{
    (void)state;
    struct zr_limits limits = zr_limits_default();
    for (limits.json_depth_max = 1; limits.json_depth_max < 9; limits.json_depth_max++) {
        static const char *const texts[] = {"{" POLYGONS "}", "{\"meshes\":[{\"heights\":{\"values\":[[1,2],[3,4]]}}]}",
                                            "{\"meshes\":[{" POSITIONS ",\"faces\":[[0,1,[[[2]]]]]}]}"};
        for (size_t i = 0; i < 3; i++) {
            struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_JSON}, texts[i],
                                                   strlen(texts[i]), limits, (size_t)1 << 20);
            if (limits.json_depth_max < 5 + i * 1 + (i == 2))
                assert_complaint(reading, ZR_BAD_SCENE, "", "nested deeper than");
            else
                assert_int_equal(reading->status, i == 2 ? ZR_BAD_SCENE : ZR_OK);
            reading_free(reading);
        }
    }
}

/* ---- faults ---- */

struct list_case {
    const char *before, *item, *after; /* the text around a list, and a good item of it */
    const char *pointer;               /* of the list */
    const char *bad, *inner, *detail;  /* a bad item, where in it, and what is said */
};

static const struct list_case cases[] = {
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1,2e6]", "/2",
     "2000000 is outside of -1000000 to 1000000"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1]", "",
     "expected 3 or 4 numbers, found 2"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1,2,3,4]", "",
     "expected 3 or 4 numbers, found 5"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,null,2]", "/1",
     "expected a number, found null"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "7", "",
     "expected a list of numbers, found a number"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1,1e999]", "/2",
     "a number too large"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[[1],2,3]", "/0",
     "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "{\"x\":1}", "",
     "expected a list of numbers, found an object"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,\n[1],2]", "/1",
     "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0, [1],2]", "/1",
     "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[ [1],[2],[3]]",
     "/0", "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,{},[1]]", "/1",
     "expected a number, found an object"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0 ,[1],[[]]]",
     "/1", "expected a number, found a list"},
    {"{\"meshes\":[{" FACES ",\"positions\":[", "[0.5,1.25,-3e-3]", "]}]}", "/meshes/0/positions", "[0,1,\"],[\"]",
     "/2", "expected a number, found a string"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0,\n[1],2],[0,1,0]]}", "/vertices/1/1",
     "expected a number, found a list"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0, [1],2],[0,1,0]]}", "/vertices/1/1",
     "expected a number, found a list"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[ [1],[2],[3]],[0,1,0]]}",
     "/vertices/1/0", "expected a number, found a list"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0,{},[1]],[0,1,0]]}", "/vertices/1/1",
     "expected a number, found an object"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0 ,[1],[[]]],[0,1,0]]}",
     "/vertices/1/1", "expected a number, found a list"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[0,1,\"],[\"],[0,1,0]]}",
     "/vertices/1/2", "expected a number, found a string"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,1,4]", "/2",
     "index 4 of 4 positions"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,-1,2]", "/1",
     "index -1 of 4"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,1.5,2]", "/1",
     "not a whole number"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,123456789012,2]", "/1",
     "index 123456789012 of 4"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[0,1]", "",
     "a face of 2 corners"},
    {"{\"meshes\":[{" POSITIONS ",\"faces\":[", "[3,1,2]", "]}]}", "/meshes/0/faces", "[]", "", "a face of 0 corners"},
    {"{\"meshes\":[{" POSITIONS ",\"lines\":[", "[3,1]", "]}]}", "/meshes/0/lines", "[0,1,2]", "",
     "a line of 3 ends; it has two"},
    {"{\"meshes\":[{" POSITIONS ",\"lines\":[", "[3,1]", "]}]}", "/meshes/0/lines", "[0,\"1\"]", "/1",
     "expected an index, found a string"},
    {"{\"meshes\":[{\"heights\":[", "[1,2.5,null]", "]}]}", "/meshes/0/heights", "[1,2]", "",
     "2 values, but the first row has 3"},
    {"{\"meshes\":[{\"heights\":[", "[1,2.5,null]", "]}]}", "/meshes/0/heights", "[1,2,true]", "/2",
     "expected a number, found a boolean"},
    {"{\"meshes\":[{\"heights\":[", "[1,2.5,null]", "]}]}", "/meshes/0/heights", "5", "",
     "expected a list, found a number"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", CORNERS ",\"color\":[0,0,2]}", "/color/2",
     "2 is outside of 0 to 1"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[1,0,0],[0,1,9e9]]}", "/vertices/2/2",
     "outside of -1000000 to 1000000"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "{\"vertices\":[[0,0,0],[1,0,0]]}", "/vertices",
     "a polygon of 2 vertices"},
    {"{\"polygons\":[", CORNERS ",\"normals\":[[0,0,1],[0,0,1],[0,0,1]]}", "]}", "/polygons",
     CORNERS ",\"normals\":[[0,0,1],[0,0,1]]}", "/normals", "2 items for 3 vertices"},
    {"{\"polygons\":[", CORNERS ",\"colors\":[\"#123456\",[0,0,1],[0,0,1,1]]}", "]}", "/polygons",
     CORNERS ",\"colors\":[[0,0,1],[0,0,1],\"red\"]}", "/colors/2", "'red' is not a colour"},
    {"{\"polygons\":[", CORNERS ",\"doubleSided\":true}", "]}", "/polygons", CORNERS ",\"doubleSided\":1}",
     "/doubleSided", "expected true or false, found a number"},
    {"{\"polygons\":[", CORNERS ",\"holes\":[[[0,0,0],[0,0,0],[0,0,0]]]}", "]}", "/polygons",
     CORNERS ",\"holes\":[[[0,0,0],[0,0,0],[0,0]]]}", "/holes/0/2", "expected 3 or 4 numbers, found 2"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", CORNERS "," TRIANGLE "}", "/vertices", "given twice"},
    {"{\"polygons\":[", CORNERS "}", "]}", "/polygons", "null", "", "expected an object, found null"},
};

static struct text list_with(const struct list_case *list, size_t count, size_t place)
{
    struct text text = {0};
    add(&text, "%s", list->before);
    for (size_t i = 0; i < count; i++)
        add(&text, "%s%s", i ? "," : "", i == place ? list->bad : list->item);
    add(&text, "%s", list->after);
    return text;
}

static void fault_anywhere_in_a_list_has_its_pointer(void **state)
{
    (void)state;
    static const size_t counts[] = {4, 5000}, none = SIZE_MAX;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t c = 0; c < 2; c++) {
            size_t count = counts[c];
            const size_t places[] = {none, 0, count / 2, count - 1};
            bool no_shape = strstr(cases[i].detail, "the first row"); /* what comes first is right */
            for (size_t p = 0; p < 4; p++) {
                if (no_shape && places[p] == 0) continue;
                struct text text = list_with(&cases[i], count, places[p]);
                struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
                char pointer[128];
                snprintf(pointer, sizeof pointer, "%s/%zu%s", cases[i].pointer, places[p], cases[i].inner);
                if (places[p] == none)
                    assert_read(reading);
                else
                    assert_complaint(reading, ZR_BAD_SCENE, pointer, cases[i].detail);
                reading_free(reading);
                drop(&text);
            }
        }
}

static void bad_syntax_in_a_list_comes_before_other_faults(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "[1,2,3",           "[1,2,03]",  "[1,2,3.]", "[1,2,+3]",  "[1,2,.5]", "[1,2,3,]", "[1 2,3]",
        "[1,2,3}",          "[1,2,\"a]", "[1,2,3]]", "[1,2,3],",  "",         "[1,,3]",   "[1,2,3]x",
        "[1,2,3],,[1,2,3]", "[1,2,1e]",  "[1,2,-]",  "[1,2,nul]", "{\"a\":}", "\"\x80\"", "\"\n\""};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t b = 0; b < sizeof bad / sizeof *bad; b++)
            for (size_t place = 0; place < 3; place++) {
                struct list_case list = cases[i];
                list.bad = bad[b];
                struct text text = list_with(&list, 3, place), faulty = {0};
                add(&faulty, "{\"nodez\":1,\"shading\":7,%s", text.bytes + 1);
                for (size_t k = 0; k < 2; k++) {
                    const struct text *body = k ? &faulty : &text;
                    struct reading *reading = read_bytes(ZR_FORMAT_JSON, body->bytes, body->size);
                    if (reading->status != ZR_BAD_SYNTAX) fail_msg("%s: status %d", body->bytes, reading->status);
                    assert_int_equal(reading->error.count, 1);
                    assert_non_null(strstr(reading->error.items[0].detail, "line "));
                    reading_free(reading);
                }
                drop(&faulty);
                drop(&text);
            }
}

static void text_cut_short_anywhere_is_bad_syntax(void **state)
{
    (void)state;
    struct text text = make_scene(12);
    for (size_t size = 0; size < text.size; size++) {
        struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, size);
        assert_int_equal(reading->status, ZR_BAD_SYNTAX);
        reading_free(reading);
    }
    drop(&text);
}

static void number_too_long_in_a_list_gives_its_place(void **state)
{
    (void)state;
    struct text text = {0};
    add(&text, "{\"meshes\":[{" FACES ",\"positions\":[[0,0,0],[0,0,0],\n[0,0,0.%064d]]}]}", 1);
    struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
    assert_complaint(reading, ZR_BAD_SCENE, "", "line 2, column 6: a number of more than 63 characters");
    reading_free(reading);
    drop(&text);
}

/* ---- an oracle: cJSON's tree, and the contract for meshes of positions and faces ---- */

static bool is_place(const cJSON *node)
{
    return cJSON_IsNumber(node) && fabs(node->valuedouble) <= 1e6;
}

static bool is_row(const cJSON *row, size_t least, size_t most)
{
    size_t count = 0;
    if (!cJSON_IsArray(row)) return false;
    for (const cJSON *item = row->child; item; item = item->next, count++)
        if (!is_place(item)) return false;
    return count >= least && count <= most;
}

static bool is_face(const cJSON *row, size_t positions)
{
    if (!is_row(row, 3, 1024)) return false;
    for (const cJSON *item = row->child; item; item = item->next)
        if (item->valuedouble < 0 || item->valuedouble >= (double)positions ||
            item->valuedouble != floor(item->valuedouble))
            return false;
    return true;
}

/* {"meshes":[{"positions":[...],"faces":[...]}]} with keys in any order, and some face to draw. */
static bool oracle_accepts(const cJSON *root)
{
    const cJSON *meshes = cJSON_IsObject(root) && root->child && !root->child->next ? root->child : NULL;
    if (!meshes || strcmp(meshes->string, "meshes") != 0 || !cJSON_IsArray(meshes)) return false;
    size_t faces = 0;
    for (const cJSON *mesh = meshes->child; mesh; mesh = mesh->next) {
        const cJSON *positions = cJSON_GetObjectItemCaseSensitive(mesh, "positions");
        const cJSON *list = cJSON_GetObjectItemCaseSensitive(mesh, "faces");
        if (!cJSON_IsObject(mesh) || cJSON_GetArraySize(mesh) != 2 || !cJSON_IsArray(positions) || !cJSON_IsArray(list))
            return false;
        for (const cJSON *row = positions->child; row; row = row->next)
            if (!is_row(row, 3, 4)) return false;
        for (const cJSON *row = list->child; row; row = row->next, faces++)
            if (!is_face(row, (size_t)cJSON_GetArraySize(positions))) return false;
    }
    return faces > 0;
}

static void mutate(struct text *text)
{
    static const char bytes[] = "0123456789-+.eE,,[]{}\":\\ \n\tnulltruefalse#\xFF\x01";
    for (size_t changes = 1 + below(3); changes > 0 && text->size > 2; changes--) {
        size_t at = below(text->size), length = 1 + below(12), from = below(text->size);
        switch (below(4)) {
        case 0:
            text->bytes[at] = bytes[below(sizeof bytes - 1)];
            break;
        case 1: /* take away */
            if (length > text->size - at) length = text->size - at;
            memmove(text->bytes + at, text->bytes + at + length, text->size - at - length);
            text->size -= length;
            break;
        case 2: /* copy over */
            if (length > text->size - at) length = text->size - at;
            if (length > text->size - from) length = text->size - from;
            memmove(text->bytes + at, text->bytes + from, length);
            break;
        default: /* put in */
            put(text, " ", 1);
            memmove(text->bytes + at + 1, text->bytes + at, text->size - 1 - at);
            text->bytes[at] = bytes[below(sizeof bytes - 1)];
        }
    }
}

static enum zr_status strict_scan(const struct text *text)
{
    struct zr_arena arena;
    struct zr_error error = {.count = 0};
    struct zr_limits limits = zr_limits_default();
    size_t values;
    zr_arena_init(&arena, (size_t)1 << 24);
    enum zr_status status = zr_json_scan(&arena, text->bytes, text->size, &limits, &values, &error);
    zr_arena_free(&arena);
    return status;
}

static void random_changes_are_judged_as_by_cjson(void **state)
{
    (void)state;
    int accepted = 0, refused = 0, malformed = 0;
    for (int i = 0; i < 60000; i++) {
        struct text text = {0};
        size_t count = 1 + below(5);
        add(&text, "{\"meshes\":[{\"positions\":[");
        add_places(&text, count, 4);
        add(&text, "],\"faces\":[[%zu,%zu,%zu],[0,0,0,0]]}]}", below(count), below(count), below(count));
        mutate(&text);
        struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
        enum zr_status strict = strict_scan(&text);
        if ((strict == ZR_BAD_SYNTAX) != (reading->status == ZR_BAD_SYNTAX))
            fail_msg("%.*s: status %d, strictly %d", (int)text.size, text.bytes, reading->status, strict);
        if (strict == ZR_OK) {
            cJSON *root = cJSON_ParseWithLength(text.bytes, text.size);
            bool accepts = oracle_accepts(root);
            if (accepts != (reading->status == ZR_OK))
                fail_msg("%.*s: status %d, the oracle %d", (int)text.size, text.bytes, reading->status, accepts);
            assert_true(accepts || reading->status == ZR_BAD_SCENE);
            cJSON_Delete(root);
            accepted += accepts;
            refused += !accepts;
        }
        malformed += strict == ZR_BAD_SYNTAX;
        reading_free(reading);
        drop(&text);
    }
    if (accepted < 1000 || refused < 1000 || malformed < 1000) fail_msg("%d %d %d", accepted, refused, malformed);
}

/* Of scenes with everything in them, the oracle knows the syntax only. */
static void random_changes_to_whole_scenes_keep_syntax_strict(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        struct text text = make_scene(1 + below(6));
        if (i % 2) {
            struct text other = respell(text.bytes, (enum spelling)(i / 2 % SPELLINGS));
            drop(&text);
            text = other;
        }
        mutate(&text);
        struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
        bool malformed = strict_scan(&text) == ZR_BAD_SYNTAX;
        if (malformed != (reading->status == ZR_BAD_SYNTAX))
            fail_msg("%.*s: status %d, malformed %d", (int)text.size, text.bytes, reading->status, malformed);
        assert_true(reading->status != ZR_INTERNAL && reading->status != ZR_NO_MEMORY);
        reading_free(reading);
        drop(&text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_spelling_gives_the_same_scene),
        cmocka_unit_test(positions_are_the_floats_of_what_strtod_gives),
        cmocka_unit_test(arrays_take_little_more_than_themselves),
        cmocka_unit_test(polygons_written_alike_are_alike),
        cmocka_unit_test(numbers_in_large_lists_do_not_count_as_values),
        cmocka_unit_test(lists_too_deep_for_the_limit_are_refused),
        cmocka_unit_test(fault_anywhere_in_a_list_has_its_pointer),
        cmocka_unit_test(bad_syntax_in_a_list_comes_before_other_faults),
        cmocka_unit_test(text_cut_short_anywhere_is_bad_syntax),
        cmocka_unit_test(number_too_long_in_a_list_gives_its_place),
        cmocka_unit_test(random_changes_are_judged_as_by_cjson),
        cmocka_unit_test(random_changes_to_whole_scenes_keep_syntax_strict),
    };
    return cmocka_run_group_tests_name("json_lists", tests, NULL, NULL);
}
