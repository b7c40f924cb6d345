#include "input/files/assets.h"

#include <string.h>

#include "input/text/text.h"
#include "parameter_rows.h"
#include "render_request.h"

const char *zr_stored_name(const char *asset)
{
    enum { DIGITS = 64 };
    const char *sha256 = asset + sizeof ZR_STORED - 1;
    if (strncmp(asset, ZR_STORED, sizeof ZR_STORED - 1) != 0) return NULL;
    return strspn(sha256, "0123456789abcdef") == DIGITS && sha256[DIGITS] == '\0' ? sha256 : NULL;
}

/* True for a field of a form that has the name of a parameter, and a value as short as one. */
static bool is_parameter(const struct zr_asset *asset)
{
    enum { VALUE_MAX = 64 };
#define NAME(name, ...) #name,
    static const char *const names[] = {ZR_PARAMETER_ROWS(NAME)};
#undef NAME
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(asset->name, names[i]) == 0) return asset->size <= VALUE_MAX;
    return false;
}

void zr_warn_of_unused_asset(struct zr_scene_builder *builder, const struct zr_asset *asset)
{
    if (asset->packed || asset->is_optional) return; /* zr_zip_body_warn */
    if (asset->bytes && asset->bytes == builder->query_bytes) return;
    zr_warning_list_add(builder->arena, &builder->warnings, "the asset %s is not used by the scene%s",
                        zr_quote(asset->name, strlen(asset->name)).text,
                        is_parameter(asset) ? "; parameters go into the query of the address" : "");
}

struct zr_parsed_assets zr_parsed_assets_of(const struct zr_scene_builder *builder, const struct zr_request *request)
{
    uint8_t *uses = builder->asset_uses;
    if (!uses) uses = zr_arena_zero(builder->arena, request->asset_count, sizeof *uses);
    return (struct zr_parsed_assets){.count = request->asset_count,
                                     .items = request->assets,
                                     .folder = builder->asset_folder,
                                     .looked = builder->looked,
                                     .uses = uses,
                                     .use = ZR_USED,
                                     .stored = request->stored,
                                     .texts = request->texts,
                                     .meshes = request->meshes,
                                     .quick = request->quick};
}

void zr_parsed_warn_of_unused_assets(const struct zr_parsed_assets *assets, struct zr_scene_builder *builder)
{
    for (size_t i = 0; !builder->asset_uses && i < assets->count; i++)
        if (!assets->uses[i]) zr_warn_of_unused_asset(builder, &assets->items[i]);
}
