/* config.h - all settings of the daemon, from one table.
 *
 * The table in config/settings.c gives each setting its flag, default, unit, bounds and help line. The ZRASTER_*
 * variable and the name in /v1/limits follow from the flag. A flag overrides a variable, a variable overrides the file
 * of --config, and the file overrides the default.
 */
#ifndef ZRASTERD_CONFIG_H
#define ZRASTERD_CONFIG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "core.h"

struct cJSON;

enum { CONFIG_TEXT_SIZE = 256, CONFIG_SETTINGS_MAX = 96, CONFIG_MESSAGE_SIZE = 16384 };

/* Where a setting comes from. */
struct config_source {
    enum { CONFIG_DEFAULT, CONFIG_FILE, CONFIG_VARIABLE, CONFIG_FLAG } kind;
    unsigned line; /* of the file */
};

/* Filled by config_read, constant afterwards. */
struct config {
    char config[CONFIG_TEXT_SIZE];     /* the file of settings; "": none */
    char address[CONFIG_TEXT_SIZE];    /* numeric IPv4 or IPv6 address */
    char token[CONFIG_TEXT_SIZE];      /* "": none; never shown */
    char token_file[CONFIG_TEXT_SIZE]; /* "": none, as for all files */
    char keys_file[CONFIG_TEXT_SIZE], presets[CONFIG_TEXT_SIZE];
    char only_presets[CONFIG_TEXT_SIZE];    /* "on" or "off" */
    char cgroup[CONFIG_TEXT_SIZE];          /* folder of the control group */
    char assets_dir[CONFIG_TEXT_SIZE];      /* "": no assets are stored */
    char isa[CONFIG_TEXT_SIZE];             /* "auto", or an instruction set of this machine */
    char metrics[CONFIG_TEXT_SIZE];         /* "on" or "off" */
    char page[CONFIG_TEXT_SIZE];            /* "on" or "off" */
    char engine_dir[CONFIG_TEXT_SIZE];      /* "": the page does not draw by itself */
    char allow_origin[CONFIG_TEXT_SIZE];    /* list with spaces or commas between its items; "*": all */
    char trusted_proxies[CONFIG_TEXT_SIZE]; /* a list as networks.h has it; "": none */
    char proxy_protocol[CONFIG_TEXT_SIZE];  /* "on" or "off" */
    char client_header[CONFIG_TEXT_SIZE];   /* as forwarded.h has it */
    uint64_t port;                          /* 0: any free port */

    uint64_t workers, threads, queue, max_per_client, max_per_private_client, max_connections, max_streams;

    uint64_t body_max_bytes, upload_memory_bytes, request_memory_bytes, keep_memory_bytes, answer_memory_bytes;
    uint64_t keep_image_bytes, keep_text_bytes, keep_mesh_bytes, keep_answer_bytes;
    uint64_t assets_max_bytes;

    uint64_t header_timeout_ms, idle_timeout_ms, body_timeout_ms, body_min_bytes_per_second;
    uint64_t answer_min_bytes_per_second, write_timeout_ms, render_timeout_ms, drain_delay_ms, drain_timeout_ms,
        cost_max_ms;

    uint64_t json_depth_max, window_side_max, window_pixels_max, polygon_vertices_max, instances_max, image_pixels_max;
    uint64_t coordinate_max;

    struct config_source sources[CONFIG_SETTINGS_MAX]; /* in the order of the table */
};

enum config_mode {
    CONFIG_SERVE,
    CONFIG_HELP,
    CONFIG_VERSION,
    CONFIG_HEALTH,
    CONFIG_CHECK,
    CONFIG_PRINT, /* 0 stays where the machine decides, for config_print */
    CONFIG_WRONG
};

/* Reads the file, variables and flags. CONFIG_WRONG: `message` has a line for each fault, the first 20 of them, which
 * names the place, the value and the allowed values. */
enum config_mode config_read(struct config *config, int argc, char *const *argv, char *message, size_t message_size);

struct zr_limits config_limits(const struct config *config);

/* Returns the instruction set of the kernels to run. */
enum zr_isa config_isa(const struct config *config);

void config_print_help(FILE *out);

/* Prints the settings in the form of the file of --config, each with its source. Secrets are not shown. */
void config_print(const struct config *config, FILE *out);

/* Checks the folders that the settings name, and says in `message` how many settings are given. False:
 * `message` has a line for each fault. */
bool config_check_folders(const struct config *config, char *message, size_t message_size);

/* Adds each limit in force to `object`: bodyMaxBytes for --body-max-bytes. False: out of memory. */
bool config_add_limits(const struct config *config, struct cJSON *object);

#endif
