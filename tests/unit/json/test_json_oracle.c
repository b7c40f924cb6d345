/* Texts with large lists, changed at random: of any the judgement that cJSON and the rules of the contract give. */
#include <cjson/cJSON.h>
#include <math.h>

#include "support/tests.h"
#include "unit/common/json_strict.h"
#include "unit/common/json_texts.h"
#include "unit/common/mutate.h"

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

static enum zr_status strict_scan(const struct text *text)
{
    /* One for all texts: a new block for each takes a hundred times as long as a text under AddressSanitizer. */
    static struct zr_arena arena = {.ceiling = (size_t)1 << 24};
    struct zr_error error = {.count = 0};
    struct zr_limits limits = zr_limits_default();
    enum zr_status status = read_strictly(&arena, text->bytes, text->size, &limits, &error);
    zr_arena_reset(&arena, ZR_ARENA_BLOCK);
    return status;
}

TEST(random_changes_are_judged_as_by_cjson)
{
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
TEST(random_changes_to_whole_scenes_keep_syntax_strict)
{
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

RUN_TESTS(NULL, NULL)
