/* status.h - base: status codes and error details.
 *
 * A status is the class of a failure; one table in the server maps it to an HTTP status. A zr_error holds the details
 * that a person needs to correct the input: the cause, and the place (a JSON Pointer, or text such as "line 12"). */
#ifndef ZR_STATUS_H
#define ZR_STATUS_H

#include <stddef.h>

enum zr_status {
    ZR_OK = 0,
    ZR_BAD_SYNTAX,  /* the bytes violate their format (JSON, OBJ, 3MF, STL) */
    ZR_BAD_TYPE,    /* the content type is missing and the format is not recognized */
    ZR_BAD_REQUEST, /* a parameter of the request is wrong */
    ZR_BAD_SCENE,   /* well-formed, but not a scene that can be drawn */
    ZR_NO_MEMORY,   /* the request's arena reached its ceiling */
    ZR_CANCELLED,   /* stopped: the deadline passed or the client disconnected */
    ZR_INTERNAL     /* a bug of zraster */
};

enum { ZR_ERROR_ITEMS = 20, ZR_POINTER_SIZE = 160, ZR_DETAIL_SIZE = 1100 };

struct zr_error_item {
    char pointer[ZR_POINTER_SIZE]; /* JSON Pointer, or "" */
    char detail[ZR_DETAIL_SIZE];
    size_t place; /* 1 + byte of the text at which JSON is broken; 0: none */
};

/* Keeps the first reported status, and up to ZR_ERROR_ITEMS items; counts further ones. Zero-initialize before use. */
struct zr_error {
    enum zr_status status;
    size_t count; /* all reported items; may exceed ZR_ERROR_ITEMS */
    struct zr_error_item items[ZR_ERROR_ITEMS];
};

/* Adds an item and returns `status`, for use as `return zr_error_add(...)`. `pointer` may be NULL. Long texts are cut
 * at a whole character. */
enum zr_status zr_error_add(struct zr_error *error, enum zr_status status, const char *pointer, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Returns the number of valid items. */
size_t zr_error_held(const struct zr_error *error);

#endif
