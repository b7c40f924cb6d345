#include "output/annotations_json.h"

void zr_annotations_print(struct zr_print *print, const struct zr_annotations *annotations)
{
    if (!annotations) return;
    zr_print_begin(print, "annotations", '{');
    zr_print_begin(print, "leftOut", '[');
    for (uint32_t i = 0; i < annotations->left_out_count; i++) {
        zr_print_begin(print, NULL, '{');
        zr_print_string(print, "what", annotations->left_out[i].what);
        zr_print_string(print, "why", annotations->left_out[i].why);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
    if (annotations->numbered_count > 0) {
        zr_print_begin(print, "numbers", '[');
        for (uint32_t i = 0; i < annotations->numbered_count; i++) {
            zr_print_begin(print, NULL, '{');
            zr_print_count(print, "number", annotations->numbered[i].number);
            zr_print_string(print, "part", annotations->numbered[i].name);
            zr_print_end(print, '}');
        }
        zr_print_end(print, ']');
    }
    zr_print_end(print, '}');
}
