#include "output/json/trace_json.h"

#include "output/json/json_print.h"

enum { VALUES_PER_CANCEL_CHECK = 512 };

static void print_value(struct zr_print *print, const struct zr_trace_value *value)
{
    switch (value->kind) {
    case ZR_TRACE_BEGIN:
        zr_print_begin(print, value->key, value->bracket);
        break;
    case ZR_TRACE_END:
        zr_print_end(print, value->bracket);
        break;
    case ZR_TRACE_INTEGER:
        zr_print_integer(print, value->key, value->integer);
        break;
    case ZR_TRACE_FLOAT:
        zr_print_float(print, value->key, value->number);
        break;
    case ZR_TRACE_REAL:
        zr_print_double(print, value->key, value->real);
        break;
    case ZR_TRACE_TEXT:
        zr_print_string(print, value->key, value->text);
        break;
    case ZR_TRACE_BOOL:
        zr_print_bool(print, value->key, value->is_true);
        break;
    }
}

enum zr_status zr_trace_json_write(const struct zr_trace *trace, const struct zr_cancel *cancel, struct zr_buffer *out)
{
    struct zr_print print = {.out = out};
    for (size_t i = 0; i < trace->count; i++) {
        if (i % VALUES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return ZR_CANCELLED;
        print_value(&print, &trace->values[i]);
    }
    return zr_buffer_add(out, "\n", 1) && zr_arena_ok(out->arena) ? ZR_OK : ZR_NO_MEMORY;
}
