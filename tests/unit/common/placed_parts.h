/* placed_parts.h - unit: instances of meshes whose parts are measured, and a cube. */
#ifndef ZR_TEST_PLACED_PARTS_H
#define ZR_TEST_PLACED_PARTS_H

#include "base/run.h"
#include "mesh/facts/part_facts.h"
#include "support/scenes.h"
#include "support/tests.h"

static const zr_vec4 cube_positions[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1},
                                         {0, 0, 1, 1}, {1, 0, 1, 1}, {1, 1, 1, 1}, {0, 1, 1, 1}};
static const uint32_t cube_offsets[] = {0, 4, 8, 12, 16, 20, 24};
static const uint32_t cube_indices[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};

static inline struct zr_mesh cube(void)
{
    return (struct zr_mesh){.name = "cube",
                            .position_count = 8,
                            .positions = cube_positions,
                            .face_count = 6,
                            .face_offsets = cube_offsets,
                            .indices = cube_indices};
}

/* Instances of meshes, in a scene that is drawn in clip space. */
static struct placed {
    struct test_scene test;
    struct zr_mesh meshes[4];
    struct zr_instance instances[8];
} placed;

static inline void placed_begin(uint32_t meshes, uint32_t instances)
{
    scene_of_triangles(&placed.test, 16, 16, cube_positions, 1);
    placed.test.scene.meshes = placed.meshes;
    placed.test.scene.mesh_count = meshes;
    placed.test.scene.instances = placed.instances;
    placed.test.scene.instance_count = instances;
    for (uint32_t i = 0; i < instances; i++)
        placed.instances[i] = (struct zr_instance){.mesh = i < meshes ? i : 0, .object_to_world = zr_mat4_identity()};
}

/* Measures the parts of the scene. */
static inline const struct zr_part_facts *placed_facts(struct zr_arena *arena, struct zr_team *team)
{
    const struct zr_part_list list = zr_part_list_make(arena, &placed.test.scene, 100);
    struct zr_part_facts *facts = zr_arena_alloc(arena, list.count, sizeof *facts);
    assert_int_equal(
        zr_part_facts_find(&(struct zr_run){.arena = arena, .team = team}, &placed.test.scene, &list, facts), ZR_OK);
    return facts;
}

#endif
