/* status.h - base: how every function that can fail says so.
 *
 * A status tells the class of a failure, and one table in the server maps it to
 * an HTTP status. A zr_error holds the details a person needs to mend the
 * input: what, and where (a JSON Pointer, or a place such as "line 12").
 */
#ifndef ZR_STATUS_H
#define ZR_STATUS_H

#include <stddef.h>

enum zr_status {
    ZR_OK = 0,
    ZR_BAD_SYNTAX,  /* the bytes are not what their type says (JSON, OBJ, STL) */
    ZR_BAD_TYPE,    /* no type says what the bytes are, and they look like nothing that is read */
    ZR_BAD_REQUEST, /* the parameters beside the bytes are wrong */
    ZR_BAD_SCENE,   /* well-formed, but not a scene that can be drawn */
    ZR_NO_MEMORY,   /* the request's arena reached its ceiling */
    ZR_CANCELLED,   /* told to stop: the deadline passed or the client left */
    ZR_INTERNAL     /* our own fault */
};

enum { ZR_ERROR_ITEMS = 20, ZR_POINTER_SIZE = 160, ZR_DETAIL_SIZE = 520 };

struct zr_error_item {
    char pointer[ZR_POINTER_SIZE]; /* JSON Pointer; "" where none applies */
    char detail[ZR_DETAIL_SIZE];
};

/* The first status reported stays; further items are kept up to ZR_ERROR_ITEMS
 * and counted beyond. Zero-initialise before use. */
struct zr_error {
    enum zr_status status;
    size_t count; /* all that were reported; may exceed ZR_ERROR_ITEMS */
    struct zr_error_item items[ZR_ERROR_ITEMS];
};

/* Adds an item and returns `status`, so that `return zr_error_add(...)` reads as
 * one step. `pointer` may be NULL. Texts too long are cut at a whole character. */
enum zr_status zr_error_add(struct zr_error *error, enum zr_status status, const char *pointer, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The count of items that `items` really holds. */
size_t zr_error_held(const struct zr_error *error);

#endif
