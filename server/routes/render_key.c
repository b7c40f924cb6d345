#include "render_key.h"

#include <stdlib.h>
#include <string.h>

#include <nettle/sha2.h>

#include "input/query/query_plain.h"
#include "output/images/lossy.h"
#include "render_request.h"
#include "scene/looks.h"

_Static_assert(sizeof(struct zr_file_hash) == SHA256_DIGEST_SIZE, "the key is a SHA-256");

/* With its final zero, which separates it from the next text. */
static void add_text(struct sha256_ctx *hash, const char *text)
{
    sha256_update(hash, strlen(text) + 1, (const uint8_t *)text);
}

/* Adds the newest versions of all looks: a scene without a version, which is not read, may choose any. */
static void add_looks(struct sha256_ctx *hash)
{
    for (int i = 0; i < zr_look_count; i++)
        add_text(hash, zr_look_pin_of(&zr_looks[i]).text);
}

bool render_key(const char *scene, const struct zr_request *parameters, const struct zr_limits *limits,
                struct zr_file_hash *key)
{
    const uint32_t rules = ZR_RULES;
    struct sha256_ctx hash;
    char *plain = malloc(zr_query_plain_room(parameters));
    if (!plain) return false;
    zr_query_plain(parameters, limits, plain);
    sha256_init(&hash);
    add_text(&hash, "zraster picture 1 " ZR_VERSION);
    sha256_update(&hash, sizeof rules, (const uint8_t *)&rules);
    add_text(&hash, zr_jpeg_encoder());
    add_text(&hash, zr_webp_encoder().text);
    add_text(&hash, scene);
    add_text(&hash, plain);
    if (!parameters->look) add_looks(&hash);
    sha256_digest(&hash, sizeof key->bytes, key->bytes);
    free(plain);
    return true;
}
