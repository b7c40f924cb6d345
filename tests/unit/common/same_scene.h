/* same_scene.h - tests: two scenes must have the same meshes, bit by bit. */
#ifndef ZR_TESTS_SAME_SCENE_H
#define ZR_TESTS_SAME_SCENE_H

#include "input_check.h"

static inline void assert_same_array(const void *a, const void *b, size_t count, size_t size)
{
    assert_int_equal(a == NULL, b == NULL);
    if (a) assert_memory_equal(a, b, count * size);
}

static inline void assert_same_mesh(const struct zr_mesh *a, const struct zr_mesh *b)
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
    assert_int_equal(a->point_count, b->point_count);
    assert_true(a->point_size == b->point_size && a->points_are_round == b->points_are_round);
    assert_same_array(a->points, b->points, a->point_count, sizeof *a->points);
    assert_same_array(a->normals, b->normals, a->normal_count, sizeof *a->normals);
    assert_same_array(a->normal_indices, b->normal_indices, corners, sizeof *a->normal_indices);
    assert_same_array(a->face_groups, b->face_groups, a->face_count, sizeof *a->face_groups);
    assert_same_array(a->colors, b->colors, a->position_count, sizeof *a->colors);
    assert_same_array(a->face_colors, b->face_colors, a->face_count, sizeof *a->face_colors);
    assert_same_array(a->texcoords, b->texcoords, a->position_count, sizeof *a->texcoords);
    assert_same_array(a->face_parts, b->face_parts, a->face_count, sizeof *a->face_parts);
    assert_int_equal(a->part_count, b->part_count);
    for (uint32_t i = 0; i < a->part_count; i++)
        assert_string_equal(a->part_names[i], b->part_names[i]);
    assert_same_array(a->face_materials, b->face_materials, a->face_count, sizeof *a->face_materials);
}

static inline void assert_same_scene(const struct zr_scene *a, const struct zr_scene *b)
{
    assert_int_equal(a->mesh_count, b->mesh_count);
    assert_int_equal(a->material_count, b->material_count);
    assert_int_equal(a->warning_count, b->warning_count);
    for (uint32_t i = 0; i < a->warning_count; i++)
        assert_string_equal(a->warnings[i], b->warnings[i]);
    assert_same_array(a->origin, b->origin, 3, sizeof *a->origin);
    for (uint32_t i = 0; i < a->material_count; i++) {
        assert_int_equal(a->materials[i].shading, b->materials[i].shading);
        assert_memory_equal(&a->materials[i].base_color, &b->materials[i].base_color, sizeof a->materials->base_color);
    }
    for (uint32_t i = 0; i < a->mesh_count; i++)
        assert_same_mesh(&a->meshes[i], &b->meshes[i]);
}

#endif
