/* The large lists of a scene, which are read from the text itself: in every spelling the same scene, and no more
 * memory than they need. */
#include "support/tests.h"
#include "unit/common/json_texts.h"
#include "unit/common/same_scene.h"

TEST(every_spelling_gives_the_same_scene)
{
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

TEST(positions_are_the_floats_of_what_strtod_gives)
{
    struct text text = {0};
    enum { COUNT = 5000 };
    add(&text, "{\"meshes\":[{\"points\":[0");
    for (int i = 1; i < COUNT; i++)
        add(&text, ",%d", i);
    add(&text, "],\"positions\":[");
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

TEST(arrays_take_little_more_than_themselves)
{
    struct text text = {0};
    enum { COUNT = 20000 };
    add(&text, "{\"polygons\":[");
    for (size_t i = 0; i < COUNT; i++) {
        add(&text, "%s{\"vertices\":[", i ? "," : "");
        add_places(&text, 3, 3);
        add(&text, "],\"shading\":\"flat\",\"outline\":\"red\",\"material\":\"m\"}");
    }
    add(&text, "],\"materials\":[{\"name\":\"m\"}]}");
    struct reading *reading = read_bytes(ZR_FORMAT_JSON, text.bytes, text.size);
    assert_read(reading);
    size_t arrays = (size_t)COUNT * (3 * (sizeof(zr_vec4) + sizeof(uint32_t)) + 2 * sizeof(uint32_t));
    assert_true(reading->arena.used < arrays + arrays / 10);
    reading_free(reading);
    drop(&text);
}

/* A look that was seen before is not looked at again. What else is the same must be. */
TEST(polygons_written_alike_are_alike)
{
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
            assert_int_equal(material->unfilled, first->unfilled);
            assert_int_equal(material->shading, first->shading);
            assert_int_equal(material->outline, first->outline);
            assert_int_equal(first->double_sided, strstr(rest[i], "doubleSided") != NULL);
            assert_int_equal(first->unfilled, strstr(rest[i], "fill") != NULL);
        }
        reading_free(reading);
        drop(&text);
    }
}

TEST(lists_too_deep_for_the_limit_are_refused)
{
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

RUN_TESTS(NULL, NULL)
