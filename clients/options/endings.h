/* endings.h - client: endings of file names, for messages: of meshes " .obj .3mf .stl", of all formats " json obj 3mf stl". */
#ifndef ENDINGS_H
#define ENDINGS_H

#include "format_rows.h"

#define OPTIONS_ENDING_true(suffix)
#define OPTIONS_ENDING_false(suffix)                                " ." suffix
#define OPTIONS_MESH_ENDING(ID, suffix, media_types, has_view, ...) OPTIONS_ENDING_##has_view(suffix)
#define OPTIONS_ANY_ENDING(ID, suffix, ...)                         " " suffix
#define OPTIONS_MESHES                                              ZR_FORMAT_ROWS(OPTIONS_MESH_ENDING)
#define OPTIONS_TYPES                                               ZR_FORMAT_ROWS(OPTIONS_ANY_ENDING)

#endif
