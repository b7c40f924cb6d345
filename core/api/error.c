#include "api/error.h"

#include <stdlib.h>
#include <string.h>

struct zraster_error {
    struct zr_error faults;
    size_t count;      /* of valid faults */
    const char *text;  /* all of them */
    char characters[]; /* of `text`, unless static */
};

static const zraster_error out_of_memory = {
    .faults = {.status = ZR_NO_MEMORY, .count = 1, .items[0].detail = "the system has no memory for the error"},
    .count = 1,
    .text = "the system has no memory for the error"};

_Static_assert((int)ZRASTER_OK == (int)ZR_OK && (int)ZRASTER_BAD_SYNTAX == (int)ZR_BAD_SYNTAX &&
                   (int)ZRASTER_BAD_TYPE == (int)ZR_BAD_TYPE && (int)ZRASTER_BAD_REQUEST == (int)ZR_BAD_REQUEST &&
                   (int)ZRASTER_BAD_SCENE == (int)ZR_BAD_SCENE && (int)ZRASTER_NO_MEMORY == (int)ZR_NO_MEMORY &&
                   (int)ZRASTER_CANCELLED == (int)ZR_CANCELLED && (int)ZRASTER_INTERNAL == (int)ZR_INTERNAL,
               "both enums have the same values");

static void put_text(zraster_error *error)
{
    char *end = error->characters;
    for (size_t i = 0; i < error->count; i++) {
        const struct zr_error_item *item = &error->faults.items[i];
        if (i > 0) *end++ = '\n';
        if (*item->pointer) end = stpcpy(stpcpy(end, item->pointer), ": ");
        end = stpcpy(end, item->detail);
    }
    *end = '\0';
    error->text = error->characters;
}

static const char *words_of(enum zr_status status)
{
    return status == ZR_NO_MEMORY ? "the system has no memory" : status == ZR_CANCELLED ? "cancelled" : "failed";
}

static zraster_error *make(enum zr_status status, const struct zr_error *faults)
{
    size_t size = 1;
    for (size_t i = 0; i < zr_error_held(faults); i++)
        size += strlen(faults->items[i].pointer) + strlen(faults->items[i].detail) + 3;
    zraster_error *error = calloc(1, sizeof *error + size + ZR_DETAIL_SIZE);
    if (!error) return (zraster_error *)&out_of_memory;
    error->faults = *faults;
    if (faults->count == 0) zr_error_add(&error->faults, status, NULL, "%s", words_of(status));
    error->count = zr_error_held(&error->faults);
    put_text(error);
    return error;
}

zraster_status zr_error_give(enum zr_status status, const struct zr_error *faults, zraster_error **out)
{
    if (out) *out = status == ZR_OK ? NULL : make(status, faults);
    return (zraster_status)status;
}

const char *zraster_error_text(const zraster_error *error)
{
    return error ? error->text : "";
}

size_t zraster_error_count(const zraster_error *error)
{
    return error ? error->count : 0;
}

const char *zraster_error_pointer(const zraster_error *error, size_t i)
{
    return i < zraster_error_count(error) ? error->faults.items[i].pointer : "";
}

const char *zraster_error_detail(const zraster_error *error, size_t i)
{
    return i < zraster_error_count(error) ? error->faults.items[i].detail : "";
}

void zraster_error_free(zraster_error *error)
{
    if (error != &out_of_memory) free(error);
}
