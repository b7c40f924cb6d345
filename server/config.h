/* config.h - all settings of the daemon, from one table.
 *
 * The table in config/settings.c gives each setting its flag, default, unit, bounds and help line. The ZRASTER_* variable and
 * the name in /v1/limits follow from the flag. A flag overrides a variable, a variable overrides the default.
 */
#ifndef ZRASTERD_CONFIG_H
#define ZRASTERD_CONFIG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "core.h"

struct cJSON;

enum { CONFIG_TEXT_SIZE = 256 };

/* Filled by config_read, constant afterwards. */
struct config {
    char address[CONFIG_TEXT_SIZE];    /* numeric IPv4 or IPv6 address */
    char token[CONFIG_TEXT_SIZE];      /* "": none is required; never shown */
    char cgroup[CONFIG_TEXT_SIZE];     /* folder of the control group */
    char assets_dir[CONFIG_TEXT_SIZE]; /* "": no assets are stored */
    char isa[CONFIG_TEXT_SIZE];        /* "auto", or an instruction set of this machine */
    char page[CONFIG_TEXT_SIZE];       /* "on" or "off" */
    char origins[CONFIG_TEXT_SIZE];    /* list with spaces or commas between its items; "*": all */
    uint64_t port;                     /* 0: any free port */

    uint64_t workers, threads, queue, max_per_client, max_per_private_client, max_connections, max_streams;

    uint64_t body_max_bytes, upload_memory_bytes, request_memory_bytes, keep_memory_bytes, answer_memory_bytes;
    uint64_t keep_image_bytes, keep_text_bytes, keep_mesh_bytes;
    uint64_t assets_max_bytes;

    uint64_t header_timeout_ms, idle_timeout_ms, body_timeout_ms, body_min_bytes_per_second;
    uint64_t answer_min_bytes_per_second, write_timeout_ms, render_timeout_ms, drain_delay_ms, drain_timeout_ms,
        cost_max_ms;

    uint64_t json_depth_max, window_side_max, window_pixels_max, polygon_vertices_max, instances_max, image_pixels_max;
    uint64_t coordinate_max;
};

enum config_mode { CONFIG_SERVE, CONFIG_HELP, CONFIG_VERSION, CONFIG_HEALTH, CONFIG_WRONG };

/* Reads flags and variables. CONFIG_WRONG: `message` names the setting, the value and the allowed values. */
enum config_mode config_read(struct config *config, int argc, char *const *argv, char *message, size_t message_size);

struct zr_limits config_limits(const struct config *config);

/* Returns the instruction set of the kernels to run. */
enum zr_isa config_isa(const struct config *config);

void config_print_help(FILE *out);

/* Adds each limit in force to `object`: bodyMaxBytes for --body-max-bytes. False: out of memory. */
bool config_add_limits(const struct config *config, struct cJSON *object);

#endif
